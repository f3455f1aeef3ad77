#pragma once

#include <functional>

#include "halfspace/ref/render.hpp"
#include "halfspace/scalars.hpp"
#include "halfspace/visible_map.hpp"

namespace halfspace::ref {

/// The image of the scene by a look: opaque or blended, with samples, marked
/// (S5.6 to S5.8). Its items are those of samples.
///
/// Requires: look.samples is 1, 2, 4 or 8, and an image of that many times the
///           size has at most kMaxImageSize columns and rows.
/// Exact:    yes.
Rendering render_look(const Scene& scene, const BspTree& tree,
                      const Camera& camera, const ImageOptions& options,
                      const Look& look);

/// The same in the colours of scalars (S11.4).
///
/// Requires: no mark; a field of the scene (make_scalars()); is_valid(scale).
Rendering render_look(const Scene& scene, const BspTree& tree,
                      const Camera& camera, const ImageOptions& options,
                      const Look& look, const ScalarField& field,
                      const ColorScale& scale);

}  // namespace halfspace::ref
