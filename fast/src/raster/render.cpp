#include "halfspace/fast/render.hpp"

#include <algorithm>
#include <vector>

#include "base/parallel.hpp"
#include "halfspace/assert.hpp"
#include "halfspace/fast/painter.hpp"
#include "raster/band_walk.hpp"
#include "raster/bands.hpp"
#include "raster/caps.hpp"
#include "raster/layers/layer_walk.hpp"
#include "raster/layers/leaf_layers.hpp"
#include "raster/lazy_walk.hpp"
#include "raster/polygon_rasterizer.hpp"
#include "raster/render_pass.hpp"
#include "raster/tile_buffer.hpp"
#include "tree/node_boxes.hpp"

namespace halfspace::fast {
namespace {

/// What one thread found.
struct BandResult {
  std::size_t pixels = 0;
  std::size_t fragments = 0;
  std::size_t tiles = 0;
  FilterStats stats;
};

template <int kBits>
BandResult found_by(const PolygonRasterizer<kBits>& rasterizer,
                    std::size_t pixels, const TileView& screen,
                    FilterStats stats) {
  stats.add(rasterizer.stats());
  return {pixels, rasterizer.fragments(),
          static_cast<std::size_t>(screen.touches), stats};
}

/// Fills what is unlit after the walk.
template <int kBits>
BandResult finish_band(const Frame& frame, TileView& screen,
                       PolygonRasterizer<kBits>& rasterizer,
                       const FilterStats& stats) {
  const std::int64_t unlit = rasterizer.fill_rest(frame.image.background);
  const std::int64_t all =
      std::int64_t{screen.columns.end - screen.columns.first} *
      (screen.lines.end - screen.lines.first);
  return found_by(rasterizer, static_cast<std::size_t>(all - unlit), screen,
                  stats);
}

template <int kBits>
BandResult render_band(const Frame& frame, TileBuffer& buffer,
                       const LazyTree::State* lazy) {
  FilterStats stats;
  if constexpr (kLazyTrees) {
    if (lazy != nullptr) {
      LazyWalk<kBits> walk(frame, *lazy, buffer);
      walk.show_front_to_back(stats);
      return finish_band(frame, buffer.view(), walk.rasterizer(), stats);
    }
  }
  PolygonRasterizer<kBits> rasterizer(frame, buffer.view());
  show_front_to_back(frame, buffer, rasterizer, stats, NoCells());
  return finish_band(frame, buffer.view(), rasterizer, stats);
}

/// `add_under()` adds what is behind all polygons, before the background.
template <int kBits, class AddUnder, class Walk>
BandResult paint_with(const Frame& frame, TileView& screen,
                      PolygonRasterizer<kBits>& rasterizer,
                      const AddUnder& add_under, Walk&& walk) {
  rasterizer.fill_rest(frame.image.background);
  add_under();
  LeafLayers layers(frame, screen, rasterizer);
  FilterStats stats;
  walk(layers, stats);
  stats.add(layers.stats());
  return found_by(rasterizer, rasterizer.pixels() + layers.pixels(), screen,
                  stats);
}

template <int kBits, class AddUnder>
BandResult paint_band(const Frame& frame, TileBuffer& buffer,
                      const LazyTree::State* lazy, const AddUnder& add_under) {
  TileView& screen = buffer.view();
  if constexpr (kLazyTrees) {
    if (lazy != nullptr) {
      LazyWalk<kBits> lazy_walk(frame, *lazy, buffer);
      return paint_with(lazy_walk.frame(), screen, lazy_walk.rasterizer(),
                        add_under, [&](LeafLayers& layers, FilterStats& stats) {
                          lazy_walk.show_back_to_front(layers, stats);
                        });
    }
  }
  PolygonRasterizer<kBits> rasterizer(frame, screen);
  return paint_with(frame, screen, rasterizer, add_under,
                    [&](LeafLayers& layers, FilterStats& stats) {
                      show_back_to_front(frame, buffer, rasterizer, layers,
                                         stats);
                    });
}

}  // namespace

void run(const Scene& scene, const BspTree& tree, const Camera& camera,
         const ImageOptions& image, const RenderOptions& options, Pass pass,
         Rendering& result) {
  HALFSPACE_ASSERT(options.threads >= 0);
  const int threads = thread_count(options.threads);
  const CameraData& data = camera.data();
  const Rectangle rectangle = options.rectangle.value_or(Rectangle{
      0, 0, data.width_px * pass.samples, data.height_px * pass.samples});
  HALFSPACE_ASSERT(0 <= rectangle.left && rectangle.left < rectangle.right &&
                   rectangle.right <= data.width_px * pass.samples);
  HALFSPACE_ASSERT(0 <= rectangle.top && rectangle.top < rectangle.bottom &&
                   rectangle.bottom <= data.height_px * pass.samples);
  const std::int32_t width = rectangle.right - rectangle.left;
  const std::int32_t height = rectangle.bottom - rectangle.top;
  // Caps are compared with what is seen.
  const bool has_caps = image.caps && !image.clips.empty();
  const bool items = options.items || has_caps;
  resize_image(result.items, items ? width : 0, items ? height : 0);
  resize_image(result.colors, options.colors ? width : 0,
               options.colors ? height : 0);

  const bool leaves = pass.lazy != nullptr || has_leaves(tree);
  const TreeReader reader(scene, tree);
  const View view =
      make_view(camera, extent_of(tree, scene.grid_bits()), pass.samples);
  const ClipSet clips(image.clips, image.caps.has_value(), scene.grid_bits());
  const Frame frame = {
      reader, data,       image,      view, best_kernel(options.simd),
      clips,  pass.alpha, pass.colors};
  const std::vector<PixelRange> bands = bands_of(rectangle, threads);
  std::vector<BandResult> found(bands.size());
  const CapChanges own =
      has_caps && !pass.caps ? cap_changes(frame, rectangle) : CapChanges();
  const CapChanges& changes = pass.caps ? *pass.caps : own;
  const bool blends_caps = has_caps && pass.alpha != kOpaque;
  const auto one = [&](std::size_t b) {
    // Of caps those behind what is kept come first, those before it last (S10,
    // "Caps are composed first or last").
    const auto add_under = [&] {
      if (blends_caps)
        blend_caps(frame, rectangle, bands[b], changes, 1, result);
    };
    TileBuffer buffer(rectangle, bands[b], result,
                      leaves && pass.order == Order::kFrontToBack);
    if (pass.means != nullptr) buffer.add_up(pass.samples);
    found[b] = with_grid(scene.grid_bits(), [&](auto bits) {
      return pass.order == Order::kFrontToBack
                 ? render_band<bits()>(frame, buffer, pass.lazy)
                 : paint_band<bits()>(frame, buffer, pass.lazy, add_under);
    });
    if (pass.means != nullptr)
      frame.kernel.write_means(buffer.view(), &pass.means->r);
  };
  if (threads == 1) {
    one(0);
  } else {
    for_bands(bands.size(), threads, one);
  }
  if (has_caps) {
    if (blends_caps) {
      blend_caps(frame, rectangle, {rectangle.top, rectangle.bottom}, changes,
                 -1, result);
    }
    add_caps(frame, rectangle, changes,
             static_cast<PolygonId>(scene.polygon_count()), result);
    if (!options.items) result.items = {};
  }
  result.pixels_painted = 0;
  result.fragments_displayed = 0;
  result.tiles_touched = 0;
  result.decisions = {};
  for (const BandResult& band : found) {
    result.pixels_painted += band.pixels;
    result.fragments_displayed += band.fragments;
    result.tiles_touched += band.tiles;
    result.decisions.add(band.stats);
  }
}

Rendering render(const Scene& scene, const BspTree& tree, const Camera& camera,
                 const ImageOptions& image, const RenderOptions& options) {
  Rendering result;
  run(scene, tree, camera, image, options, {}, result);
  return result;
}

void render(const Scene& scene, const BspTree& tree, const Camera& camera,
            const ImageOptions& image, const RenderOptions& options,
            Rendering& result) {
  run(scene, tree, camera, image, options, {}, result);
}

Rendering paint(const Scene& scene, const BspTree& tree, const Camera& camera,
                const ImageOptions& image, const RenderOptions& options) {
  Rendering result;
  run(scene, tree, camera, image, options, {Order::kBackToFront}, result);
  return result;
}

void paint(const Scene& scene, const BspTree& tree, const Camera& camera,
           const ImageOptions& image, const RenderOptions& options,
           Rendering& result) {
  run(scene, tree, camera, image, options, {Order::kBackToFront}, result);
}

Rendering blend(const Scene& scene, const BspTree& tree, const Camera& camera,
                const ImageOptions& image, std::uint8_t alpha,
                const RenderOptions& options) {
  Rendering result;
  run(scene, tree, camera, image, options, {Order::kBackToFront, alpha},
      result);
  return result;
}

namespace {

Rendering run_lazy(const LazyTree& tree, const Camera& camera,
                   const ImageOptions& image, const RenderOptions& options,
                   Pass pass) {
  pass.lazy = &tree.state();
  Rendering result;
  run(tree.scene(), tree.state().root.tree, camera, image, options, pass,
      result);
  return result;
}

}  // namespace

Rendering render(const LazyTree& tree, const Camera& camera,
                 const ImageOptions& image, const RenderOptions& options) {
  return run_lazy(tree, camera, image, options, {});
}

Rendering render_samples(const LazyTree& tree, const Camera& camera,
                         const ImageOptions& image, std::int32_t samples,
                         const RenderOptions& options) {
  Pass pass;
  pass.samples = samples;
  pass.lazy = &tree.state();
  return run_samples(tree.scene(), tree.state().root.tree, camera, image,
                     options, pass);
}

Rendering paint(const LazyTree& tree, const Camera& camera,
                const ImageOptions& image, const RenderOptions& options) {
  return run_lazy(tree, camera, image, options, {Order::kBackToFront});
}

Rendering blend(const LazyTree& tree, const Camera& camera,
                const ImageOptions& image, std::uint8_t alpha,
                const RenderOptions& options) {
  return run_lazy(tree, camera, image, options, {Order::kBackToFront, alpha});
}

}  // namespace halfspace::fast
