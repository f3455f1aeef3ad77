#include "rounding/mesh_winding.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "exact/wide.hpp"
#include "halfspace/assert.hpp"
#include "rounding/grid_predicates.hpp"

namespace halfspace::fast {
namespace {

std::int64_t coordinate(const GridPoint& p, std::size_t axis) {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

}  // namespace

TriangleRay::TriangleRay(const GridMesh& mesh, std::int32_t triangle,
                         std::size_t axis)
    : mesh_(mesh), own_(triangle), axis_(axis) {
  const GridTriangle& own = mesh.triangles[static_cast<std::size_t>(triangle)];
  const auto& c = own.corners;
  const int turn = turn_along(static_cast<int>(axis), mesh.at(c[0]),
                              mesh.at(c[1]), mesh.at(c[2]));
  HALFSPACE_ASSERT(turn != 0);
  faces_along_ = turn > 0;
  for (const std::int32_t corner : c) {
    for (std::size_t k = 0; k < 3; ++k)
      middle_[k] += coordinate(mesh.at(corner), k);
  }
  box_ = box_of(mesh, own);
  box_.high[axis] = std::numeric_limits<float>::max();
}

/// p, three times as large, from three times the middle: up to 57 bits. The
/// axis is the last coordinate.
Vector3<std::int64_t> TriangleRay::from_middle(std::int32_t p) const {
  const auto along = [&](std::size_t axis) {
    return 3 * coordinate(mesh_.at(p), axis) - middle_[axis];
  };
  return {along((axis_ + 1) % 3), along((axis_ + 2) % 3), along(axis_)};
}

/// The triangle's part of the winding number below it, as seen with the axis
/// upwards, if it is above the middle, moved by (e, e^2) for an infinitely
/// small e > 0.
void TriangleRay::pass(std::int32_t other) {
  if (other == own_) return;
  const auto& corners =
      mesh_.triangles[static_cast<std::size_t>(other)].corners;
  std::array<Vector3<std::int64_t>, 3> v;
  for (std::size_t i = 0; i < 3; ++i) v[i] = from_middle(corners[i]);
  int first = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& a = v[i];
    const auto& b = v[(i + 1) % 3];
    int turn = sign(Int128{a.x} * b.y - Int128{a.y} * b.x);
    if (turn == 0) turn = a.y > b.y ? 1 : a.y < b.y ? -1 : 0;
    if (turn == 0) turn = b.x > a.x ? 1 : b.x < a.x ? -1 : 0;
    if (turn == 0 || (i > 0 && turn != first)) return;
    first = turn;
  }
  // The determinant is the normal's product with a corner.
  const auto minor = [](std::int64_t a, std::int64_t b, std::int64_t c,
                        std::int64_t d) {
    return Int128{a} * d - Int128{b} * c;
  };
  const auto &a = v[0], &b = v[1], &c = v[2];
  const int side = sign(multiply<3>(minor(b.y, b.z, c.y, c.z), Int128{a.x}) +
                        multiply<3>(minor(b.z, b.x, c.z, c.x), Int128{a.y}) +
                        multiply<3>(minor(b.x, b.y, c.x, c.y), Int128{a.z}));
  if (side == 0) is_sure_ = false;
  if (side == first) winding_ += first;
}

std::vector<FacingTriangle> facing_triangles(
    const GridMesh& mesh, const std::vector<std::int32_t>& part) {
  std::vector<FacingTriangle> best(mesh.triangles.size(), {-1, 0});
  std::vector<double> area(mesh.triangles.size(), -1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (part[t] < 0) continue;
    const auto& c = mesh.triangles[t].corners;
    const GridPoint &p = mesh.at(c[0]), &q = mesh.at(c[1]), &r = mesh.at(c[2]);
    const auto of = static_cast<std::size_t>(part[t]);
    const auto d = [](std::int64_t value) {
      return static_cast<double>(value);
    };
    const double ux = d(q.x - p.x), uy = d(q.y - p.y), uz = d(q.z - p.z);
    const double vx = d(r.x - p.x), vy = d(r.y - p.y), vz = d(r.z - p.z);
    const std::array<double, 3> size = {std::abs(uy * vz - uz * vy),
                                        std::abs(uz * vx - ux * vz),
                                        std::abs(ux * vy - uy * vx)};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      // Doubles may not tell it from 0.
      if (size[axis] <= area[of] ||
          turn_along(static_cast<int>(axis), p, q, r) == 0)
        continue;
      area[of] = size[axis];
      best[of] = {static_cast<std::int32_t>(t), axis};
    }
  }
  std::erase_if(best, [](const FacingTriangle& f) { return f.triangle < 0; });
  return best;
}

}  // namespace halfspace::fast
