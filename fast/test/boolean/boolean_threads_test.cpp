// Results do not depend on the number of threads.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cases.hpp"
#include "halfspace/fast/boolean.hpp"
#include "halfspace/fast/chain.hpp"
#include "halfspace/fast/to_mesh.hpp"
#include "lattice.hpp"
#include "table/shared_table.hpp"

namespace halfspace::fast {
namespace {

using lattice::Cubes;

bool same_export(const ExportedMesh& a, const ExportedMesh& b) {
  return a.vertices == b.vertices && a.first_corner == b.first_corner &&
         a.corners == b.corners && a.colors == b.colors &&
         a.points == b.points && a.faces == b.faces && a.flipped == b.flipped &&
         a.moved == b.moved && a.max_move == b.max_move;
}

/// The same faces, edge by edge.
bool same_solid(const Solid& a, const Solid& b) {
  if (a.edges != b.edges || a.faces.size() != b.faces.size()) return false;
  for (std::size_t f = 0; f < a.faces.size(); ++f) {
    const Face& x = a.faces[f];
    const Face& y = b.faces[f];
    if (x.plane != y.plane || x.flipped != y.flipped || x.source != y.source ||
        x.from_first != y.from_first || x.first_edge != y.first_edge ||
        x.edge_count != y.edge_count)
      return false;
  }
  return true;
}

/// The same points and planes, by id.
bool same_table(const SharedTable& a, const SharedTable& b) {
  if (a.plane_count() != b.plane_count() ||
      a.vertex_count() != b.vertex_count())
    return false;
  for (std::size_t i = 0; i < a.plane_count(); ++i) {
    const auto p = static_cast<std::int32_t>(i);
    if (!(a.normal(p) == b.normal(p)) ||
        !(a.plane(p).origin == b.plane(p).origin))
      return false;
  }
  for (std::size_t i = 0; i < a.vertex_count(); ++i) {
    const TableVertex& v = a.vertex(static_cast<std::int32_t>(i));
    const TableVertex& w = b.vertex(static_cast<std::int32_t>(i));
    if (v.planes != w.planes || v.exact != w.exact ||
        v.approximate.x != w.approximate.x ||
        v.approximate.y != w.approximate.y ||
        v.approximate.z != w.approximate.z)
      return false;
  }
  return true;
}

/// Blocks of cubes that stand apart, under a linear map, on grids of some
/// width: of two such maps, no two solids have a plane in common but by chance.
struct Shape {
  int bits = 26;
  int map = 0;
  bool triangles = false;  ///< each square in two, which are in one plane

  /// Requires: 27 blocks at most.
  GridSolid of(const std::vector<Cubes>& blocks) const {
    SceneData data;
    for (std::size_t k = 0; k < blocks.size(); ++k)
      add(lattice::surface(blocks[k]).scene().data(), k, data);
    // 27 steps of a cube come to less than half of the grid.
    const std::int64_t size = std::int64_t{1} << (bits - 7);
    const std::int64_t most = size - 1 - 2 * map;
    for (GridPoint& p : data.vertices) {
      p = {most * p.x + map * (size / 7) * p.y + 3 * map,
           most * p.y + map * (size / 9) * p.z - 5 * map,
           most * p.z - map * (size / 11) * p.x + map};
    }
    data.grid_bits = bits;
    if (triangles) divide(data);
    return *make_solid(*make_scene(std::move(data)));
  }

