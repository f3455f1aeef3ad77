#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "halfspace/clip.hpp"
#include "halfspace/polygon.hpp"

namespace halfspace {

/// How polygons get their colours (S5.4).
enum class Shading : std::uint8_t { kFlat, kGouraud };

/// The options of an image, beside scene and camera (S5.2).
struct ImageOptions {
  bool cull = false;  ///< polygons whose negative side the eye is on are unseen
  Shading shading = Shading::kFlat;
  Rgb background = {255, 255, 255};
  /// What is on the negative side of any of these is not there (S10.2). They
  /// are of make_clips().
  std::vector<ClipPlane> clips = {};
  /// Whether and how the cuts of a closed scene are filled (S10.3).
  std::optional<CapStyle> caps = std::nullopt;
  /// With caps: of what parts they are (S10.6); null: they are not told apart.
  std::shared_ptr<const CapParts> parts = nullptr;

  friend bool operator==(const ImageOptions& a, const ImageOptions& b) {
    const bool same_parts =
        a.parts == b.parts || (a.parts && b.parts && *a.parts == *b.parts);
    return same_parts && a.cull == b.cull && a.shading == b.shading &&
           a.background == b.background && a.clips == b.clips &&
           a.caps == b.caps;
  }
};

/// The alpha of polygons that nothing is seen through (S5.6); 0 is that of
/// polygons that are not seen.
constexpr std::uint8_t kOpaque = 255;

/// The id of the background in an item image.
constexpr PolygonId kBackground = -1;

/// One value a pixel, row by row from the top left. Units: pixels.
template <class T>
struct Grid2 {
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  std::vector<T> pixels;

  Grid2() = default;
  Grid2(std::int32_t width, std::int32_t height, T value)
      : width_px(width),
        height_px(height),
        pixels(
            static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
            value) {}

  /// Requires: 0 <= i < width_px and 0 <= j < height_px.
  T& at(std::int32_t i, std::int32_t j) { return pixels[offset(i, j)]; }
  const T& at(std::int32_t i, std::int32_t j) const {
    return pixels[offset(i, j)];
  }
  friend bool operator==(const Grid2&, const Grid2&) = default;

 private:
  std::size_t offset(std::int32_t i, std::int32_t j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(width_px) +
           static_cast<std::size_t>(i);
  }
};

/// The polygon seen at each pixel, or kBackground (S5.1).
using ItemImage = Grid2<PolygonId>;

/// The colour of each pixel (S5.4).
using ColorImage = Grid2<Rgb>;

}  // namespace halfspace
