#pragma once

#include <cstddef>

#include "halfspace/bsp_tree.hpp"
#include "halfspace/camera.hpp"
#include "halfspace/fast/build.hpp"
#include "halfspace/fast/painter.hpp"
#include "halfspace/fast/render.hpp"
#include "halfspace/image.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::bench {

/// The fast library on one scene and one camera, its tree built beforehand.
///
/// Requires: scene and tree outlive it.
class Ours {
 public:
  Ours(const Scene& scene, const fast::BspTree& tree, const Camera& camera,
       fast::SimdLevel simd = fast::SimdLevel::kBest)
      : scene_(scene), tree_(tree), camera_(camera), simd_(simd) {}

  /// Draws one frame from front to back: colours, as everyone else does.
  void draw(Shading shading, int threads = 1) { draw(shading, threads, false); }

  /// Draws one frame with its item image.
  void draw_all(Shading shading, int threads = 1) {
    draw(shading, threads, true);
  }

  /// Draws one frame from back to front: colours.
  /// Requires: a tree by rule.
  void paint(Shading shading) {
    // Into the same memory as draw(), which would else have less to do.
    fast::RenderOptions options;
    options.items = false;
    options.simd = simd_;
    fast::paint(scene_, tree_, camera_, look(shading), options, frame_);
  }

  /// The frame that was drawn last.
  const fast::Rendering& frame() const { return frame_; }

 private:
  void draw(Shading shading, int threads, bool items) {
    fast::RenderOptions options;
    options.threads = threads;
    options.simd = simd_;
    options.items = items;
    fast::render(scene_, tree_, camera_, look(shading), options, frame_);
  }

  static ImageOptions look(Shading shading) {
    ImageOptions options;
    options.shading = shading;
    return options;
  }

  const Scene& scene_;
  const fast::BspTree& tree_;
  Camera camera_;
  fast::SimdLevel simd_;
  fast::Rendering frame_;
};

/// A tree and what it took.
struct Built {
  fast::BspTree tree;
  TreeStats stats;
  double build_ms = 0;    ///< processor time, one thread
  std::size_t bytes = 0;  ///< of the tree's arrays
};

/// The tree that a user gets for display: fast::build_display_tree, in one
/// thread.
Built build_for_display(const Scene& scene);

/// A tree of the papers, by the options.
Built build_by_rule(const Scene& scene, const BuildOptions& options);

}  // namespace halfspace::bench
