#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "halfspace/fast/boolean.hpp"
#include "halfspace/fast/solid/canonical_solid.hpp"
#include "halfspace/fast/solid_data.hpp"
#include "halfspace/solid_file.hpp"
#include "table/shared_table.hpp"

namespace halfspace::fast {
namespace {

using Points = std::array<GridPoint, 4>;

/// A tetrahedron in halves, its points so often as far from the origin.
Solid tetrahedron(const Points& points, std::int64_t times, const Unit& unit,
                  int bits) {
  SceneData data;
  data.unit = unit;
  data.grid_bits = bits;
  for (const GridPoint& p : points)
    data.vertices.push_back({p.x * times, p.y * times, p.z * times});
  data.corners = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
  data.first_corner = {0, 3, 6, 9, 12};
  data.colors.resize(4);
  return to_solid(*make_solid(*make_scene(std::move(data))));
}

std::int64_t volume6(const Points& p) {
  const auto d = [&](std::size_t i) {
    return std::array{p[i].x - p[0].x, p[i].y - p[0].y, p[i].z - p[0].z};
  };
  const auto [a, b, c] = d(1);
  const auto [e, f, g] = d(2);
  const auto [h, i, j] = d(3);
  return a * (f * j - g * i) + b * (g * h - e * j) + c * (e * i - f * h);
}

class CanonicalSolid : public ::testing::Test {
 protected:
  Points points() {
    while (true) {
      Points p;
      for (GridPoint& at : p) at = {number(), number(), number()};
      if (volume6(p) < 0) std::swap(p[2], p[3]);
      if (volume6(p) > 0) return p;
    }
  }
  std::int64_t number() {
    return static_cast<std::int64_t>(random_() % 19) - 9;
  }
  std::mt19937 random_{7};
};

std::string file_of(const Solid& solid) {
  SolidData data = data_of(canonical_for_file(solid), {"a", "b"});
  data.grid_bits = 54;
  return write_solid(data, SolidForm::kText);
}

/// Whichever grid it was made on, decimal or not, a solid's file is the same.
TEST_F(CanonicalSolid, ItsUnitAndPointsAreItsOwn) {
  int meets = 0, fine = 0;
  for (int k = 0; k < 60; ++k) {
    const Points a = points(), b = points();
    const auto made = [&](std::int64_t times, const Unit& unit, int bits) {
      return boolean(BooleanOp::kIntersection,
                     tetrahedron(a, times, unit, bits),
                     tetrahedron(b, times, unit, bits));
    };
    const Solid coarse = made(1, {2, -1}, 26);
    const std::string file = file_of(coarse);
    EXPECT_EQ(file_of(made(5, {10, -1}, 26)), file);
    EXPECT_EQ(file_of(made(8, {2, -4}, 40)), file);
    EXPECT_EQ(file_of(made(500, {10, -3}, 40)), file);
    EXPECT_EQ(file_of(made(std::int64_t{1} << 40, {2, -41}, 54)), file);
    meets += file.find("\nmeet ") != std::string::npos ? 1 : 0;
    fine += file.find("unit 2 -1") != std::string::npos ? 1 : 0;
  }
  EXPECT_GT(meets, 20);
  EXPECT_GT(fine, 10);
}

/// A vertex at thirds is on no grid; at sixteenths it is on one.
TEST_F(CanonicalSolid, APointOfSomeGridIsFound) {
  const auto cut = [](std::int64_t by) {
    // Below the plane through (0, 0, 1), (by, 0, 2) and (0, 1, 1).
    const Solid whole = tetrahedron(
        {GridPoint{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 2, {10, 0}, 26);
    return boolean(
        BooleanOp::kIntersection, whole,
        half_space({GridPoint{0, 0, 1}, {by, 0, 2}, {0, 1, 1}}, whole));
  };
  const auto fine = on_points(cut(15));
  ASSERT_TRUE(fine);
  EXPECT_EQ(fine->unit, (Unit{2, -4}));
  for (const SolidEdge& edge : fine->edges)
    EXPECT_TRUE(vertex_at(*fine, edge.from).is_grid);
  EXPECT_EQ(file_of(*fine), file_of(cut(15)));
  EXPECT_FALSE(on_points(cut(2)));
}

/// All that faces say in numbers.
std::vector<std::array<std::int64_t, 8>> numbers_of(const Solid& solid) {
  std::vector<std::array<std::int64_t, 8>> numbers;
  for (const Face& f : solid.faces) {
    numbers.push_back({f.plane, f.flipped, f.from_first, f.source, f.part,
                       f.polygon, f.first_edge, f.edge_count});
  }
  return numbers;
}

/// What is most of its table is copied, what is little of it made anew.
TEST_F(CanonicalSolid, ACopyHasTheIdsAndNumbersOfWhatIsMadeAnew) {
  std::size_t meets = 0;
  for (int k = 0; k < 60; ++k) {
    const int bits = std::array{26, 40, 54}[static_cast<std::size_t>(k % 3)];
    const auto random = [&] { return tetrahedron(points(), 1, {2, 0}, bits); };
    const Solid made =
        boolean(BooleanOp::kDifference,
                boolean(BooleanOp::kUnion, random(), random()), random());
    if (made.faces.empty()) continue;
    const Solid copy = canonical(made);
    {
      auto lease = TableLease::of(made.table);
      ASSERT_TRUE(lease);
      for (std::int64_t i = 0; i < 2000; ++i)
        lease->table().add_point({1000 + i, -i, i});
    }
    const Solid anew = canonical(made);
    ASSERT_EQ(numbers_of(copy), numbers_of(anew));
    ASSERT_EQ(copy.edges, anew.edges);
    const GeometryTable& x = *copy.table;
    const GeometryTable& y = *anew.table;
    ASSERT_EQ(x.plane_count(), y.plane_count());
    ASSERT_EQ(x.vertex_count(), y.vertex_count());
    for (std::int32_t p = 0; p < static_cast<std::int32_t>(x.plane_count());
         ++p) {
      const auto m = x.normal(p), n = y.normal(p);
      EXPECT_TRUE(m.x == n.x && m.y == n.y && m.z == n.z);
      EXPECT_EQ(x.plane(p).origin, y.plane(p).origin);
    }
    for (std::int32_t v = 0; v < static_cast<std::int32_t>(x.vertex_count());
         ++v) {
      EXPECT_EQ(x.vertex(v).is_grid(), y.vertex(v).is_grid());
      EXPECT_EQ(x.vertex(v).planes, y.vertex(v).planes);
      bool rounded = false, also = false;
      EXPECT_EQ(x.nearest(v, rounded), y.nearest(v, also));
      EXPECT_EQ(rounded, also);
      meets += x.vertex(v).is_grid() ? 0u : 1u;
    }
    // Points and planes are found again.
    const Solid other = random();
    const Solid on = boolean(BooleanOp::kUnion, copy, other);
    const Solid again = boolean(BooleanOp::kUnion, anew, other);
    EXPECT_EQ(numbers_of(on), numbers_of(again));
    EXPECT_EQ(on.edges, again.edges);
    EXPECT_EQ(on.table->vertex_count(), again.table->vertex_count());
    EXPECT_EQ(boolean(BooleanOp::kDifference, copy, made).faces.size(), 0u);
  }
  EXPECT_GT(meets, 100u);
}

}  // namespace
}  // namespace halfspace::fast
