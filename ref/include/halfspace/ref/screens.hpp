#pragma once

#include "halfspace/camera.hpp"
#include "halfspace/image.hpp"
#include "halfspace/ref/build.hpp"
#include "halfspace/ref/render.hpp"
#include "halfspace/scene.hpp"
#include "halfspace/screen_kind.hpp"

namespace halfspace::ref {

/// render(), onto a screen of that kind (S4.9).
///
/// Exact: yes: the 2-D tree's lines are the images of fragments' edges.
Rendering render_on(const Scene& scene, const BspTree& tree,
                    const Camera& camera, const ImageOptions& options,
                    ScreenKind kind);

}  // namespace halfspace::ref
