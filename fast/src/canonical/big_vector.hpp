#pragma once

#include <array>

#include "exact/big_rational.hpp"
#include "exact/exact_plane.hpp"
#include "halfspace/big_integer.hpp"
#include "halfspace/int128.hpp"

namespace halfspace::fast {

using BigVector = std::array<BigInteger, 3>;

inline BigVector to_big_vector(const Vector3<Int128>& v) {
  return {to_big<BigInteger>(v.x), to_big<BigInteger>(v.y),
          to_big<BigInteger>(v.z)};
}

inline BigInteger dot(const BigVector& a, const BigVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline BigVector cross(const BigVector& a, const BigVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
          a[0] * b[1] - a[1] * b[0]};
}

}  // namespace halfspace::fast
