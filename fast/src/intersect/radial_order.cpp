#include "intersect/radial_order.hpp"

#include <algorithm>

#include "base/check.hpp"

namespace halfspace::fast {
namespace {

/// The sign of the sine of the angle from one half-face to another.
///
/// With unit vector d along the segment and normals m, n, half-faces point
/// along m x d and n x d, times their turns. Their cross product is d det(m, n,
/// d), and m x n is parallel to d: the sign of one component decides.
int cross(const HalfFace& w, const HalfFace& v, int axis,
          const GeometryTable& table) {
  return w.plane == v.plane
             ? 0
             : w.turn * v.turn * table.cross_sign(axis, w.plane, v.plane);
}

/// Whether none of the half-faces stands before the one that precedes it.
bool is_round(const std::vector<HalfFace>& half_faces, int axis,
              const GeometryTable& table) {
  for (std::size_t i = 1; i < half_faces.size(); ++i) {
    const HalfFace& w = half_faces[i - 1];
    const HalfFace& v = half_faces[i];
    const int p = part_of_turn(half_faces[0], w, axis, table);
    const int q = part_of_turn(half_faces[0], v, axis, table);
    if (p > q || (p == q && cross(w, v, axis, table) < 0)) return false;
  }
  return true;
}

}  // namespace

int part_of_turn(const HalfFace& first, const HalfFace& half_face, int axis,
                 const GeometryTable& table) {
  const int sign = cross(first, half_face, axis, table);
  if (sign == 0) return half_face.turn == first.turn ? 0 : 2;
  return sign > 0 ? 1 : 3;
}

void radial_sort(std::vector<HalfFace>& half_faces, int axis,
                 const GeometryTable& table) {
  // Beyond these something else is sooner than to sort where they stand.
  constexpr std::ptrdiff_t kFew = 8;
  HALFSPACE_CHECK(!half_faces.empty());
  const HalfFace first = half_faces.front();
  const auto before = [&](const HalfFace& w, const HalfFace& v) {
    const int p = part_of_turn(first, w, axis, table);
    const int q = part_of_turn(first, v, axis, table);
    return p != q ? p < q : cross(w, v, axis, table) > 0;
  };
  // None comes before the first.
  const auto others = half_faces.begin() + 1;
  if (half_faces.end() - others > kFew) {
    std::stable_sort(others, half_faces.end(), before);
    HALFSPACE_CHECK(is_round(half_faces, axis, table));
    return;
  }
  for (auto next = others; next != half_faces.end(); ++next) {
    const HalfFace half_face = *next;
    auto at = next;
    for (; at != others && before(half_face, *(at - 1)); --at) *at = *(at - 1);
    *at = half_face;
  }
  HALFSPACE_CHECK(is_round(half_faces, axis, table));
}

}  // namespace halfspace::fast
