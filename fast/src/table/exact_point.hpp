#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "table/geometry_table.hpp"

/// Exact numbers of a space's planes and points.
namespace halfspace::fast {

template <int kBits>
ExactPlane<kBits> GeometryTable::exact_at(std::int32_t id) const {
  using N = typename Grid<kBits>::Normal;
  const TablePlane& p = plane(id);
  if constexpr (kBits == 26) {
    // Sizes are at most 2^53, so doubles hold them exactly.
    const Plane& n = p.filter.plane;
    return {{static_cast<N>(n.a), static_cast<N>(n.b), static_cast<N>(n.c)},
            p.origin};
  } else {
    return {normals_[static_cast<std::size_t>(id)], p.origin};
  }
}

/// A cross product of normals: 4n + 3 bits, so 107, 163 and 219.
template <int kBits>
using Cross = std::conditional_t<kBits == 26, Int128, Wide<4>>;

template <int kBits>
Cross<kBits> minor_of(typename Grid<kBits>::Normal a,
                      typename Grid<kBits>::Normal b,
                      typename Grid<kBits>::Normal c,
                      typename Grid<kBits>::Normal d) {
  if constexpr (kBits == 26) {
    return Int128{a} * d - Int128{b} * c;
  } else {
    return multiply<4>(a, d) - multiply<4>(b, c);
  }
}

template <int kBits>
Cross<kBits> cross_component(const ExactPlane<kBits>& p,
                             const ExactPlane<kBits>& q, int axis) {
  const auto& m = p.normal;
  const auto& n = q.normal;
  if (axis == 0) return minor_of<kBits>(m.y, m.z, n.y, n.z);
  if (axis == 1) return minor_of<kBits>(m.z, m.x, n.z, n.x);
  return minor_of<kBits>(m.x, m.y, n.x, n.y);
}

template <int kBits>
std::array<typename Grid<kBits>::Determinant, 4> GeometryTable::exact(
    std::int32_t id) const {
  constexpr std::size_t kWords = Grid<kBits>::kWords;
  const TableVertex& v = vertex(id);
  if (v.is_grid()) {
    const GridPoint at = v.point();
    return {Int128{at.x}, Int128{at.y}, Int128{at.z}, Int128{1}};
  }
  std::array<typename Grid<kBits>::Determinant, 4> c;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t w = 0; w < kWords; ++w)
      c[i].words[w] = exact_[v.exact + i * kWords + w];
  }
  return c;
}

}  // namespace halfspace::fast
