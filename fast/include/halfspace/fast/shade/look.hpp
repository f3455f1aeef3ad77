#pragma once

#include "halfspace/fast/image/lazy_tree.hpp"
#include "halfspace/fast/render.hpp"
#include "halfspace/fast/shade/scalars.hpp"
#include "halfspace/visible_map.hpp"

namespace halfspace::fast {

/// The image of the scene by a look: opaque or blended, with samples, marked
/// (S5.6 to S5.8), and where there are `scalars`, in their colours (S11.4). Its
/// items are those of samples.
///
/// Requires: look.samples is 1, 2, 4 or 8, and an image of that many times the
///           size has at most kMaxImageSize columns and rows; no mark where
///           there are scalars, which are of the scene; what render() and
///           blend() ask for.
/// Exact:    yes.
/// Cost:     that of render(), render_samples() or blend(); of what is blended
///           or marked every sample is written, and its colours that vary over
///           a polygon are computed.
Rendering render_look(const Scene& scene, const BspTree& tree,
                      const Camera& camera, const ImageOptions& image,
                      const Look& look, const RenderOptions& options = {},
                      const ScalarColors* scalars = nullptr);
/// The same into images that are there.
void render_look(const Scene& scene, const BspTree& tree, const Camera& camera,
                 const ImageOptions& image, const Look& look,
                 const RenderOptions& options, const ScalarColors* scalars,
                 Rendering& result);
Rendering render_look(const LazyTree& tree, const Camera& camera,
                      const ImageOptions& image, const Look& look,
                      const RenderOptions& options = {},
                      const ScalarColors* scalars = nullptr);

}  // namespace halfspace::fast
