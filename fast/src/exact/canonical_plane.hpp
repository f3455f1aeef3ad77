#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>

#include "exact/cell_hash.hpp"
#include "exact/exact_plane.hpp"
#include "exact/gcd.hpp"
#include "exact/residue.hpp"

/// A form of planes by which those that are the same point set are found.
namespace halfspace::fast {

/// A plane whose normal's first component that is not zero is positive.
template <int kBits>
struct CanonicalPlane {
  ExactPlane<kBits> exact;
  double offset = 0;       ///< its value at the origin, rounded
  std::uint64_t hash = 0;  ///< equal for planes that are the same point set
  bool flipped = false;    ///< the plane it was made of has the other normal
};

/// Makes the first component of a normal that is not zero positive; whether
/// that changed its sign.
template <class Int>
bool orient_normal(Vector3<Int>& n) {
  const bool flipped = (n.x != 0 ? n.x : n.y != 0 ? n.y : n.z) < 0;
  // Unpredictable, so without a branch.
  const Int mask = flipped ? -1 : 0;
  n = {(n.x ^ mask) - mask, (n.y ^ mask) - mask, (n.z ^ mask) - mask};
  return flipped;
}

/// The number of the cell that holds a plane's offset in units of its normal's
/// largest component: in cells of 2^-16, the one whose middle is nearest, the
/// upper one of two. `near` is the quotient offset / by in doubles.
///
/// Requires: the quotient is less than 2^27 in size, and the offset than 2^82.
inline std::int64_t cell_of_offset(Int128 offset, std::int64_t by,
                                   double near) {
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
/// They share the quotients by the size of the largest component, and so the
/// doubles nearest to those, for both numbers have 53 bits; and the cell of
/// the offset's quotient.
/// Requires: the plane holds a point of the grid of 26 bits; `near` is the
///           offset as a double.
inline std::uint64_t hash_of_ray(const Vector3<std::int64_t>& n, Int128 offset,
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

/// The residues of a normal and an offset, all divided by the normal's first
/// one that is not 0 once `inverse` is inverted: equal for all positive
/// multiples of them.
struct RayResidues {
  std::array<std::uint64_t, 4> at;
  std::uint64_t inverse;
};

/// Of a normal, and of its plane's value at the origin.
///
/// If the prime divides the normal it divides the offset, which is the product
/// with a point of the grid. Then both are divided by it: which residue is the
/// first that is not 0 must not depend on common factors.
template <int kBits>
RayResidues residues_of(ExactPlane<kBits> plane,
                        typename Grid<kBits>::Value offset) {
  auto& n = plane.normal;
  RayResidues result;
  auto& at = result.at;
  while (true) {
    at = {residue(n.x), residue(n.y), residue(n.z), residue(offset)};
    if ((at[0] | at[1] | at[2]) != 0) break;
    constexpr auto kBy = static_cast<Int128>(kPrime);
    n = {n.x / kBy, n.y / kBy, n.z / kBy};
    offset = value_at(plane, GridPoint{});
  }
  result.inverse = at[0] != 0 ? at[0] : at[1] != 0 ? at[1] : at[2];
  return result;
}

inline std::uint64_t hash_of(const RayResidues& ray) {
  const auto ratio = [&](std::size_t i) {
    return multiply_residues(ray.at[i], ray.inverse);
  };
  return mixed(hash_of(ratio(0), ratio(1), ratio(2)) + ratio(3));
}

/// Sets planes to the canonical forms of others: in place, because a copy would
/// wait for the stores. Requires: at most 32.
template <int kBits, class ExactAt>
void set_canonical(std::span<CanonicalPlane<kBits>> planes,
                   const ExactAt& exact_at) {
  std::array<RayResidues, 32> rays;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    CanonicalPlane<kBits>& plane = planes[i];
    const ExactPlane<kBits> exact = exact_at(i);
    auto n = exact.normal;
    plane.flipped = orient_normal(n);
    const auto offset =
        value_at(ExactPlane<kBits>{n, exact.origin}, GridPoint{});
    plane.offset = to_double(offset);
    if constexpr (kBits == 26) {
      plane.hash = hash_of_ray(n, offset, plane.offset);
    } else {
      rays[i] = residues_of<kBits>({n, exact.origin}, offset);
    }
    plane.exact.normal = n;
    plane.exact.origin = exact.origin;
  }
  if constexpr (kBits != 26) {
    std::array<std::uint64_t, 32> inverses;
    for (std::size_t i = 0; i < planes.size(); ++i)
      inverses[i] = rays[i].inverse;
    invert_residues(std::span(inverses).first(planes.size()));
    for (std::size_t i = 0; i < planes.size(); ++i) {
      rays[i].inverse = inverses[i];
      planes[i].hash = hash_of(rays[i]);
    }
  }
}

template <int kBits>
CanonicalPlane<kBits> canonical_plane(const ExactPlane<kBits>& exact) {
  CanonicalPlane<kBits> plane;
  set_canonical(std::span(&plane, 1), [&](std::size_t) { return exact; });
  return plane;
}

/// Whether two canonical normals are those of parallel planes.
inline bool are_parallel(const Vector3<std::int64_t>& m,
                         const Vector3<std::int64_t>& n) {
  const auto same = [](std::int64_t a, std::int64_t b, std::int64_t c,
                       std::int64_t d) {
    return Int128{a} * d == Int128{b} * c;
  };
  return same(m.x, m.y, n.x, n.y) && same(m.y, m.z, n.y, n.z) &&
         same(m.z, m.x, n.z, n.x);
}
inline bool are_parallel(const Vector3<Int128>& m, const Vector3<Int128>& n) {
  const auto same = [](Int128 a, Int128 b, Int128 c, Int128 d) {
    return multiply<4>(a, d) == multiply<4>(b, c);
  };
  return same(m.x, m.y, n.x, n.y) && same(m.y, m.z, n.y, n.z) &&
         same(m.z, m.x, n.z, n.x);
}

/// Whether two planes with canonical normals are the same point set.
template <int kBits>
bool is_same_plane(const ExactPlane<kBits>& p, const ExactPlane<kBits>& q) {
  return are_parallel(p.normal, q.normal) && sign(value_at(p, q.origin)) == 0;
}

}  // namespace halfspace::fast
