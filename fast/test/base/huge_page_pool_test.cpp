#include "halfspace/fast/huge_page_pool.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <random>
#include <thread>
#include <vector>

#include "base/sanitizer.hpp"
#include "halfspace/fast/list.hpp"

namespace halfspace::fast {
namespace {

/// Lists of all lengths come and go, each full of its own number.
void expect_lists_apart(HugePagePool& pool, std::uint32_t own) {
  std::mt19937_64 random(own);
  std::vector<List<std::uint32_t>> lists;
  for (int k = 0; k < 6; ++k) lists.emplace_back(&pool);
  std::vector<std::uint32_t> numbers(lists.size());
  for (int step = 0; step < 60; ++step) {
    const std::size_t at = random() % lists.size();
    for (const std::uint32_t number : {0u, 1u}) {
      // The ends, and here and there between.
      for (std::size_t i = 0; i < lists[at].size();
           i += std::max<std::size_t>(1, lists[at].size() / 7 + number))
        ASSERT_EQ(lists[at][i], numbers[at]);
    }
    // From 64 KiB, where they are kept, to large pages; seldom too long a one.
    const std::size_t length =
        own == 0 && step == 30
            ? std::size_t{17} << 20
            : (std::size_t{1} << 12) << random() % 9 | random() % 4096;
    numbers[at] = own + 16 * static_cast<std::uint32_t>(step);
    lists[at].clear();
    lists[at].shrink_to_fit();
    lists[at].assign(length, numbers[at]);
  }
}

TEST(HugePagePool, GivesEveryListMemoryOfItsOwn) {
  HugePagePool pool;
  std::vector<std::thread> threads;
  for (std::uint32_t own = 0; own < 4; ++own)
    threads.emplace_back(expect_lists_apart, std::ref(pool), own);
  for (std::thread& thread : threads) thread.join();
}

/// Under sanitizers nothing is kept, so that they see what is used too late.
TEST(HugePagePool, GivesKeptBlocksLastInFirstOut) {
  if (kSanitized) return;
  HugePagePool pool;
  constexpr std::size_t kShortest = std::size_t{1} << 16;
  constexpr std::size_t kLongest = std::size_t{1} << 26;
  std::vector<void*> other;
  for (std::size_t bytes = kShortest; bytes <= kLongest; bytes *= 2) {
    void* const memory = pool.allocate(bytes);
    // A second block of that size, so that the first is not the only one.
    other.push_back(pool.allocate(bytes));
    pool.deallocate(memory, bytes);
    EXPECT_EQ(pool.allocate(bytes), memory) << bytes;
    pool.deallocate(memory, bytes);
    pool.deallocate(other.back(), bytes);
    // The last that was given back is the first to be taken.
    EXPECT_EQ(pool.allocate(bytes), other.back()) << bytes;
    pool.deallocate(other.back(), bytes);
  }
}

/// What this process has in memory.
std::size_t resident_bytes() {
  std::ifstream file("/proc/self/statm");
  std::size_t all = 0;
  std::size_t resident = 0;
  file >> all >> resident;
  return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

TEST(HugePagePool, KeepsNoMoreThanItSays) {
  if (kSanitized) return;
  HugePagePool pool;
  constexpr std::size_t kMost = std::size_t{1} << 27;
  constexpr std::size_t kEach = std::size_t{1} << 25;
  const auto use_six = [&pool] {
    std::array<void*, 6> memory;
    for (void*& m : memory) {
      m = pool.allocate(kEach);
      std::fill_n(static_cast<char*>(m), kEach, 'x');
    }
    const std::size_t used = resident_bytes();
    for (void* m : memory) pool.deallocate(m, kEach);
    return used;
  };
  const std::size_t used = use_six();
  const double given_back = double(used) - double(resident_bytes());
  EXPECT_NEAR(given_back, double(6 * kEach - kMost), 0x1p20);
  // What is kept is used: it takes no more than the first time.
  EXPECT_LT(use_six(), used + kEach);
}

TEST(HugePagePool, AlignsLongBlocksToHugePages) {
  constexpr std::size_t kPage = std::size_t{1} << 21;
  HugePagePool pool;
  for (const std::size_t bytes :
       {kPage / 2, kPage - 1, kPage, 3 * kPage + 5, 32 * kPage, 40 * kPage}) {
    void* const memory = pool.allocate(bytes);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(memory) % kPage, 0u) << bytes;
    std::fill_n(static_cast<char*>(memory), bytes, 'x');
    pool.deallocate(memory, bytes);
  }
}

TEST(HugePagePool, GivesBackItsBlocksWhenDestroyed) {
  if (kSanitized) return;
  constexpr std::size_t kBytes = std::size_t{1} << 26;
  const std::size_t before = resident_bytes();
  {
    HugePagePool pool;
    void* const memory = pool.allocate(kBytes);
    std::fill_n(static_cast<char*>(memory), kBytes, 'x');
    pool.deallocate(memory, kBytes);
    EXPECT_GT(resident_bytes(), before + kBytes / 2);
  }
  EXPECT_LT(resident_bytes(), before + kBytes / 2);
}

/// The library changes no global state: its lists use what the program set.
TEST(List, UsesTheDefaultResourceOfTheProgram) {
  HugePagePool pool;
  EXPECT_EQ(List<int>().get_allocator().resource(),
            std::pmr::get_default_resource());
  auto* const before = std::pmr::set_default_resource(&pool);
  EXPECT_EQ(List<int>().get_allocator().resource(), &pool);
  std::pmr::set_default_resource(before);
}

}  // namespace
}  // namespace halfspace::fast
