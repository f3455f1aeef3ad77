#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>

#include "exact/exact_plane.hpp"
#include "exact/filter.hpp"
#include "tree/scene_planes.hpp"

namespace halfspace::fast {

/// A double, and how far off what it stands for it can be, to first order.
struct Noisy {
  double value = 0;
  double error = 0;
};
inline Noisy rounded_of(double value, double error) {
  return {value, error + kRounding * std::abs(value)};
}
inline Noisy operator+(Noisy a, Noisy b) {
  return rounded_of(a.value + b.value, a.error + b.error);
}
inline Noisy operator-(Noisy a, Noisy b) {
  return rounded_of(a.value - b.value, a.error + b.error);
}
inline Noisy operator/(Noisy a, Noisy b) {
  return rounded_of(a.value / b.value,
                    (a.error + std::abs(a.value / b.value) * b.error) /
                        (std::abs(b.value) - b.error));
}
inline Noisy operator*(Noisy a, Noisy b) {
  return rounded_of(a.value * b.value, std::abs(a.value) * b.error +
                                           std::abs(b.value) * a.error +
                                           a.error * b.error);
}
/// An integer that was rounded to a double.
inline Noisy converted(double value) { return rounded_of(value, 0); }
inline Noisy exactly(double value) { return {value, 0}; }

/// The largest share of its bound that an error reaches.
struct Share {
  double largest = 0;
  void add(double error, double bound) {
    largest = std::max(largest, error / bound);
  }
  /// The bound holds, and is not so generous that filters do nothing.
  void expect_tight() const {
    EXPECT_LE(largest, 1);
    EXPECT_GE(largest, 0.26);
  }
};

class Random {
 public:
  /// Mostly near the ends of the range.
  std::int64_t coordinate(int bits) {
    const std::int64_t most = (std::int64_t{1} << (bits - 1)) - 1;
    const std::int64_t off = static_cast<std::int64_t>(engine_() % 1000);
    const std::int64_t some =
        engine_() % 4 != 0 ? most - off * (most / 4000)
                           : static_cast<std::int64_t>(
                                 engine_() % static_cast<std::uint64_t>(most));
    return engine_() % 2 == 0 ? some : -some;
  }
  GridPoint point(int bits) {
    return {coordinate(bits), coordinate(bits), coordinate(bits)};
  }
  double from_to(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }

 private:
  std::mt19937_64 engine_{3};
};

inline Plane plane_through(Random& random, int bits) {
  return with_grid(bits, [&](auto grid) {
    return rounded(exact_plane<grid()>(
        {random.point(bits), random.point(bits), random.point(bits)}));
  });
}

inline Noisy value_of(const Plane& p, const std::array<Noisy, 3>& at,
                      bool direction) {
  const Noisy d = direction ? exactly(0) : converted(p.d);
  return converted(p.a) * at[0] + converted(p.b) * at[1] +
         converted(p.c) * at[2] + d;
}

}  // namespace halfspace::fast
