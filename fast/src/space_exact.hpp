#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "space.hpp"

/// Exact numbers of a space's planes and points.
namespace halfspace::fast {

template <int kBits>
ExactPlane<kBits> exact_of(const SpacePlane& plane) {
  using N = typename Grid<kBits>::Normal;
  const auto& n = plane.normal;
  return {{static_cast<N>(n.x), static_cast<N>(n.y), static_cast<N>(n.z)},
          plane.origin};
}

/// A cross product of normals: 4n + 3 bits, so 107, 163 and 219.
template <int kBits>
using Cross = std::conditional_t<kBits == 26, Int128, Wide<4>>;

template <int kBits>
Cross<kBits> minor_of(Int128 a, Int128 b, Int128 c, Int128 d) {
  if constexpr (kBits == 26) {
    return a * d - b * c;
  } else {
    return multiply<4>(a, d) - multiply<4>(b, c);
  }
}

template <int kBits>
Cross<kBits> cross_component(const SpacePlane& p, const SpacePlane& q,
                             int axis) {
  const auto& m = p.normal;
  const auto& n = q.normal;
  if (axis == 0) return minor_of<kBits>(m.y, m.z, n.y, n.z);
  if (axis == 1) return minor_of<kBits>(m.z, m.x, n.z, n.x);
  return minor_of<kBits>(m.x, m.y, n.x, n.y);
}

template <int kBits>
std::array<typename Grid<kBits>::Determinant, 4> Space::exact(
    std::int32_t id) const {
  constexpr std::size_t kWords = Grid<kBits>::kWords;
  const SpaceVertex& v = vertex(id);
  if (v.is_grid())
    return {Int128{v.point.x}, Int128{v.point.y}, Int128{v.point.z}, Int128{1}};
  std::array<typename Grid<kBits>::Determinant, 4> c;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t w = 0; w < kWords; ++w)
      c[i].words[w] = exact_[v.exact + i * kWords + w];
  }
  return c;
}

}  // namespace halfspace::fast