 private:
  static void add(const SceneData& block, std::size_t k, SceneData& to) {
    constexpr std::int64_t kApart = lattice::kSize + 1;
    const auto at = static_cast<std::int64_t>(k);
    const auto vertices = static_cast<VertexId>(to.vertices.size());
    const auto corners = static_cast<std::uint32_t>(to.corners.size());
    for (const GridPoint& p : block.vertices) {
      to.vertices.push_back({p.x + kApart * (at % 3 - 1),
                             p.y + kApart * (at / 3 % 3 - 1),
                             p.z + kApart * (at / 9 - 1)});
    }
    for (const VertexId v : block.corners) to.corners.push_back(vertices + v);
    for (std::size_t p = 1; p < block.first_corner.size(); ++p)
      to.first_corner.push_back(corners + block.first_corner[p]);
    to.colors.insert(to.colors.end(), block.colors.begin(), block.colors.end());
  }
  static void divide(SceneData& data) {
    std::vector<VertexId> corners;
    std::vector<Rgb> colors;
    for (std::size_t p = 0; p + 1 < data.first_corner.size(); ++p) {
      const VertexId* c = data.corners.data() + data.first_corner[p];
      corners.insert(corners.end(), {c[0], c[1], c[2], c[0], c[2], c[3]});
      if (!data.colors.empty()) colors.insert(colors.end(), 2, data.colors[p]);
    }
    data.corners = std::move(corners);
    data.colors = std::move(colors);
    data.corner_colors.clear();
    data.first_corner.clear();
    for (std::uint32_t at = 0; at <= data.corners.size(); at += 3)
      data.first_corner.push_back(at);
  }
};

/// What booleans of two solids added to their table.
struct Added {
  std::size_t planes = 0;
  std::size_t points = 0;
};

/// Fails where a boolean, its table or its output depends on threads.
void expect_the_same(BooleanOp operation, const GridSolid& a,
                     const GridSolid& b, Added& added) {
  std::optional<Solid> expected;
  std::optional<ExportedMesh> mesh;
  for (const int threads : {1, 2, 3}) {
    SCOPED_TRACE(std::to_string(threads) + " threads");
    const Solid first = to_solid(a);
    const Solid second = to_solid(b, first, 1);
    const std::size_t planes = first.table->plane_count();
    const std::size_t points = first.table->vertex_count();
    const Solid result = boolean(operation, first, second, threads);
    ASSERT_EQ(result.table, first.table);
    const ExportedMesh written =
        to_mesh(result, {.triangles = true, .threads = threads});
    if (!expected) {
      expected = result;
      mesh = written;
      added = {result.table->plane_count() - planes,
               result.table->vertex_count() - points};
      continue;
    }
    ASSERT_TRUE(same_solid(result, *expected));
    ASSERT_TRUE(same_table(*result.table, *expected->table));
    ASSERT_TRUE(same_export(written, *mesh));
  }
}

BooleanOp operation_of(std::uint64_t row) {
  return std::array{BooleanOp::kUnion, BooleanOp::kIntersection,
                    BooleanOp::kDifference}[row % 3];
}

TEST(FastThreads, BooleansOfManyShapesAreTheSameByAnyNumberOfThem) {
  std::uint64_t state = 41;
  std::size_t with_new_planes = 0, with_meets = 0;
  for (std::uint64_t row = 0; row < cases(48); ++row) {
    SCOPED_TRACE("row " + std::to_string(row));
    // In one plane or not, the same cubes in part or not.
    const int bits = std::array{26, 40, 54}[row % 3];
    const Shape shape{bits, static_cast<int>(row / 3 % 2), row % 4 == 0};
    const Shape other{bits, row % 5 < 2 ? shape.map : 2, row % 8 < 4};
    const Cubes a = lattice::random_cubes(row % 7 == 0 ? 2 : 1, state);
    Cubes b = lattice::random_cubes(1, state);
    for (std::size_t k = 0; row % 3 == 1 && k < b.full.size() / 2; ++k)
      b.full[k] = a.full[k];
    Added added;
    expect_the_same(operation_of(row / 2), shape.of({a}), other.of({b}), added);
    if (HasFatalFailure()) return;
    with_new_planes += added.planes > 0;
    with_meets += added.points > 100;
  }
  EXPECT_GT(with_new_planes, 2u);
  EXPECT_GT(with_meets, 4u);
}

TEST(FastThreads, BooleansOfManyFacesAreTheSameByAnyNumberOfThem) {
  // Several parts of all that threads share.
  std::uint64_t state = 43;
  for (std::uint64_t row = 0; row < cases(8); ++row) {
    SCOPED_TRACE("row " + std::to_string(row));
    const int bits = row % 2 == 0 ? 26 : 54;
    const Shape shape{bits, 1, row % 4 == 3};
    const Shape other{bits, row % 3 == 2 ? 1 : 2, row % 4 > 1};
    std::vector<Cubes> a, b;
    for (int k = 0; k < 27; ++k) {
      a.push_back(lattice::random_cubes(1, state));
      b.push_back(row % 3 == 2 && k % 4 != 0 ? a.back()
                                             : lattice::random_cubes(1, state));
    }
    Added added;
    expect_the_same(operation_of(row), shape.of(a), other.of(b), added);
    if (HasFatalFailure()) return;
  }
}

TEST(FastThreads, ABooleanIsTheSameByAnyNumberOfThem) {
  // Enough faces for several blocks of them and of pairs.
  std::uint64_t state = 29;
  for (int pair = 0; pair < 2; ++pair) {
    const Cubes a = lattice::random_cubes(1, state);
    const Cubes b = lattice::random_cubes(1, state);
    for (const BooleanOp operation :
         {BooleanOp::kUnion, BooleanOp::kIntersection,
          BooleanOp::kDifference}) {
      std::optional<Solid> expected;
      std::optional<ExportedMesh> mesh;
      for (int threads = 1; threads <= 4; ++threads) {
        SCOPED_TRACE(std::to_string(threads) + " threads");
        const Solid first = to_solid(lattice::surface(a));
        const Solid second = to_solid(lattice::surface(b), first);
        const Solid result = boolean(operation, first, second, threads);
        const ExportedMesh written =
            to_mesh(result, {.triangles = true, .threads = threads});
        if (!expected) {
          expected = result;
          mesh = written;
          continue;
        }
        ASSERT_TRUE(same_solid(result, *expected));
        ASSERT_TRUE(same_export(written, *mesh));
      }
    }
  }
}

TEST(FastThreads, ManySolidsAreCombinedIntoTheSameMesh) {
  std::uint64_t state = 31;
  std::vector<Solid> solids;
  for (std::size_t i = 0; i < 45; ++i) {
    const Cubes cubes = lattice::random_cubes(i % 3 == 0 ? 1 : 4, state);
    Cubes few;
    for (std::size_t k = 0; k < few.full.size(); ++k)
      few.full[k] = cubes.full[k] && k / 64 % 5 == i % 5;
    const auto part = static_cast<std::int32_t>(i);
    // One of them has a table of its own.
    solids.push_back(i == 0 || i == 20
                         ? to_solid(lattice::surface(few), part)
                         : to_solid(lattice::surface(few), solids[0], part));
  }
  for (const BooleanOp operation :
       {BooleanOp::kUnion, BooleanOp::kIntersection, BooleanOp::kDifference}) {
    const ExportedMesh expected = to_mesh(boolean_all(operation, solids));
    for (int threads = 2; threads <= 4; ++threads) {
      const Solid result = boolean_all(operation, solids, threads);
      const ExportedMesh mesh = to_mesh(result);
      // Ids may differ: pairs of solids are moved to tables of their own.
      ASSERT_TRUE(mesh.vertices == expected.vertices);
      ASSERT_TRUE(mesh.first_corner == expected.first_corner);
      ASSERT_TRUE(mesh.corners == expected.corners);
      ASSERT_TRUE(mesh.colors == expected.colors);
    }
  }
}

}  // namespace
}  // namespace halfspace::fast
