#pragma once

#include <cstddef>

#include "halfspace/camera.hpp"
#include "halfspace/fast/build.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::fast {

/// What of a tree a camera has behind it (S3.10).
struct BehindCount {
  std::size_t subtrees = 0;   ///< that a walk leaves out as a whole
  std::size_t nodes = 0;      ///< in them
  std::size_t fragments = 0;  ///< in them
};

/// Whether no ray of the image meets the open half-space on side `side` of the
/// plane of polygon `splitter` (S3.10; FAQ).
///
/// Requires: side is not Side::kOn.
/// Exact:    yes.
bool is_behind(const Scene& scene, PolygonId splitter, const Camera& camera,
               Side side);

/// The subtrees that render() and paint() leave out of a tree without boxes by
/// this test alone; those with boxes are left out sooner where a box is off the
/// image, too.
BehindCount count_behind(const Scene& scene, const BspTree& tree,
                         const Camera& camera);

}  // namespace halfspace::fast
