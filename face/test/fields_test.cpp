#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <vector>

#include "halfspace/halfspace.hpp"

namespace halfspace {
namespace {

/// A mesh with the fields 4x - 2y + z + 8 and x at its corners, exactly, for
/// its coordinates are short.
Mesh with_fields(const Solid& solid) {
  Mesh mesh = *solid.mesh();
  mesh.origins.clear();
  mesh.field_count = 2;
  for (const std::int32_t corner : mesh.corners) {
    const Point& p = mesh.vertices[static_cast<std::size_t>(corner)];
    mesh.fields.push_back(4 * p.x - 2 * p.y + p.z + 8);
    mesh.fields.push_back(p.x);
  }
  return mesh;
}

/// Whether each corner has the fields of its point: exactly where doubles hold
/// the point, else but for the point's own rounding.
void expect_the_fields(const Mesh& mesh, double tolerance) {
  ASSERT_EQ(mesh.field_count, 2u);
  std::vector<double> at_vertex(2 * mesh.vertices.size(), HUGE_VAL);
  for (std::size_t i = 0; i < mesh.corners.size(); ++i) {
    const Point& p = mesh.vertices[static_cast<std::size_t>(mesh.corners[i])];
    ASSERT_NEAR(mesh.fields_at(i)[0], 4 * p.x - 2 * p.y + p.z + 8, tolerance);
    ASSERT_NEAR(mesh.fields_at(i)[1], p.x, tolerance);
    // All polygons of both operands have one value there, rounded from one
    // exact point.
    for (std::size_t k = 0; k < 2; ++k) {
      double& known =
          at_vertex[2 * static_cast<std::size_t>(mesh.corners[i]) + k];
      if (known == HUGE_VAL) known = mesh.fields_at(i)[k];
      ASSERT_EQ(known, mesh.fields_at(i)[k]);
    }
  }
}

TEST(FaceFields, AffineFieldsComeOutOfBooleansExactly) {
  const Solid a =
      Solid::from_mesh(with_fields(Solid::box({0, 0, 0}, {8, 8, 8})));
  const Solid b =
      Solid::from_mesh(with_fields(Solid::box({-1, -1, -1}, {3, 4, 5})));
  for (const Solid& solid : {a + b, a - b, a & b, a ^ b})
    expect_the_fields(*solid.mesh(), 0);
  // Slanted, so that vertices are rational: one rounding of the field, and one
  // of the vertex that it is compared at.
  const Solid tetrahedron = Solid::from_mesh(
      with_fields(Solid::hull({{0, 0, 0}, {7, 1, 0}, {1, 5, 1}, {2, 2, 9}})));
  for (const Solid& solid :
       {a + tetrahedron, a - tetrahedron, a & tetrahedron, a ^ tetrahedron})
    expect_the_fields(*solid.mesh(), 1e-13);
}

/// How many booleans: HALFSPACE_FIELD_BOOLEANS says it for campaigns.
int booleans(int usually) {
  const char* wanted = std::getenv("HALFSPACE_FIELD_BOOLEANS");
  return wanted != nullptr ? std::atoi(wanted) : usually;
}

TEST(FaceFields, AffineFieldsComeOutOfRandomBooleansExactly) {
  // Boxes with corners on a coarse grid: every vertex of a result is on it, so
  // the fields are whole numbers, and not to be off at all.
  std::mt19937_64 random(7);
  const auto below = [&random](std::uint64_t bound) {
    return static_cast<double>(random() % bound);
  };
  const auto box = [&] {
    const Point low{below(8), below(8), below(8)};
    return Solid::from_mesh(
        with_fields(Solid::box(low, {low.x + 1 + below(8), low.y + 1 + below(8),
                                     low.z + 1 + below(8)})));
  };
  const auto hull = [&] {
    std::vector<Point> points;
    for (int i = 0; i < 6; ++i)
      points.push_back({below(12), below(12), below(12)});
    const Solid made = Solid::hull(points);
    return made.volume() ? Solid::from_mesh(with_fields(made)) : box();
  };
  std::size_t corners = 0;
  for (int round = 0; round < booleans(400); ++round) {
    const bool is_slanted = round % 2 == 1;
    const Solid a = box(), b = is_slanted ? hull() : box();
    const std::uint64_t operation = random() % 4;
    const Solid made = operation == 0   ? a + b
                       : operation == 1 ? a - b
                       : operation == 2 ? (a & b)
                                        : (a ^ b);
    const Mesh mesh = *made.mesh();
    // Of rational vertices, whose doubles are rounded too, to within that.
    if (mesh.polygon_count() == 0) continue;
    expect_the_fields(mesh, is_slanted ? 1e-13 : 0);
    corners += mesh.corners.size();
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(corners, 1000u);
}

TEST(FaceFields, PropertiesComeBackFromPartsThatAreJoined) {
  Mesh mesh = with_fields(Solid::box({0, 0, 0}, {8, 8, 8}));
  for (std::size_t p = 0; p < mesh.polygon_count(); ++p) {
    mesh.colors.push_back({static_cast<std::uint8_t>(40 * p), 1, 2});
    mesh.materials.push_back(static_cast<std::int32_t>(p) + 3);
  }
  const Solid a = Solid::from_mesh(mesh);
  const Solid b = Solid::sphere(3, 12).translated({7, 7, 7});
  const Mesh whole = *a.mesh();
  const Mesh again = *((a - b) + (a & b)).mesh();
  EXPECT_EQ(again, whole);
  EXPECT_EQ(whole.materials, mesh.materials);
  EXPECT_EQ(whole.colors, mesh.colors);
}

TEST(FaceFields, MovedFieldsStayWithTheirPoints) {
  const Solid a =
      Solid::from_mesh(with_fields(Solid::box({0, 0, 0}, {8, 8, 8})));
  const Solid b = Solid::box({-1, -1, -1}, {3, 4, 5});
  const Mesh here = *(a - b).mesh();
  const Mesh there = *(a - b).translated({100, 0, 0}).mesh();
  EXPECT_EQ(here.fields, there.fields);
}

}  // namespace
}  // namespace halfspace
