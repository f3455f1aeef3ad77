#pragma once

#include "raster/layers/leaf_layers.hpp"
#include "raster/polygon_rasterizer.hpp"
#include "raster/tile_buffer.hpp"

namespace halfspace::fast {

/// Shows the frame's tree back to front, each fragment over what is there.
template <int kBits>
void show_back_to_front(const Frame& frame, TileBuffer& buffer,
                        PolygonRasterizer<kBits>& rasterizer,
                        LeafLayers& layers, FilterStats& stats);

}  // namespace halfspace::fast
