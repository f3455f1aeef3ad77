#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "halfspace/fast/predicate.hpp"
#include "halfspace/polygon.hpp"
#include "raster/kernel/tile_view.hpp"

namespace halfspace::fast {

/// The colours of the 32 pixels of a tile's line.
using LineColors = std::array<std::uint8_t, 3 * kTileWidth>;

/// Colours that polygons have in place of the scene's where they are blended.
class LayerColors {
 public:
  virtual ~LayerColors() = default;

  /// Those of one polygon after another. Each thread has its own.
  class Shader {
   public:
    virtual ~Shader() = default;
    /// The polygon's colours at the pixels `bits` of line y from column x on.
    virtual void shade(PolygonId polygon, std::int32_t x, std::int32_t y,
                       std::uint32_t bits, LineColors& colors) = 0;
    virtual const FilterStats& stats() const = 0;
  };

  /// The colour of all of a polygon, as PixelSource::color has it.
  virtual std::uint32_t color_of(PolygonId polygon) const = 0;
  virtual std::unique_ptr<Shader> shader() const = 0;
};

}  // namespace halfspace::fast
