#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

#include "halfspace/fast/boolean.hpp"
#include "halfspace/fast/solid/merged_copy.hpp"
#include "halfspace/fast/to_mesh.hpp"
#include "lattice.hpp"
#include "scenes.hpp"
#include "solid/loops.hpp"

namespace halfspace::fast {
namespace {

TEST(MergeFaces, FacesThatLookOppositeWaysStay) {
  const Solid sheet =
      solid_of({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}, {2, 1, 0}});
  EXPECT_EQ(merge_faces(sheet, Merge::kPlane).faces.size(), 2u);
}

/// A block of two cubes, its upper and lower faces in halves, and on the edge
/// between the upper ones, if asked for, a tetrahedron.
Solid block(bool with_tetrahedron) {
  const std::vector<GridPoint> vertices = {
      {0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0},
      {2, 1, 0}, {0, 0, 1}, {1, 0, 1}, {2, 0, 1}, {0, 1, 1},
      {1, 1, 1}, {2, 1, 1}, {0, 0, 3}, {2, 0, 3}};
  std::vector<std::vector<VertexId>> polygons = {
      {0, 3, 4, 1},       {1, 4, 5, 2},         {6, 7, 10, 9}, {7, 8, 11, 10},
      {0, 1, 2, 8, 7, 6}, {3, 9, 10, 11, 5, 4}, {0, 6, 9, 3},  {2, 5, 11, 8}};
  if (with_tetrahedron) {
    for (const auto& face : std::vector<std::vector<VertexId>>{
             {7, 12, 10}, {7, 10, 13}, {7, 13, 12}, {10, 12, 13}})
      polygons.push_back(face);
  }
  return solid_of(vertices, polygons);
}

TEST(MergeFaces, AHalfOfSpaceStays) {
  const Solid half =
      half_space({GridPoint{0, 0, 0}, GridPoint{1, 0, 0}, GridPoint{0, 1, 0}},
                 block(false));
  EXPECT_EQ(merge_faces(half, Merge::kPlane).faces.size(), 1u);
}

TEST(MergeFaces, EdgesWhereTheSurfaceTouchesItselfStay) {
  EXPECT_EQ(merge_faces(block(false), Merge::kPlane).faces.size(), 6u);
  EXPECT_EQ(merge_faces(block(true), Merge::kPlane).faces.size(), 7u + 4u);
}

/// A face's plane, which way it looks, and its edges.
using Shape = std::tuple<std::int32_t, bool, std::vector<SolidEdge>>;

std::vector<Shape> shapes_of(const Solid& solid) {
  std::vector<Shape> shapes;
  std::size_t edge_count = 0;
  for (const Face& face : solid.faces) {
    const auto first = solid.edges.begin() + std::ptrdiff_t{face.first_edge};
    shapes.emplace_back(
        face.plane, face.flipped,
        std::vector<SolidEdge>(first, first + std::ptrdiff_t{face.edge_count}));
    EXPECT_TRUE(face.box == face_box(solid, face));
    edge_count += face.edge_count;
  }
  EXPECT_EQ(edge_count, solid.edges.size());
  return shapes;
}

TEST(MergeFaces, BitByBitIsAsAtOnce) {
  // What is merged takes other places than what stays.
  std::uint64_t state = 23;
  for (int round = 0; round < 6; ++round) {
    Solid solid = to_solid(lattice::surface(lattice::random_cubes(3, state)));
    for (std::size_t f = 0; f < solid.faces.size(); ++f)
      solid.faces[f].color.r = static_cast<std::uint8_t>(f / 3 % 3);
    const Solid colors = merge_faces(solid, Merge::kColor);
    const Solid planes = merge_faces(solid, Merge::kPlane);
    EXPECT_LT(colors.faces.size(), solid.faces.size());
    EXPECT_LT(planes.faces.size(), colors.faces.size());
    EXPECT_FALSE(std::is_sorted(colors.faces.begin(), colors.faces.end(),
                                [](const Face& f, const Face& g) {
                                  return f.first_edge < g.first_edge;
                                }));
    EXPECT_TRUE(shapes_of(merge_faces(colors, Merge::kPlane)) ==
                shapes_of(planes));
    EXPECT_TRUE(bad_edges(planes).empty());
  }
}

/// The surface of random cubes in triangles, two for each of their sides.
Solid triangles(int lump, std::uint64_t& state) {
  SceneData data =
      lattice::surface(lattice::random_cubes(lump, state)).scene().data();
  std::vector<VertexId> corners;
  for (std::size_t c = 0; c < data.corners.size(); c += 4) {
    const VertexId* at = data.corners.data() + c;
    corners.insert(corners.end(), {at[0], at[1], at[2], at[0], at[2], at[3]});
  }
  data.corners = corners;
  data.first_corner.resize(1);
  for (std::size_t c = 3; c <= corners.size(); c += 3)
    data.first_corner.push_back(static_cast<std::uint32_t>(c));
  data.colors.assign(corners.size() / 3, {});
  return to_solid(*make_solid(*make_scene(std::move(data))));
}

/// The solid with each face's edges in another order; or its loops, some of
/// which begin with other edges.
Solid shuffled(Solid solid, bool loops, std::mt19937& random) {
  for (const Face& face : solid.faces) {
    const auto begin = solid.edges.begin() + std::ptrdiff_t{face.first_edge};
    const auto end = begin + std::ptrdiff_t{face.edge_count};
    if (!loops) {
      std::shuffle(begin, end, random);
      continue;
    }
    std::vector<std::vector<SolidEdge>> all;
    for (auto e = begin; e != end; ++e) {
      if (e == begin || e->from != (e - 1)->to ||
          e->from == all.back().front().from)
        all.emplace_back();
      all.back().push_back(*e);
    }
    std::reverse(all.begin(), all.end());
    auto to = begin;
    for (auto& loop : all) {
      // trace_loops() begins with the least vertex.
      auto start = std::min_element(loop.begin(), loop.end(),
                                    [](const SolidEdge& x, const SolidEdge& y) {
                                      return x.from < y.from;
                                    });
      if (random() % 4 == 0)
        start = loop.begin() + std::ptrdiff_t(random() % loop.size());
      std::rotate(loop.begin(), start, loop.end());
      to = std::copy(loop.begin(), loop.end(), to);
    }
  }
  return solid;
}

TEST(MergeFaces, ACopyHasTheMeshThatMergingGives) {
  std::uint64_t state = 29;
  int copies = 0, kept = 0;
  for (int round = 0; round < 40; ++round) {
    const Solid a = to_solid(lattice::surface(lattice::random_cubes(3, state)));
    const Solid b =
        to_solid(lattice::surface(lattice::random_cubes(3, state)), a, 1);
    Solid solid = boolean(BooleanOp::kSymmetricDifference, a, b);
    // Some are merged already, by the same rule or by another one.
    if (round % 2 == 1) solid = merge_faces(std::move(solid), Merge::kPlane);
    for (const Merge rule : {Merge::kOrigin, Merge::kColor, Merge::kPlane}) {
      for (const bool triangles : {false, true}) {
        const std::optional<Solid> copy = merged_copy(solid, rule);
        const ExportedMesh found =
            to_mesh(copy ? *copy : solid, {.triangles = triangles});
        const Solid merged = merge_faces(solid, rule);
        const ExportedMesh wanted = to_mesh(merged, {.triangles = triangles});
        ASSERT_EQ(found.vertices, wanted.vertices);
        ASSERT_EQ(found.first_corner, wanted.first_corner);
        ASSERT_EQ(found.corners, wanted.corners);
        ASSERT_EQ(found.faces, wanted.faces);
        ASSERT_EQ(shapes_of(copy ? *copy : merged), shapes_of(merged));
        ++(copy ? copies : kept);
      }
    }
  }
  EXPECT_GT(copies, 60);
  EXPECT_GT(kept, 60);
}

TEST(MergeFaces, DoesNotDependOnTheOrderOfEdges) {
  std::mt19937 random(29);
  std::uint64_t state = 29;
  const auto check = [&](Solid solid) {
    for (Face& face : solid.faces)
      face.color.r = static_cast<std::uint8_t>(random() % 2);
    const Solid edges = shuffled(solid, false, random);
    const Solid loops = shuffled(solid, true, random);
    for (const Merge rule : {Merge::kOrigin, Merge::kColor, Merge::kPlane}) {
      const Solid least = merge_faces(solid, rule);
      EXPECT_TRUE(shapes_of(merge_faces(edges, rule)) == shapes_of(least));
      EXPECT_TRUE(shapes_of(merge_faces(loops, rule)) == shapes_of(least));
      // Where a face touches itself its loops may be others, but not what they
      // go round.
      for (const bool parted : {false, true}) {
        const ExportOptions options{.triangles = parted};
        const ExportedMesh once = to_mesh(least, options);
        const ExportedMesh twice = to_mesh(merge_faces(least, rule), options);
        EXPECT_EQ(once.corners, twice.corners);
        EXPECT_EQ(once.vertices, twice.vertices);
      }
    }
  };
  for (int round = 0; round < 2; ++round) {
    const Solid a = triangles(2, state);
    const Solid b = to_solid(
        lattice::surface(lattice::random_cubes(round % 2 + 1, state)), a);
    // Parts of the others' faces have a few short loops.
    const Solid c = merge_faces(
        to_solid(lattice::surface(lattice::random_cubes(4, state)), a),
        Merge::kPlane);
    const Solid d = merge_faces(b, Merge::kPlane);
    check(a);
    check(b);
    for (const BooleanOp operation :
         {BooleanOp::kUnion, BooleanOp::kIntersection,
          BooleanOp::kDifference}) {
      check(boolean(operation, a, b));
      check(boolean(operation, c, d));
    }
    check(merge_faces(boolean(BooleanOp::kUnion, a, b), Merge::kPlane));
    // Faces that touch themselves.
    for (int k = 0; k < 8; ++k) {
      check(merge_faces(
          to_solid(lattice::surface(lattice::random_cubes(4, state))),
          Merge::kPlane));
    }
  }
}

}  // namespace
}  // namespace halfspace::fast
