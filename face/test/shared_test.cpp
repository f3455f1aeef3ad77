#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

#include "halfspace/halfspace.hpp"

namespace halfspace {
namespace {

/// What each thread does, all with the same operands: it checks one, repairs
/// one, combines, measures, and writes.
std::string worked(const std::vector<Solid>& shared, std::size_t thread) {
  const Solid& plate = shared[0];
  const Solid& crossing = shared[1];
  const Solid drill = shared[2].translated({0.25, 0, 0});
  const Solid part = (plate - drill) + crossing;
  const Solid other = thread % 2 == 0 ? part ^ shared[3] : part & shared[3];
  std::string said = *part.exact_volume() + " " + *other.exact_volume();
  said += std::to_string(*part.genus());
  said += *plate.locate({1, 1, 0.5}) == Location::kInside ? " in" : " out";
  said += *part.touches(shared[3]) ? " touches" : "";
  const std::string file = "shared_" + std::to_string(thread) + ".off";
  if (!part.save(file)) return "not saved";
  said += *Solid::from_file(file).exact_volume();
  said += std::to_string(part.mesh()->polygon_count());
  return said;
}

std::vector<Solid> operands() {
  Mesh two = *Solid::box({0, 0, 0}, {2, 2, 2}).mesh();
  const Mesh more = *Solid::box({1, 1, 1}, {3, 3, 3}).mesh();
  for (std::size_t p = 0; p < more.polygon_count(); ++p) {
    std::vector<std::int32_t> corners;
    for (const std::int32_t c : more.corners_of(p)) corners.push_back(c + 8);
    two.add(corners);
  }
  two.vertices.insert(two.vertices.end(), more.vertices.begin(),
                      more.vertices.end());
  two.origins.clear();
  return {Solid::box({0, 0, 0}, {4, 3, 1}),
          Solid::from_mesh(two, {.resolve = true}),
          Solid::cylinder(0.5, 3, 12).translated({1, 1, -1}),
          Solid::sphere(2, 12)};
}

TEST(FaceShared, EightThreadsUseTheSameOperandsAtOnce) {
  constexpr std::size_t kThreads = 8;
  const std::vector<Solid> alone = operands(), shared = operands();
  std::vector<std::string> said(kThreads);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < kThreads; ++i)
    threads.emplace_back([&, i] { said[i] = worked(shared, i); });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < kThreads; ++i)
    EXPECT_EQ(said[i], worked(alone, i)) << i;
}

}  // namespace
}  // namespace halfspace
