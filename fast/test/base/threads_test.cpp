// Both sides of the seam: what the library asks of threads means the same
// where there are none.
#include "base/threads.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <vector>

#include "base/threads_one.hpp"

namespace halfspace::fast {
namespace {

struct WithMany {
  template <class Work>
  static void in_arena(int count, Work&& work) {
    threads::in_arena(count, work);
  }
  template <class Work>
  static void for_each_index(std::size_t count, const Work& work) {
    threads::for_each_index(count, work);
  }
  template <class Work>
  static void for_each_task(int count, const Work& work) {
    threads::for_each_task(count, work);
  }
  template <class Work>
  static void for_ranges(std::size_t count, std::size_t size,
                         const Work& work) {
    threads::for_ranges(count, size, work);
  }
  using TaskGroup = threads::TaskGroup;
  template <class T>
  using PerThread = threads::PerThread<T>;
};

struct WithOne {
  template <class Work>
  static void in_arena(int count, Work&& work) {
    one_thread::in_arena(count, work);
  }
  template <class Work>
  static void for_each_index(std::size_t count, const Work& work) {
    one_thread::for_each_index(count, work);
  }
  template <class Work>
  static void for_each_task(int count, const Work& work) {
    one_thread::for_each_task(count, work);
  }
  template <class Work>
  static void for_ranges(std::size_t count, std::size_t size,
                         const Work& work) {
    one_thread::for_ranges(count, size, work);
  }
  using TaskGroup = one_thread::TaskGroup;
  template <class T>
  using PerThread = one_thread::PerThread<T>;
};

template <class Side>
class Threads : public ::testing::Test {};
using Sides = ::testing::Types<WithMany, WithOne>;
TYPED_TEST_SUITE(Threads, Sides);

TYPED_TEST(Threads, EachIndexAndEachTaskIsCalledOnce) {
  for (const int count : {0, 1, 7, 1000}) {
    std::vector<std::atomic<int>> calls(static_cast<std::size_t>(count));
    std::atomic<int> arenas = 0;
    TypeParam::in_arena(2, [&] {
      ++arenas;
      TypeParam::for_each_index(calls.size(),
                                [&](std::size_t i) { ++calls[i]; });
      TypeParam::for_each_task(
          count, [&](int i) { ++calls[static_cast<std::size_t>(i)]; });
    });
    EXPECT_EQ(arenas, 1);
    for (const auto& n : calls) EXPECT_EQ(n, 2);
  }
}

TYPED_TEST(Threads, RangesMakeUpTheWhole) {
  for (const std::size_t count : {0u, 1u, 8u, 9u, 1000u}) {
    std::vector<std::atomic<int>> calls(count);
    TypeParam::for_ranges(count, 8, [&](std::size_t first, std::size_t end) {
      EXPECT_LT(first, end);
      for (std::size_t i = first; i < end; ++i) ++calls[i];
    });
    for (const auto& n : calls) EXPECT_EQ(n, 1);
  }
}

TYPED_TEST(Threads, TasksMayAddTasksHoweverDeep) {
  constexpr int kDeep = 100'000;
  typename TypeParam::TaskGroup group;
  std::atomic<int> done = 0;
  struct Task {
    typename TypeParam::TaskGroup& group;
    std::atomic<int>& done;
    int left;
    void operator()() const {
      ++done;
      if (left > 0) group.run(Task{group, done, left - 1});
    }
  };
  group.run(Task{group, done, kDeep - 1});
  group.wait();
  EXPECT_EQ(done, kDeep);
}

TYPED_TEST(Threads, AThreadKeepsItsValue) {
  std::atomic<int> made = 0;
  typename TypeParam::template PerThread<int> values([&] { return ++made; });
  int& first = values.local();
  first += 100;
  EXPECT_EQ(&values.local(), &first);
  EXPECT_EQ(values.local(), 101);
  EXPECT_EQ(made, 1);
}

}  // namespace
}  // namespace halfspace::fast
