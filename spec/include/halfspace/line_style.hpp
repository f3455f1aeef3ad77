#pragma once

#include <cstdint>

#include "halfspace/drawing.hpp"
#include "halfspace/image.hpp"
#include "halfspace/polygon.hpp"

namespace halfspace {

/// The widest line. Units: sixteenths of a pixel.
constexpr std::int32_t kMostLineWidth = 4096;

/// A set of classes of edges, a bit each.
using EdgeClasses = std::uint32_t;
constexpr EdgeClasses set_of(EdgeClass edge_class) {
  return EdgeClasses{1} << static_cast<unsigned>(edge_class);
}
constexpr EdgeClasses kAllClasses = (EdgeClasses{1} << 5) - 1;

/// How lines are drawn over an image (S14.1).
struct LineStyle {
  std::int32_t width = 16;  ///< sixteenths of a pixel, 1 to kMostLineWidth
  Rgb color = {20, 20, 24};
  EdgeClasses classes = kAllClasses;
  friend bool operator==(const LineStyle&, const LineStyle&) = default;
};

/// The drawing whose strokes are the lines over an image with these options:
/// that of what its clip planes leave (S14.2).
inline DrawingOptions drawing_over(const ImageOptions& image) {
  DrawingOptions drawing;
  drawing.cull = image.cull;
  drawing.clips = image.clips;
  drawing.caps = image.caps.has_value();
  return drawing;
}

/// A colour of which `part` of `whole` samples have the line's (S14.3).
/// Requires: 0 <= part <= whole <= 64.
constexpr Rgb with_line(const Rgb& under, const Rgb& line, int part,
                        int whole) {
  const auto channel = [&](int v, int c) {
    return static_cast<std::uint8_t>(
        (2 * (part * c + (whole - part) * v) + whole) / (2 * whole));
  };
  return {channel(under.r, line.r), channel(under.g, line.g),
          channel(under.b, line.b)};
}

}  // namespace halfspace
