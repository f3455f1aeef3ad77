#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "halfspace/fast/boolean.hpp"
#include "lattice.hpp"
#include "solid/move_to_table.hpp"

namespace halfspace::fast {
namespace {

Solid random_solid(std::uint64_t& state) {
  return to_solid(lattice::surface(lattice::random_cubes(1, state)));
}

TEST(BooleanTables, AreThoseUsedMoreOftenOneWay) {
  std::uint64_t state = 5;
  Solid solid = random_solid(state);
  EXPECT_TRUE(bad_edges(solid).empty());
  // Some edges are dropped, others are there twice or the other way round.
  List<SolidEdge> torn;
  std::map<std::pair<std::int32_t, std::int32_t>, std::int64_t> counts;
  for (std::size_t i = 0; i < solid.edges.size(); ++i) {
    SolidEdge edge = solid.edges[i];
    if (i % 7 == 1) std::swap(edge.from, edge.to);
    for (std::size_t k = i % 11 == 2 ? 1 : 0; k < (i % 5 == 3 ? 2 : 1); ++k) {
      torn.push_back(edge);
      const auto ends = std::minmax(edge.from, edge.to);
      counts[ends] += edge.from < edge.to ? 1 : -1;
    }
  }
  solid.edges = torn;
  std::vector<BadEdge> expected;
  std::size_t twice = 0, up = 0;
  for (const auto& [ends, count] : counts) {
    if (count > 0) expected.push_back({ends.first, ends.second, count});
    if (count < 0) expected.push_back({ends.second, ends.first, -count});
    if (count > 1 || count < -1) ++twice;
    if (count > 0) ++up;
  }
  EXPECT_GT(twice, 10u);
  EXPECT_GT(up, 10u);
  EXPECT_GT(expected.size(), up + 10);
  EXPECT_EQ(bad_edges(solid), expected);
  // Ids of a table of many solids are far apart.
  for (SolidEdge& edge : solid.edges) {
    edge.from = 1'000'000 + 977 * edge.from;
    edge.to = 1'000'000 + 977 * edge.to;
  }
  for (BadEdge& edge : expected) {
    edge.from = 1'000'000 + 977 * edge.from;
    edge.to = 1'000'000 + 977 * edge.to;
  }
  EXPECT_EQ(bad_edges(solid), expected);
}

/// A tetrahedron through which no edge of cubes goes along its own.
Solid tetrahedron(const Solid& with) {
  SceneData data;
  data.vertices = {{1, 1, 1}, {7, 2, 3}, {2, 7, 3}, {3, 2, 7}};
  for (const std::vector<VertexId>& corners :
       std::vector<std::vector<VertexId>>{
           {0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}) {
    data.corners.insert(data.corners.end(), corners.begin(), corners.end());
    data.first_corner.push_back(
        static_cast<std::uint32_t>(data.corners.size()));
    data.colors.push_back({});
  }
  return to_solid(*make_solid(*make_scene(std::move(data))), with);
}

TEST(BooleanTables, AMovedSolidComesBackAsItWas) {
  std::uint64_t state = 7;
  const Solid cubes = random_solid(state);
  const Solid few = tetrahedron(cubes);
  const Solid both = boolean(BooleanOp::kIntersection, few, cubes);
  const GeometryTable& from = *cubes.table;
  // The first has so few vertices that they are looked up by name; the second
  // has points that are not on the grid.
  EXPECT_GT(from.vertex_count(),
            16 * (few.faces.size() + 3 * few.edges.size()));
  EXPECT_TRUE(std::any_of(
      both.edges.begin(), both.edges.end(),
      [&](const SolidEdge& e) { return !from.vertex(e.from).is_grid(); }));
  for (const Solid& solid : {few, both, cubes}) {
    TableLease other = TableLease::of_new(from.grid_bits());
    const Solid moved = moved_to(solid, other);
    EXPECT_LE(other.table().vertex_count(), solid.edges.size());
    EXPECT_EQ(moved.table, other.shared());
    TableLease own = *TableLease::of(solid.table);
    const Solid back = moved_to(moved, own);
    EXPECT_TRUE(back.edges == solid.edges);
    for (std::size_t f = 0; f < solid.faces.size(); ++f)
      EXPECT_EQ(back.faces[f].plane, solid.faces[f].plane);
  }
}

TEST(BooleanTables, AreThePartsAboveAndBelowThePlane) {
  std::uint64_t state = 9;
  const lattice::Cubes cubes = lattice::random_cubes(2, state);
  const Halves halves = split(to_solid(lattice::surface(cubes)),
                              {{{0, 0, 5}, {1, 0, 5}, {0, 1, 5}}});
  for (const bool above : {false, true}) {
    lattice::Cubes part = cubes;
    for (std::size_t i = 0; i < part.full.size(); ++i)
      part.full[i] = part.full[i] && (i % 8 >= 5) == above;
    bool whole = false;
    EXPECT_EQ(
        lattice::outline(above ? halves.positive : halves.negative, whole),
        lattice::outline(part));
    EXPECT_TRUE(whole);
  }
}

}  // namespace
}  // namespace halfspace::fast
