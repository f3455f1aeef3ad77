#include "intersect/radial_order.hpp"

#include <algorithm>

namespace halfspace::fast {
namespace {

/// The sign of the sine of the angle from one wing to another.
///
/// With unit vector d along the segment and normals m, n, wings point along
/// m x d and n x d, times their turns. Their cross product is d det(m, n, d),
/// and m x n is parallel to d: one component tells its sign.
int cross(const Wing& w, const Wing& v, int axis, const GeometryTable& table) {
  return w.plane == v.plane
             ? 0
             : w.turn * v.turn * table.cross_sign(axis, w.plane, v.plane);
}

}  // namespace

int part_of_turn(const Wing& first, const Wing& wing, int axis,
                 const GeometryTable& table) {
  const int sign = cross(first, wing, axis, table);
  if (sign == 0) return wing.turn == first.turn ? 0 : 2;
  return sign > 0 ? 1 : 3;
}

void sort_wings(std::vector<Wing>& wings, int axis,
                const GeometryTable& table) {
  // Beyond these something else is sooner than to sort where they stand.
  constexpr std::ptrdiff_t kFew = 8;
  const Wing first = wings.front();
  const auto before = [&](const Wing& w, const Wing& v) {
    const int p = part_of_turn(first, w, axis, table);
    const int q = part_of_turn(first, v, axis, table);
    return p != q ? p < q : cross(w, v, axis, table) > 0;
  };
  // None comes before the first.
  const auto others = wings.begin() + 1;
  if (wings.end() - others > kFew) {
    std::stable_sort(others, wings.end(), before);
    return;
  }
  for (auto next = others; next != wings.end(); ++next) {
    const Wing wing = *next;
    auto at = next;
    for (; at != others && before(wing, *(at - 1)); --at) *at = *(at - 1);
    *at = wing;
  }
}

}  // namespace halfspace::fast
