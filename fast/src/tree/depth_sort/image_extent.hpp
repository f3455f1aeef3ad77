#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "camera/view.hpp"
#include "halfspace/fast/build.hpp"

namespace halfspace::fast {

/// Bounds of the depths and of the image of a fragment. Where doubles do not
/// tell, the image is unbounded.
struct ImageExtent {
  double depth_low = 0;
  double depth_high = 0;
  double x_low = -std::numeric_limits<double>::infinity();
  double x_high = std::numeric_limits<double>::infinity();
  double y_low = -std::numeric_limits<double>::infinity();
  double y_high = std::numeric_limits<double>::infinity();

  bool is_bounded() const {
    return x_high < std::numeric_limits<double>::infinity();
  }
  /// Whether the images have certainly no common x, or no common y.
  bool is_apart_from(const ImageExtent& other) const {
    return x_high < other.x_low || other.x_high < x_low ||
           y_high < other.y_low || other.y_high < y_low;
  }
};

/// A vertex in the image. Units: pixels.
struct ImageCorner {
  std::int32_t vertex = 0;  ///< its index: equal ones are one point
  double x = 0;
  double y = 0;
};

/// The image of a fragment: its corners, each off by at most `error` in x and
/// in y. Empty where doubles do not tell.
struct ImageOutline {
  std::vector<ImageCorner> corners;
  double error = 0;
};

/// The image of a point, or nothing certain.
struct ImageOfVertex {
  double depth = 0;
  double depth_error = 0;
  double x = 0;
  double y = 0;
  double error = std::numeric_limits<double>::infinity();
};

ImageOfVertex image_of_vertex(const View& view, const Vertex& v);

/// Adds what `image` bounds. `is_first`: to nothing.
void extend(ImageExtent& extent, const ImageOfVertex& image, bool is_first);

/// Whether a line along an edge of `p` certainly has `p` and `q` on its two
/// sides, corners of both on it allowed.
///
/// With corners off by e, the differences of coordinates are off by 2e, and
/// their products' difference d1 d2 - d3 d4 by 2e (|d1| + ... + |d4|) + 8e^2;
/// rounding adds 4u of the products' sizes, 8u with a margin.
bool separates(const ImageOutline& p, const ImageOutline& q);

}  // namespace halfspace::fast
