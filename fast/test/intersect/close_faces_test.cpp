#include "intersect/close_faces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "boolean/nonsense.hpp"
#include "boolean/shells.hpp"
#include "halfspace/fast/check_operand.hpp"
#include "halfspace/fast/resolve.hpp"
#include "halfspace/splitmix.hpp"
#include "intersect/self_intersections.hpp"
#include "intersect/self_radial_order.hpp"
#include "solid/move_to_table.hpp"

namespace halfspace::fast {
namespace {

using Pair = std::tuple<std::int32_t, std::int32_t, bool>;

std::vector<Pair> pairs_of(const std::vector<SelfIntersection>& found) {
  std::vector<Pair> pairs;
  for (const SelfIntersection& c : found)
    pairs.emplace_back(c.first, c.second, c.in_plane);
  return pairs;
}

/// How often CloseFaces was asked and did not know, and what was found.
struct Counts {
  std::size_t pairs = 0;
  std::size_t undecided = 0;
  std::size_t crossings = 0;
};

/// With the pairs that CloseFaces leaves, all is found that is found with all
/// pairs.
void expect_all_found(const Solid& solid, Counts& counts) {
  with_lease(solid, [&](const Solid& same, TableLease& lease) {
    const SelfContacts all = self_contacts(same, lease);
    const SurfaceEdges edges(same);
    EXPECT_EQ(edges.is_closed(), bad_edges(same).empty());
    const DynamicBvh index = index_of(same);
    const FacePairs pairs =
        undecided_pairs(same, lease.table(), edges, index, {});
    EXPECT_EQ(pairs, undecided_pairs(same, lease.table(), edges, index,
                                     {.threads = 2}));
    for (std::size_t f = 0; f < same.faces.size(); ++f)
      index.find(same.faces[f].box, [&](std::int32_t) { ++counts.pairs; });
    counts.undecided += pairs.size();
    const auto expected = pairs_of(self_intersections_of(all));
    counts.crossings += expected.size();
    EXPECT_EQ(pairs_of(self_intersections_of(
                  self_contacts(same, lease, edges, pairs))),
              expected);
    return 0;
  });
}

/// The surface in triangles, as to_mesh() makes them, and some of its corners
/// moved to others.
Solid in_triangles(const Solid& solid, std::uint64_t& state) {
  const ExportedMesh mesh = to_mesh(solid, {.triangles = true});
  SceneData data;
  for (const auto& v : mesh.vertices) {
    GridPoint p{static_cast<std::int64_t>(v[0]),
                static_cast<std::int64_t>(v[1]),
                static_cast<std::int64_t>(v[2])};
    if (mix(++state) % 16 == 0) p.z += 1;
    data.vertices.push_back(p);
  }
  for (std::size_t t = 0; 3 * t < mesh.corners.size(); ++t) {
    SceneData one = data;
    one.corners.assign(mesh.corners.begin() + 3 * static_cast<int>(t),
                       mesh.corners.begin() + 3 * static_cast<int>(t) + 3);
    one.first_corner = {0, 3};
    one.colors.resize(1);
    // Those that moving left without area stay away.
    if (!make_scene(one)) continue;
    data.corners.insert(data.corners.end(), one.corners.begin(),
                        one.corners.end());
    data.first_corner.push_back(
        static_cast<std::uint32_t>(data.corners.size()));
  }
  data.colors.resize(data.first_corner.size() - 1);
  const Result<Scene> scene = make_scene(data);
  const Result<GridSolid> made = make_solid(*scene);
  return made ? to_solid(*made) : solid;
}

TEST(CloseFaces, WithoutPairsThatOnlyShareCornersAllIsFound) {
  Counts counts;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Solid solid = nonsense(seed);
    expect_all_found(solid, counts);
    expect_all_found(resolve(solid).solid, counts);
  }
  EXPECT_GT(counts.crossings, 1000u);
  EXPECT_GT(counts.undecided, 1000u);
}

TEST(CloseFaces, CubesInTrianglesAreMostlyDecided) {
  std::uint64_t state = 5;
  Counts fine, crossing;
  for (int i = 0; i < 30; ++i) {
    SCOPED_TRACE("row " + std::to_string(i));
    const Cubes a = lattice::random_cubes(1 + i % 3, state);
    const Cubes b = lattice::random_cubes(1 + i % 3, state);
    const Solid one = to_solid(lattice::surface(a));
    expect_all_found(one, fine);
    expect_all_found(in_triangles(one, state), fine);
    Solid both = one;
    add_surface(b, false, i % 2 == 0, both);
    expect_all_found(both, crossing);
  }
  EXPECT_GT(crossing.crossings, 1000u);
  EXPECT_LT(3 * fine.undecided, fine.pairs);
}

/// Two fans of triangles over one ring of points, which may cross itself, and
/// wind round the tips more than once or not at all; nothing if a triangle has
/// no area.
std::optional<Solid> double_cone(int count, int step, std::uint64_t& state) {
  SceneData data;
  const auto random = [&](std::int64_t range) {
    return static_cast<std::int64_t>(
               mix(++state) % static_cast<std::uint64_t>(2 * range + 1)) -
           range;
  };
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * step * i / count;
    data.vertices.push_back({std::llround(20 * std::cos(angle)) + random(3),
                             std::llround(20 * std::sin(angle)) + random(3),
                             random(4)});
  }
  data.vertices.push_back({random(9), random(9), 10 + random(6)});
  data.vertices.push_back({random(9), random(9), -10 + random(6)});
  for (int i = 0; i < count; ++i) {
    const VertexId from = i, to = (i + 1) % count;
    for (const VertexId corner : {from, to, count, to, from, count + 1})
      data.corners.push_back(corner);
    data.first_corner.push_back(static_cast<std::uint32_t>(6 * i + 3));
    data.first_corner.push_back(static_cast<std::uint32_t>(6 * i + 6));
  }
  data.colors.resize(data.first_corner.size() - 1);
  Result<Scene> scene = make_scene(data);
  if (!scene) return {};
  return to_solid(*make_solid(*std::move(scene)));
}

TEST(CloseFaces, TrianglesRoundACornerThatTurnOnceAreSettled) {
  std::uint64_t state = 11;
  Counts once, more;
  for (int i = 0; i < 600; ++i) {
    SCOPED_TRACE("cone " + std::to_string(i));
    const int count = 3 + i % 6;
    if (const auto solid = double_cone(count, 1, state))
      expect_all_found(*solid, once);
    if (const auto solid = double_cone(count, 2 + i % 2, state))
      expect_all_found(*solid, more);
  }
  EXPECT_GT(more.crossings, 1000u);
  EXPECT_LT(20 * once.undecided, once.pairs);
}

TEST(CloseFaces, WhoShowsProgressMayStop) {
  const Solid solid = to_solid(lattice::surface(block(0, 6, 6)));
  const auto checked = [&](bool goes_on) {
    return check_operand(solid, {.progress = [=](double) { return goes_on; }});
  };
  EXPECT_TRUE(checked(true));
  ASSERT_FALSE(checked(false));
  EXPECT_EQ(checked(false).error().code, ErrorCode::kStopped);
}

}  // namespace
}  // namespace halfspace::fast
