#pragma once

#include <cstdint>

/// Numbers one at a time. These are inlined for certain: a body of its own
/// would be shared by files that are compiled for different instructions.
namespace halfspace::fast::scalar {

template <class T>
[[gnu::always_inline]] constexpr T least(T a, T b) {
  return a < b ? a : b;
}
template <class T>
[[gnu::always_inline]] constexpr T most(T a, T b) {
  return a > b ? a : b;
}

[[gnu::always_inline]] constexpr double size_of(double a) {
  return a < 0 ? -a : a;
}

/// The least integer k whose k + 1/2 is not below `v`, for |v| < 2^30.
[[gnu::always_inline]] constexpr std::int32_t first_centre(double v) {
  const double w = v - 0.5;
  const auto k = static_cast<std::int32_t>(w);
  return k + (w > static_cast<double>(k) ? 1 : 0);
}

/// Stores a colour.
[[gnu::always_inline]] inline void store_pixel(std::uint8_t* at,
                                               std::uint32_t packed) {
  __builtin_memcpy(at, &packed, 2);
  at[2] = static_cast<std::uint8_t>(packed >> 16);
}

/// Columns and lines are at most 65,536: beyond, only "beyond" matters.
[[gnu::always_inline]] constexpr double in_reach(double v) {
  return most(-1e6, least(1e6, v));
}

}  // namespace halfspace::fast::scalar
