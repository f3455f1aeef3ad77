#include <algorithm>
#include <array>

#include "exact/gcd.hpp"
#include "halfspace/assert.hpp"
#include "table/exact_point.hpp"

namespace halfspace::fast {

Vector3<Int128> GeometryTable::reduced_normal(std::int32_t plane) const {
  const Vector3<Int128> n = normal(plane);
  const Uint128 divisor = greatest_common_divisor(
      greatest_common_divisor(size_of(n.x), size_of(n.y)), size_of(n.z));
  const auto by = static_cast<Int128>(divisor);
  return {n.x / by, n.y / by, n.z / by};
}

void GeometryTable::reserve(std::size_t points, std::size_t planes) {
  // For another operand like this one, too, and for some that booleans make:
  // then nothing is copied, and what is not used is not touched.
  const auto grow = [](auto& list, std::size_t more) {
    const std::size_t size = list.size() + more;
    if (size > list.capacity())
      list.reserve(std::max(size + more + more / 4, 2 * list.capacity()));
    return list.size() + more;
  };
  vertex_index_.reserve(grow(vertices_, points), points);
  plane_index_.reserve(grow(planes_, planes), planes);
  if (grid_bits_ > 26) grow(normals_, planes);
}

OrientedPlane GeometryTable::add_plane(const Vector3<Int128>& normal,
                                       const GridPoint& origin) {
  return with_grid(grid_bits_, [&](auto bits) {
    using N = typename Grid<bits()>::Normal;
    return enter(canonical_plane<bits()>(
        {{static_cast<N>(normal.x), static_cast<N>(normal.y),
          static_cast<N>(normal.z)},
         origin}));
  });
}

OrientedPlane GeometryTable::add_plane(
    const std::array<GridPoint, 3>& corners) {
  return with_grid(grid_bits_, [&](auto bits) {
    return enter(canonical_plane(exact_plane<bits()>(corners)));
  });
}

/// In blocks: where planes are looked up is fetched from memory while others
/// are being computed.
void GeometryTable::add_planes(
    std::span<const std::array<GridPoint, 3>> corners,
    std::vector<OrientedPlane>& planes) {
  constexpr std::size_t kBlock = 32;
  with_grid(grid_bits_, [&](auto bits) {
    std::array<CanonicalPlane<bits()>, kBlock> block;
    for (std::size_t i = 0; i < corners.size(); i += kBlock) {
      const std::size_t count = std::min(kBlock, corners.size() - i);
      set_canonical(std::span(block).first(count), [&](std::size_t k) {
        return exact_plane<bits()>(corners[i + k]);
      });
      for (std::size_t k = 0; k < count; ++k)
        plane_index_.prefetch(block[k].hash);
      for (std::size_t k = 0; k < count; ++k) planes.push_back(enter(block[k]));
    }
  });
}

template <int kBits>
OrientedPlane GeometryTable::enter(const CanonicalPlane<kBits>& entry) {
  const auto& n = entry.exact.normal;
  const std::int32_t known = plane_index_.find(entry.hash, [&](std::int32_t p) {
    return is_same_plane(exact_at<kBits>(p), entry.exact);
  });
  if (known >= 0) return {known, entry.flipped};
  const auto id = static_cast<std::int32_t>(planes_.size());
  TablePlane& plane = planes_.emplace_back();
  plane.filter = filter_plane(
      {to_double(n.x), to_double(n.y), to_double(n.z), entry.offset});
  plane.origin = entry.exact.origin;
  if constexpr (kBits != 26) normals_.push_back(n);
  plane_index_.enter(entry.hash, id);
  return {id, entry.flipped};
}

std::int32_t GeometryTable::add_line_plane(std::int32_t u, std::int32_t v,
                                           int axis) {
  const GridPoint p = vertex(u).point();
  HALFSPACE_ASSERT(vertex(u).is_grid() && vertex(v).is_grid());
  const auto d = difference(p, vertex(v).point());
  const Vector3<std::int64_t> e{axis == 0, axis == 1, axis == 2};
  const auto n = cross<26>(d, e);
  return add_plane({n.x, n.y, n.z}, p).plane;
}

}  // namespace halfspace::fast
