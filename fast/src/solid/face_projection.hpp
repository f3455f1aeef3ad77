#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "halfspace/fast/solid.hpp"
#include "table/shared_table.hpp"

namespace halfspace::fast {

/// A face's plane as seen from outside: which way points are ordered, and turn.
class FaceProjection {
 public:
  FaceProjection(const Solid& solid, const Face& face) : table_(*solid.table) {
    const Plane& n = table_.plane(face.plane).filter.plane;
    const std::array<double, 3> size{std::abs(n.a), std::abs(n.b),
                                     std::abs(n.c)};
    axis_ = static_cast<int>(std::max_element(size.begin(), size.end()) -
                             size.begin());
    sign_ = table_.normal_sign(face.plane, axis_) * (face.flipped ? -1 : 1);
  }
  /// 1 if r is on the left of p and q, -1 if on the right.
  int turn(std::int32_t p, std::int32_t q, std::int32_t r) const {
    return sign_ * table_.turn(axis_, p, q, r);
  }
  /// Whether the sweep comes to u before it comes to v.
  bool before(std::int32_t u, std::int32_t v) const {
    const int first = table_.compare((axis_ + 1) % 3, u, v);
    if (first != 0) return first < 0;
    return sign_ * table_.compare((axis_ + 2) % 3, u, v) < 0;
  }

 private:
  const GeometryTable& table_;
  int axis_ = 0;
  int sign_ = 1;
};

}  // namespace halfspace::fast
