#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "exact/cell_hash.hpp"
#include "exact/gcd.hpp"
#include "halfspace/assert.hpp"
#include "table/exact_point.hpp"

namespace halfspace::fast {

/// A plane with its normal flipped as in the table. Equal planes have equal
/// hashes.
template <int kBits>
struct PlaneEntry {
  ExactPlane<kBits> exact;
  double offset = 0;  ///< its value at the origin, rounded
  std::uint64_t hash = 0;
  bool flipped = false;
};

namespace {

/// Turns a normal so that its first component that is not zero is positive.
/// Whether it was flipped.
template <class Int>
bool turn_normal(Vector3<Int>& n) {
  const bool flipped = (n.x != 0 ? n.x : n.y != 0 ? n.y : n.z) < 0;
  // Nothing can foretell it: no branch.
  const Int sign = flipped ? -1 : 1;
  n = {sign * n.x, sign * n.y, sign * n.z};
  return flipped;
}

/// Divides a normal by its greatest common divisor.
void reduce_normal(Vector3<Int128>& n) {
  auto divisor = greatest_common_divisor(size_of(n.x), size_of(n.y));
  if (divisor != 1) divisor = greatest_common_divisor(divisor, size_of(n.z));
  if (divisor == 1) return;
  const auto by = static_cast<Int128>(divisor);
  n = {n.x / by, n.y / by, n.z / by};
}

std::uint64_t low_word_of(Int128 value) {
  return static_cast<std::uint64_t>(value);
}
std::uint64_t low_word_of(const Wide<3>& value) { return value.words[0]; }

/// The number of the cell that holds a plane's offset in units of its normal's
/// largest component: in cells of 2^-16, the one whose middle is nearest, the
/// upper one of two. `near` is what doubles make of offset / by.
///
/// Requires: the quotient is less than 2^27 in size, and the offset than 2^82.
std::int64_t cell_of_offset(Int128 offset, std::int64_t by, double near) {
  constexpr int kDigits = 16;
  const double at = near * (1 << kDigits) + 0.5;
  // One too low if it is negative and whole: then it is in doubt.
  const std::int64_t cell = static_cast<std::int64_t>(at) - (at < 0 ? 1 : 0);
  const double rest = at - static_cast<double>(cell);
  // Off by three roundings: of the offset, of the quotient and of the sum.
  const double doubt = (std::abs(at) + 1) * 0x1p-50;
  if (rest > doubt && 1 - rest > doubt) return cell;
  const Int128 value = (offset << (kDigits + 1)) + by;
  const Int128 step = Int128{2} * by;
  return static_cast<std::int64_t>(value / step) - (value % step < 0 ? 1 : 0);
}

/// A hash that all positive multiples of a plane's normal and offset share.
///
/// They share the quotients by the size of the largest component, and so what
/// doubles round those to, for both numbers have 53 bits; and the cell of the
/// offset's quotient.
/// Requires: the plane holds a point of the grid of 26 bits; `near` is the
///           offset as a double.
std::uint64_t hash_of_ray(const Vector3<std::int64_t>& n, Int128 offset,
                          double near) {
  const auto by = static_cast<std::int64_t>(
      std::max({size_of(n.x), size_of(n.y), size_of(n.z)}));
  std::array<double, 4> quotients{static_cast<double>(n.x),
                                  static_cast<double>(n.y),
                                  static_cast<double>(n.z), near};
  for (double& quotient : quotients) quotient /= static_cast<double>(by);
  const auto bits = [&](std::size_t i) {
    return std::bit_cast<std::uint64_t>(quotients[i]);
  };
  const std::int64_t cell = cell_of_offset(offset, by, quotients[3]);
  return mixed(bits(0) * 0x9e3779b97f4a7c15u + bits(1) * 0xbf58476d1ce4e5b9u +
               bits(2) * 0x94d049bb133111ebu +
               static_cast<std::uint64_t>(cell) * 0xa0761d6478bd642fu);
}

/// Fills in an entry, in its place: a copy would wait for what was just
/// written.
template <int kBits>
inline void set_entry(const ExactPlane<kBits>& exact,
                      PlaneEntry<kBits>& entry) {
  auto n = exact.normal;
  entry.flipped = turn_normal(n);
  if constexpr (kBits != 26) reduce_normal(n);
  const auto offset = value_at(ExactPlane<kBits>{n, exact.origin}, GridPoint{});
  entry.offset = to_double(offset);
  if constexpr (kBits == 26) {
    entry.hash = hash_of_ray(n, offset, entry.offset);
  } else {
    entry.hash =
        mixed(hash_of(low_word_of(n.x), low_word_of(n.y), low_word_of(n.z)) +
              low_word_of(offset));
  }
  entry.exact.normal = n;
  entry.exact.origin = exact.origin;
}

template <int kBits>
PlaneEntry<kBits> plane_entry(const ExactPlane<kBits>& exact) {
  PlaneEntry<kBits> entry;
  set_entry(exact, entry);
  return entry;
}

/// Whether two normals flipped alike are multiples of each other.
bool parallel(const Vector3<std::int64_t>& m, const Vector3<std::int64_t>& n) {
  const auto same = [](std::int64_t a, std::int64_t b, std::int64_t c,
                       std::int64_t d) {
    return Int128{a} * d == Int128{b} * c;
  };
  return same(m.x, m.y, n.x, n.y) && same(m.y, m.z, n.y, n.z) &&
         same(m.z, m.x, n.z, n.x);
}
bool parallel(const Vector3<Int128>& m, const Vector3<Int128>& n) {
  return m == n;
}

}  // namespace

Vector3<Int128> Space::reduced_normal(std::int32_t plane) const {
  Vector3<Int128> n = normal(plane);
  reduce_normal(n);
  return n;
}

void Space::reserve(std::size_t points, std::size_t planes) {
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

OrientedPlane Space::add_plane(const Vector3<Int128>& normal,
                               const GridPoint& origin) {
  return with_grid(grid_bits_, [&](auto bits) {
    using N = typename Grid<bits()>::Normal;
    return enter(plane_entry<bits()>(
        {{static_cast<N>(normal.x), static_cast<N>(normal.y),
          static_cast<N>(normal.z)},
         origin}));
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
        set_entry(exact_plane<bits()>(corners[i + k]), block[k]);
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
  const std::int32_t known = plane_index_.find(entry.hash, [&](std::int32_t p) {
    const ExactPlane<kBits> other = exact_at<kBits>(p);
    return parallel(other.normal, n) && sign(value_at(other, origin)) == 0;
  });
  if (known >= 0) return {known, entry.flipped};
  const auto id = static_cast<std::int32_t>(planes_.size());
  SpacePlane& plane = planes_.emplace_back();
  plane.filter = filter_plane(
      {to_double(n.x), to_double(n.y), to_double(n.z), entry.offset});
  plane.origin = origin;
  if constexpr (kBits != 26) normals_.push_back(n);
  plane_index_.enter(entry.hash, id);
  return {id, entry.flipped};
}

std::int32_t Space::add_line_plane(std::int32_t u, std::int32_t v, int axis) {
  const GridPoint p = vertex(u).point();
  HALFSPACE_ASSERT(vertex(u).is_grid() && vertex(v).is_grid());
  const auto d = difference(p, vertex(v).point());
  const Vector3<std::int64_t> e{axis == 0, axis == 1, axis == 2};
  const auto n = cross<26>(d, e);
  return add_plane({n.x, n.y, n.z}, p).plane;
}

}  // namespace halfspace::fast
