#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "halfspace/image.hpp"
#include "raster/frame.hpp"
#include "raster/gouraud.hpp"
#include "raster/kernel/tile_kernel.hpp"
#include "raster/layers/layer_colors.hpp"

namespace halfspace::fast {

/// The share of a channel that lies over another, with what nearest_of_255()
/// wants to be added.
constexpr std::uint16_t share_of(std::uint8_t over, std::uint8_t alpha) {
  return static_cast<std::uint16_t>(alpha * over + 128);
}

/// The integer next to x / 255 for t = x + 128, x from 0 to 255^2: there is no
/// half, 255 being odd. It is (t + t / 256) / 256, both quotients rounded down;
/// all of that fits 16 bits.
constexpr std::uint8_t nearest_of_255(int t) {
  return static_cast<std::uint8_t>((t + (t >> 8)) >> 8);
}

/// A channel of `alpha` / 255 parts of `over` and the rest of `under`, rounded
/// half up (S5.6).
constexpr std::uint8_t blended(std::uint8_t over, std::uint8_t under,
                               std::uint8_t alpha) {
  return nearest_of_255(share_of(over, alpha) + (kOpaque - alpha) * under);
}

/// Writes polygons into the images, one over the other (S5.6; PD84 "over").
class LayerBlender {
 public:
  LayerBlender(const Frame& frame, const TileView& screen)
      : frame_(frame),
        screen_(screen),
        rest_(static_cast<std::uint16_t>(kOpaque - frame.alpha)),
        shader_(frame.reader.scene(), frame.camera, frame.view, frame.moved),
        own_(frame.colors != nullptr ? frame.colors->shader() : nullptr) {}

  bool has_items() const { return screen_.items != nullptr; }
  bool has_colors() const { return screen_.colors != nullptr; }
  std::uint8_t alpha() const { return frame_.alpha; }

  /// Blends a polygon with what the pixels `bits` (8 words) of the tile with
  /// the left top pixel (x, y) show. Requires: colours are wanted.
  void blend(const PixelSource& source, std::int32_t x, std::int32_t y,
             const std::uint32_t* bits);
  /// Writes its id there. Requires: items are wanted.
  void put_item(PolygonId id, std::int32_t x, std::int32_t y,
                const std::uint32_t* bits);

  /// The polygon's colours at the pixels `bits` of line y from column x on.
  void shade(const PixelSource& source, std::int32_t x, std::int32_t y,
             std::uint32_t bits, LineColors& colors);
  /// Blends colours at the pixels `bits` of line y from column x on. Requires:
  /// colours are wanted.
  void blend_line(const LineColors& over, std::uint32_t bits, std::int32_t x,
                  std::int32_t y);
  /// The item of a pixel. Requires: items are wanted.
  PolygonId* item_at(std::int32_t x, std::int32_t y) {
    return screen_.items + screen_.pixel_at(x, y);
  }

  FilterStats stats() const;

 private:
  void set_flat(std::uint32_t color);

  const Frame& frame_;
  const TileView& screen_;
  std::uint16_t rest_;  ///< what an alpha leaves of what is behind
  GouraudShader shader_;
  std::unique_ptr<LayerColors::Shader> own_;  ///< in place of that, or null
  PolygonId shaded_ = kBackground;            ///< whose colours shader_ has
  LineColors over_{};                         ///< of a smooth polygon
  /// The shares of a flat one's channels, so many that they repeat as vectors.
  std::array<std::uint16_t, 3 * kTileWidth> shares_{};
  std::uint32_t flat_ = PixelSource::kSmooth;  ///< whose shares these are
  FilterStats stats_;
};

}  // namespace halfspace::fast
