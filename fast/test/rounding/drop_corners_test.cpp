#include "rounding/drop_corners.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "rounding/mesh_contacts.hpp"

namespace halfspace::fast {
namespace {

/// A tetrahedron with a corner in the middle of its first edge, off that by
/// `off`. It and the ends of the edge are loose.
struct Bent {
  GridMesh mesh;
  std::vector<LoosePoint> loose;
  std::vector<std::uint64_t> kind;
};

Bent tetrahedron(double off) {
  Bent bent;
  bent.mesh.points = {{}, {}, {}, {500, 1000, 0}, {500, 0, 1000}};
  bent.mesh.moved.resize(5);
  bent.loose = {{0, {0, 0, 0}}, {1, {500, off, off}}, {2, {1000, 0, 0}}};
  bent.mesh.triangles = {{{0, 3, 1}, 7}, {{1, 3, 2}, 7}, {{0, 1, 4}, 8},
                         {{1, 2, 4}, 8}, {{2, 3, 4}, 9}, {{3, 0, 4}, 9}};
  bent.kind.assign(6, 0);
  return bent;
}

TEST(FastDropCorners, ACornerOnAStraightCreaseGoes) {
  for (const double off : {0.0, 0.25, -0.5}) {
    Bent bent = tetrahedron(off);
    ASSERT_TRUE(is_closed(bent.mesh));
    const double move =
        drop_straight_corners(bent.mesh, bent.loose, bent.kind, 4);
    EXPECT_LE(move, 5 * std::abs(off));
    EXPECT_EQ(move > 0, off != 0);
    EXPECT_EQ(bent.mesh.triangles.size(), 4u);
    EXPECT_EQ(bent.mesh.points.size(), 4u);
    EXPECT_EQ(bent.loose.size(), 2u);
    EXPECT_TRUE(is_closed(bent.mesh));
    for (const LoosePoint& p : bent.loose) EXPECT_LT(p.point, 4);
  }
}

TEST(FastDropCorners, ACornerThatTurnsStays) {
  for (const double off : {3.0, 50.0, -200.0}) {
    Bent bent = tetrahedron(off);
    EXPECT_EQ(drop_straight_corners(bent.mesh, bent.loose, bent.kind, 4), 0);
    EXPECT_EQ(bent.mesh.triangles.size(), 6u);
    EXPECT_EQ(bent.loose.size(), 3u);
  }
}

TEST(FastDropCorners, BordersOfKindsStay) {
  Bent bent = tetrahedron(0);
  bent.kind[1] = 1;
  EXPECT_EQ(drop_straight_corners(bent.mesh, bent.loose, bent.kind, 4), 0);
  EXPECT_EQ(bent.mesh.triangles.size(), 6u);
}

TEST(FastDropCorners, CornersOfTheGridStay) {
  Bent bent = tetrahedron(0);
  bent.mesh.points[1] = {500, 0, 0};
  bent.loose.erase(bent.loose.begin() + 1);
  EXPECT_EQ(drop_straight_corners(bent.mesh, bent.loose, bent.kind, 4), 0);
  EXPECT_EQ(bent.mesh.triangles.size(), 6u);
}

}  // namespace
}  // namespace halfspace::fast
