#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "halfspace/camera.hpp"
#include "halfspace/image.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::bench {

/// A pixel as the peers write it: red, green, blue, 255 from the lowest byte.
using Pixel = std::uint32_t;

constexpr Pixel to_pixel(Rgb color) {
  return Pixel{color.r} | Pixel{color.g} << 8 | Pixel{color.b} << 16 |
         Pixel{255} << 24;
}

/// A pixel that names a triangle, and back; background is white, which no
/// scene of fewer than 2^24 - 1 triangles uses.
constexpr Pixel id_pixel(PolygonId id) {
  return (static_cast<Pixel>(id) & 0xffffff) | Pixel{255} << 24;
}
constexpr Pixel kWhite = 0xffffffff;
constexpr PolygonId id_of(Pixel pixel) {
  return pixel == kWhite ? kBackground
                         : static_cast<PolygonId>(pixel & 0xffffff);
}

/// A triangle as the peers take it: a part of a polygon, in floating point.
struct SoupTriangle {
  std::array<std::array<float, 3>, 3> corners;  ///< the grid's, scaled
  std::array<Pixel, 3> corner_colors;
  Pixel color;
  PolygonId source;
};

/// The orders in which peers are given their triangles.
enum class Order { kInput, kFrontToBack, kBackToFront };

/// The scene as the peers take it: triangles, n-gons cut into fans, with
/// coordinates scaled to about -1 to 1.
///
/// Requires: the camera is in perspective and everything is before the eye.
struct Soup {
  std::vector<SoupTriangle> triangles;
  /// Row k times (x, y, z, 1): the homogeneous image point (x w, y w, w).
  std::array<std::array<double, 4>, 3> to_image;
  std::array<double, 3> eye;
  /// The image point (x, y) is seen along `corner + x right + y down`.
  std::array<double, 3> corner, right, down;
  std::int32_t width_px;
  std::int32_t height_px;
  double near;  ///< no corner's w is below
  double far;   ///< no corner's w is above
};

Soup make_soup(const Scene& scene, const Camera& camera);

/// Indices of the triangles in that order of their centres' depths; for
/// triangles that meet or pass through each other the order may be wrong.
std::vector<std::uint32_t> order_of(const Soup& soup, Order order);

}  // namespace halfspace::bench
