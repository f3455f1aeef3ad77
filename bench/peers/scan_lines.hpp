#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "peers/soup.hpp"

namespace halfspace::bench {

/// A corner in the image.
struct ImagePoint {
  float x, y;
  float inverse_w;
};

/// The plain way of a textbook: each corner on its own, every frame.
inline ImagePoint project(const Soup& soup, const std::array<float, 3>& p) {
  std::array<float, 3> h{};
  for (std::size_t row = 0; row < 3; ++row) {
    const auto& m = soup.to_image[row];
    h[row] = static_cast<float>(m[0]) * p[0] + static_cast<float>(m[1]) * p[1] +
             static_cast<float>(m[2]) * p[2] + static_cast<float>(m[3]);
  }
  const float inverse = 1 / h[2];
  return {h[0] * inverse, h[1] * inverse, inverse};
}

/// The first pixel whose centre is at or right of `x`, kept within 0 to
/// `count`.
inline std::int32_t first_pixel(float x, std::int32_t count) {
  const float limit = static_cast<float>(count);
  return static_cast<std::int32_t>(
      std::ceil(std::clamp(x - 0.5f, 0.0f, limit)));
}

/// Calls line(j, first, end) for each scan line j on which the triangle covers
/// the pixels from `first` up to but not including `end`.
template <class Line>
void for_each_scan_line(std::array<ImagePoint, 3> p, std::int32_t width_px,
                        std::int32_t height_px, Line&& line) {
  if (p[1].y < p[0].y) std::swap(p[0], p[1]);
  if (p[2].y < p[1].y) std::swap(p[1], p[2]);
  if (p[1].y < p[0].y) std::swap(p[0], p[1]);
  const std::int32_t top = first_pixel(p[0].y, height_px);
  const std::int32_t middle = first_pixel(p[1].y, height_px);
  const std::int32_t bottom = first_pixel(p[2].y, height_px);
  if (top >= bottom) return;
  const auto slope = [](const ImagePoint& a, const ImagePoint& b) {
    return (b.x - a.x) / (b.y - a.y);
  };
  const auto at = [](const ImagePoint& a, float step, std::int32_t j) {
    return a.x + step * (static_cast<float>(j) + 0.5f - a.y);
  };
  const float long_step = slope(p[0], p[2]);
  float long_x = at(p[0], long_step, top);
  const auto part = [&](const ImagePoint& a, const ImagePoint& b,
                        std::int32_t from, std::int32_t to) {
    if (from >= to) return;
    const float step = slope(a, b);
    float x = at(a, step, from);
    for (std::int32_t j = from; j < to; ++j) {
      const std::int32_t first = first_pixel(std::min(x, long_x), width_px);
      const std::int32_t end = first_pixel(std::max(x, long_x), width_px);
      if (first < end) line(j, first, end);
      x += step;
      long_x += long_step;
    }
  };
  part(p[0], p[1], top, middle);
  part(p[1], p[2], middle, bottom);
}

/// A value that is affine over the image: at + x dx + y dy.
struct Gradient {
  float at, dx, dy;
  float value(std::int32_t i, std::int32_t j) const {
    return at + (static_cast<float>(i) + 0.5f) * dx +
           (static_cast<float>(j) + 0.5f) * dy;
  }
};

/// The affine function with the value v[k] at p[k].
inline Gradient gradient(const std::array<ImagePoint, 3>& p,
                         const std::array<float, 3>& v) {
  const float x1 = p[1].x - p[0].x, y1 = p[1].y - p[0].y;
  const float x2 = p[2].x - p[0].x, y2 = p[2].y - p[0].y;
  const float area = x1 * y2 - x2 * y1;
  const float inverse = area != 0 ? 1 / area : 0;
  const float v1 = v[1] - v[0], v2 = v[2] - v[0];
  const float dx = (v1 * y2 - v2 * y1) * inverse;
  const float dy = (v2 * x1 - v1 * x2) * inverse;
  return {v[0] - dx * p[0].x - dy * p[0].y, dx, dy};
}

}  // namespace halfspace::bench
