#include <algorithm>

#include "cell.hpp"
#include "divisor.hpp"
#include "halfspace/assert.hpp"
#include "space_exact.hpp"

namespace halfspace::fast {

/// A plane with its normal in the form that equal planes share.
template <int kBits>
struct PlaneEntry {
  ExactPlane<kBits> exact;
  typename Grid<kBits>::Value offset{};
  std::uint64_t hash = 0;
  bool turned = false;
};

namespace {

/// Divides a normal by its greatest common divisor, and turns it so that its
/// first component that is not zero is positive. Whether it was turned.
template <class Int>
bool reduce_normal(Vector3<Int>& n) {
  auto divisor = greatest_common_divisor(size_of(n.x), size_of(n.y));
  if (divisor != 1) divisor = greatest_common_divisor(divisor, size_of(n.z));
  const bool turned = (n.x != 0 ? n.x : n.y != 0 ? n.y : n.z) < 0;
  if (divisor != 1) {
    const auto by = static_cast<Int>(divisor);
    n = {n.x / by, n.y / by, n.z / by};
  }
  if (turned) n = {-n.x, -n.y, -n.z};
  return turned;
}

std::uint64_t low_word_of(Int128 value) {
  return static_cast<std::uint64_t>(value);
}
std::uint64_t low_word_of(const Wide<3>& value) { return value.words[0]; }

template <int kBits>
PlaneEntry<kBits> plane_entry(const ExactPlane<kBits>& exact) {
  PlaneEntry<kBits> result;
  result.exact = exact;
  auto& n = result.exact.normal;
  result.turned = reduce_normal(n);
  result.offset = value_at(result.exact, GridPoint{});
  result.hash =
      mixed(hash_of(low_word_of(n.x), low_word_of(n.y), low_word_of(n.z)) +
            low_word_of(result.offset));
  return result;
}

}  // namespace

void Space::reserve(std::size_t points, std::size_t planes) {
  const auto grow = [](auto& list, std::size_t more) {
    const std::size_t size = list.size() + more;
    if (size > list.capacity())
      list.reserve(std::max(size, 2 * list.capacity()));
    return list.capacity();
  };
  vertex_index_.reserve(grow(vertices_, points));
  plane_index_.reserve(grow(planes_, planes));
}

OrientedPlane Space::add_plane(const Vector3<Int128>& normal,
                               const GridPoint& origin) {
  return with_grid(grid_bits_, [&](auto bits) {
    return enter(plane_entry(exact_of<bits()>({normal, origin, {}})));
  });
}

OrientedPlane Space::add_plane(const std::array<GridPoint, 3>& corners) {
  return with_grid(grid_bits_, [&](auto bits) {
    return enter(plane_entry(exact_plane<bits()>(corners)));
  });
}

/// In blocks: where planes are looked up is fetched from memory while others
/// are being computed.
void Space::add_planes(std::span<const std::array<GridPoint, 3>> corners,
                       std::vector<OrientedPlane>& planes) {
  constexpr std::size_t kBlock = 32;
  with_grid(grid_bits_, [&](auto bits) {
    std::array<PlaneEntry<bits()>, kBlock> block;
    for (std::size_t i = 0; i < corners.size(); i += kBlock) {
      const std::size_t count = std::min(kBlock, corners.size() - i);
      for (std::size_t k = 0; k < count; ++k) {
        block[k] = plane_entry(exact_plane<bits()>(corners[i + k]));
        plane_index_.prefetch(block[k].hash);
      }
      for (std::size_t k = 0; k < count; ++k) planes.push_back(enter(block[k]));
    }
  });
}

template <int kBits>
OrientedPlane Space::enter(const PlaneEntry<kBits>& entry) {
  const auto& n = entry.exact.normal;
  const GridPoint& origin = entry.exact.origin;
  const Vector3<Int128> normal{n.x, n.y, n.z};
  const std::int32_t known = plane_index_.find(entry.hash, [&](std::int32_t p) {
    const SpacePlane& other = plane(p);
    return other.normal == normal &&
           sign(value_at(exact_of<kBits>(other), origin)) == 0;
  });
  if (known >= 0) return {known, entry.turned};
  const auto id = static_cast<std::int32_t>(planes_.size());
  planes_.push_back(
      {normal, origin,
       filter_plane({to_double(normal.x), to_double(normal.y),
                     to_double(normal.z), to_double(entry.offset)})});
  plane_index_.enter(entry.hash, id);
  return {id, entry.turned};
}

std::int32_t Space::add_line_plane(std::int32_t u, std::int32_t v, int axis) {
  const GridPoint& p = vertex(u).point;
  HALFSPACE_ASSERT(vertex(u).is_grid() && vertex(v).is_grid());
  const auto d = difference(p, vertex(v).point);
  const Vector3<std::int64_t> e{axis == 0, axis == 1, axis == 2};
  const auto n = cross<26>(d, e);
  return add_plane({n.x, n.y, n.z}, p).plane;
}

}  // namespace halfspace::fast
