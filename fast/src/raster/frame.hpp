#pragma once

#include <cstdint>

#include "camera/moved_camera.hpp"
#include "camera/view.hpp"
#include "halfspace/camera.hpp"
#include "halfspace/image.hpp"
#include "raster/clip_set.hpp"
#include "raster/kernel/tile_kernel.hpp"
#include "tree/tree_reader.hpp"

namespace halfspace::fast {

class LayerColors;

/// What all threads of one frame share.
struct Frame {
  const TreeReader& reader;
  const CameraData& camera;
  const ImageOptions& image;
  const View& view;
  const TileKernel& kernel;
  const ClipSet& clips;
  std::uint8_t alpha = kOpaque;  ///< below that colours are blended (S5.6)
  /// Colours in place of the scene's where they are blended, or null.
  const LayerColors* colors = nullptr;
  /// In the frame of an object: the camera there, and the id of its polygon 0.
  const MovedCamera* moved = nullptr;
  PolygonId first_id = 0;
};

/// The camera of exact decisions.
template <int kBits>
const ExactCamera<kBits>& exact_camera(const Frame& frame) {
  if constexpr (kBits == kMovedGrid) {
    return *frame.moved;
  } else {
    return frame.camera;
  }
}

}  // namespace halfspace::fast
