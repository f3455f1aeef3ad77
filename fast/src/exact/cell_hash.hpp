#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "exact/wide.hpp"

/// Hashes of points in homogeneous coordinates, equal for equal points.
namespace halfspace::fast {

/// The number of binary digits after the point of a coordinate that its cell
/// has: fewer on wide grids, whose coordinates leave doubles fewer of them.
/// Below 0 cells are of several steps: on the widest grid doubles are off by up
/// to eight steps, and one in ten asks for exact numbers.
constexpr int cell_digits(int grid_bits) {
  return grid_bits == 26 ? 10 : grid_bits == 40 ? 2 : -8;
}

/// The number of the cell that holds a coordinate of the grid.
constexpr std::int64_t cell_of(std::int64_t coordinate, int digits) {
  return digits >= 0
             ? coordinate * (std::int64_t{1} << digits)
             : (coordinate + (std::int64_t{1} << (-digits - 1))) >> -digits;
}

/// The number of the cell that holds n / d: in cells of 2^-digits, the one
/// whose middle is nearest, the upper one of two.
///
/// Requires: d > 0; 2^(digits + 1) n + d and 2d fit `kWords` words, and for
///           digits below 0, 2n + 2^-digits d and 2^(1 - digits) d;
///           `approximate` is off n / d by `error` at most, which is at most
///           2^-48 of it, and less than 2^60 cells from 0.
template <std::size_t kWords, std::size_t kFew>
std::int64_t exact_cell(double approximate, const Wide<kFew>& n,
                        const Wide<kFew>& d, int digits) {
  using More = Wide<kWords>;
  const More unit =
      digits >= 0 ? More(d) : multiply<kWords>(Int128{1} << -digits, d);
  const More by = unit + unit;
  const More whole =
      multiply<kWords>(Int128{2} << std::max(digits, 0), n) + unit;
  auto cell = static_cast<std::int64_t>(
      std::floor(approximate * power_of_two(digits) + 0.5));
  while (true) {
    // Off by no more than a step once the rest is small.
    const More rest = whole - multiply<kWords>(Int128{cell}, by);
    if (!rest.is_negative() && (rest - by).is_negative()) return cell;
    const double steps = std::floor(to_double(rest) / to_double(by));
    cell += steps != 0 ? static_cast<std::int64_t>(steps)
                       : (rest.is_negative() ? -1 : 1);
  }
}

/// The same, from doubles alone if their error leaves no doubt.
template <std::size_t kWords, std::size_t kFew>
std::int64_t cell_of(double approximate, double error, const Wide<kFew>& n,
                     const Wide<kFew>& d, int digits) {
  const double at = approximate * power_of_two(digits) + 0.5;
  // Never true: points are on edges of faces, so within the grid.
  if (!(std::abs(at) < 0x1p60)) return 0;
  const double cell = std::floor(at);
  // Adding one half rounds by 2^-53 of the sum.
  const double doubt =
      error * power_of_two(digits) * 1.125 + std::abs(at) * 0x1p-52;
  if (at - cell > doubt && cell + 1 - at > doubt)
    return static_cast<std::int64_t>(cell);
  return exact_cell<kWords>(approximate, n, d, digits);
}

inline std::uint64_t mixed(std::uint64_t h) {
  h = (h ^ (h >> 32)) * 0x9e3779b97f4a7c15u;
  h = (h ^ (h >> 29)) * 0xbf58476d1ce4e5b9u;
  return h ^ (h >> 32);
}
inline std::uint64_t hash_of(std::uint64_t a, std::uint64_t b,
                             std::uint64_t c) {
  return mixed(mixed(mixed(a) + b) + c);
}

}  // namespace halfspace::fast
