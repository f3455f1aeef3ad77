#pragma once

#include "halfspace/ref/render.hpp"

namespace halfspace::ref {

/// The image of the scene (S5.1) by a z-buffer: no tree, polygons uncut, in
/// id order (S5.5).
///
/// An oracle. Coverage (S4.5) and depth (S5.3) are signs of functions that are
/// affine in the image point, read at the sample (S4.4): nothing is clipped,
/// divided, projected or scan converted to decide them.
/// Exact: yes.
/// Ties:  equal depth means coplanar: the lowest id stays.
/// Cost:  one evaluation for each edge and each pixel of the polygon's
///        bounding rectangle, or of the image if it is partly behind the eye.
Rendering zbuffer(const Scene& scene, const Camera& camera,
                  const ImageOptions& options);

}  // namespace halfspace::ref
