#pragma once

#include <cstddef>

#include "halfspace/camera.hpp"
#include "halfspace/fast/build.hpp"
#include "halfspace/fast/render.hpp"
#include "halfspace/image.hpp"
#include "halfspace/scene.hpp"
#include "halfspace/screen_kind.hpp"

namespace halfspace::fast {

/// What a screen took (S4.9).
struct ScreenWork {
  /// Unlit segments, nodes, squares or cells at the end.
  std::size_t parts = 0;
  /// Parts that were looked at.
  std::size_t steps = 0;
};

/// render(), onto a screen of that kind (S4.9; FAQ). For comparing screens:
/// what render() itself draws on is quicker than each of them.
///
/// Lists and trees of lines merge object segments, which exact edge functions
/// give; squares are compared with those functions; the 2-D tree divides by the
/// lines themselves, and its cells are turned to pixels at the end.
/// Caps come after (S10.3).
/// Requires: a tree of this scene without leaves (divide_leaves()); with caps a
///           closed scene.
/// Exact:    yes.
Rendering render_on(const Scene& scene, const BspTree& tree,
                    const Camera& camera, const ImageOptions& image,
                    ScreenKind kind, ScreenWork* work = nullptr);

}  // namespace halfspace::fast
