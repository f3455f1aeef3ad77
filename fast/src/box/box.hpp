#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "halfspace/fast/types.hpp"

namespace halfspace::fast {

/// The least float that is not below `v`, or the next: rounding to nearest is
/// off by 2^-24 of the size, and a step of 2^-22 outweighs that.
inline float rounded_up(double v) {
  return static_cast<float>(v + std::abs(v) * 0x1p-22 +
                            std::numeric_limits<float>::min());
}
inline float rounded_down(double v) { return -rounded_up(-v); }

/// The empty box.
constexpr Box kEmptyBox = {
    {std::numeric_limits<float>::max(), std::numeric_limits<float>::max(),
     std::numeric_limits<float>::max()},
    {std::numeric_limits<float>::lowest(), std::numeric_limits<float>::lowest(),
     std::numeric_limits<float>::lowest()}};

/// Makes the box hold the vertex, wherever within its error it is.
inline void extend(Box& box, const Vertex& v) {
  const double p[3] = {v.x, v.y, v.z};
  for (std::size_t a = 0; a < 3; ++a) {
    box.low[a] = std::min(box.low[a], rounded_down(p[a] - v.error));
    box.high[a] = std::max(box.high[a], rounded_up(p[a] + v.error));
  }
}

/// The box of some vertices. Rounding outwards is monotonic, so it is done
/// once.
class Bounds {
 public:
  void add(const Vertex& v) {
    const double at[3] = {v.x, v.y, v.z};
    for (std::size_t k = 0; k < 3; ++k) {
      low_[k] = std::min(low_[k], at[k] - v.error);
      high_[k] = std::max(high_[k], at[k] + v.error);
    }
  }
  /// Requires: there are any.
  Box box() const {
    Box box;
    for (std::size_t k = 0; k < 3; ++k) {
      box.low[k] = rounded_down(low_[k]);
      box.high[k] = rounded_up(high_[k]);
    }
    return box;
  }

 private:
  static constexpr double kMost = std::numeric_limits<double>::max();
  std::array<double, 3> low_{kMost, kMost, kMost};
  std::array<double, 3> high_{-kMost, -kMost, -kMost};
};

/// Makes the box hold another.
inline void extend(Box& box, const Box& other) {
  for (std::size_t a = 0; a < 3; ++a) {
    box.low[a] = std::min(box.low[a], other.low[a]);
    box.high[a] = std::max(box.high[a], other.high[a]);
  }
}

}  // namespace halfspace::fast
