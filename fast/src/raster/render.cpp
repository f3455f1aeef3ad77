#include "halfspace/fast/render.hpp"

#include <algorithm>
#include <atomic>
#include <vector>

#include "base/parallel.hpp"
#include "base/threads.hpp"
#include "base/tsan.hpp"
#include "halfspace/assert.hpp"
#include "halfspace/fast/painter.hpp"
#include "raster/caps.hpp"
#include "raster/culler.hpp"
#include "raster/polygon_rasterizer.hpp"
#include "raster/render_pass.hpp"
#include "raster/tile_buffer.hpp"
#include "tree/traversal.hpp"

namespace halfspace::fast {
namespace {

/// What one thread found.
struct BandResult {
  std::size_t pixels = 0;
  std::size_t fragments = 0;
  FilterStats stats;
};

/// The eye's side of a fragment's source, from that of its node.
int source_side(const TreeFragment& fragment, int node_sign) {
  return fragment.flipped != 0 ? -node_sign : node_sign;
}

/// The clip planes that may cut what is in a node.
ClipMask clip_mask(const Frame& frame, const Node& node) {
  if (frame.clips.empty()) return 0;
  const BspTree& tree = frame.reader.tree();
  if (tree.boxes.size() != tree.nodes.size()) return frame.clips.all();
  const auto n = static_cast<std::size_t>(&node - tree.nodes.data());
  const ClipState state = frame.clips.classify(tree.boxes[n]);
  return state.is_gone ? frame.clips.all() : state.mask;
}

template <int kBits>
BandResult render_band(const Frame& frame, TileBuffer& buffer) {
  const BspTree& tree = frame.reader.tree();
  TileView& screen = buffer.view();
  PolygonRasterizer<kBits> rasterizer(frame, screen);
  FilterStats stats;
  const EyeClassifier eye_side(frame.reader, frame.view, frame.camera, stats);
  const Culler culler(frame.view, frame.kernel, screen);
  const bool has_boxes = tree.boxes.size() == tree.nodes.size();
  const bool has_clips = !frame.clips.empty();
  const auto enter = [&](NodeId id) {
    if (!has_boxes) return true;
    const auto n = static_cast<std::size_t>(id);
    const Node& node = tree.nodes[n];
    if (has_clips && frame.clips.classify(tree.boxes[n]).is_gone) return false;
    // Drawing one fragment is faster than testing its box.
    const bool is_single = node.splitter != kNoPlane &&
                           node.positive == kNoNode && node.negative == kNoNode;
    return is_single || culler.can_show(tree.boxes[n]);
  };
  const auto side_of_source = [&](const TreeFragment& fragment) {
    return eye_side(frame.reader.planes().plane(fragment.source),
                    fragment.source);
  };
  // A leaf is drawn when the next one is found: its vertices are fetched from
  // memory meanwhile.
  const Node* waiting = nullptr;
  ClipMask waiting_clips = 0;
  const auto draw_waiting = [&] {
    if (waiting == nullptr) return;
    // One fragment hides nothing of its own.
    const auto first = static_cast<std::size_t>(waiting->first_fragment);
    if (tree.fragments[first].next != kNoFragment) buffer.enter_leaf();
    rasterizer.set_clips(waiting_clips);
    rasterizer.draw_leaf(*waiting, side_of_source);
    waiting = nullptr;
  };
  const auto show = [&](const Node& node, int sign) {
    if (node.splitter == kNoPlane) {
      rasterizer.prefetch(node);
      draw_waiting();
      waiting = &node;
      waiting_clips = clip_mask(frame, node);
    } else if (node.first_fragment != kNoFragment) {
      draw_waiting();
      rasterizer.set_clips(clip_mask(frame, node));
      for_fragments(tree, node, [&](const TreeFragment& fragment) {
        rasterizer.draw(fragment, source_side(fragment, sign));
        return true;
      });
    }
    return screen.open_tiles > 0;
  };
  walk_front_to_back(tree, eye_side, enter, show);
  draw_waiting();
  const std::int64_t unlit = rasterizer.fill_rest(frame.image.background);
  const std::int64_t all =
      std::int64_t{screen.columns.end - screen.columns.first} *
      (screen.lines.end - screen.lines.first);
  stats.add(rasterizer.stats());
  return {static_cast<std::size_t>(all - unlit), rasterizer.fragments(), stats};
}

template <int kBits>
BandResult paint_band(const Frame& frame, TileBuffer& buffer) {
  const BspTree& tree = frame.reader.tree();
  TileView& screen = buffer.view();
  PolygonRasterizer<kBits> rasterizer(frame, screen);
  rasterizer.fill_rest(frame.image.background);
  screen.overwrite = true;
  FilterStats stats;
  std::vector<std::int32_t> scratch;
  const EyeClassifier eye_side(frame.reader, frame.view, frame.camera, stats);
  walk_back_to_front(tree, eye_side, [&](const Node& node, int sign) {
    rasterizer.set_clips(clip_mask(frame, node));
    return for_fragments_reversed(
        tree, node, scratch, [&](const TreeFragment& fragment) {
          rasterizer.draw(fragment, source_side(fragment, sign));
          return true;
        });
  });
  stats.add(rasterizer.stats());
  return {rasterizer.pixels(), rasterizer.fragments(), stats};
}

/// Bands of whole tile rows, one or a few for each thread.
std::vector<PixelRange> bands_of(const Rectangle& rectangle, int threads) {
  const std::int32_t first = rectangle.top / kTileHeight;
  const std::int32_t last = (rectangle.bottom - 1) / kTileHeight;
  const std::int32_t rows = last - first + 1;
  // More bands than threads even out what the bands cost; but each walks the
  // tree, and draws again what crosses its border.
  const std::int32_t wanted = threads == 1 ? 1 : 2 * threads;
  const std::int32_t count = std::min(wanted, rows);
  std::vector<PixelRange> bands;
  for (std::int32_t b = 0; b < count; ++b) {
    const auto row = [&](std::int32_t k) {
      return static_cast<std::int32_t>(first + std::int64_t{rows} * k / count);
    };
    bands.push_back({std::max(rectangle.top, row(b) * kTileHeight),
                     std::min(rectangle.bottom, row(b + 1) * kTileHeight)});
  }
  return bands;
}

/// Calls work(b) for every band, in that many threads, the middle ones first:
/// in most pictures they take longest, and what is left for the end is little.
template <class Work>
void for_bands(std::size_t count, int threads, const Work& work) {
  std::atomic<std::size_t> next{0};
  const TsanForkJoin shared;
  const auto work_on = [&](int) {
    shared.task([&] {
      for (std::size_t k = next++; k < count; k = next++) {
        work(k % 2 == 0 ? (count + k) / 2 : (count - 1 - k) / 2);
      }
    });
  };
  threads::in_arena(threads, [&] { threads::for_each_task(threads, work_on); });
}

template <class T>
void resize(Grid2<T>& image, std::int32_t width, std::int32_t height) {
  if (image.width_px == width && image.height_px == height) return;
  image = Grid2<T>(width, height, T{});
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
  resize(result.items, items ? width : 0, items ? height : 0);
  resize(result.colors, options.colors ? width : 0,
         options.colors ? height : 0);

  const bool leaves = has_leaves(tree);
  HALFSPACE_ASSERT(pass.order == Order::kFrontToBack || !leaves);
  const TreeReader reader(scene, tree);
  HALFSPACE_ASSERT(pass.samples == 1 || image.clips.empty());
  const View view = make_view(camera, scene.grid_bits(), pass.samples);
  const ClipSet clips(image.clips, image.caps.has_value(), scene.grid_bits());
  const Frame frame = {
      reader, data, image, view, best_kernel(options.simd), clips, pass.alpha};
  const std::vector<PixelRange> bands = bands_of(rectangle, threads);
  std::vector<BandResult> found(bands.size());
  const auto one = [&](std::size_t b) {
    TileBuffer buffer(rectangle, bands[b], result, leaves);
    found[b] = with_grid(scene.grid_bits(), [&](auto bits) {
      return pass.order == Order::kFrontToBack
                 ? render_band<bits()>(frame, buffer)
                 : paint_band<bits()>(frame, buffer);
    });
  };
  if (threads == 1) {
    one(0);
  } else {
    for_bands(bands.size(), threads, one);
  }
  if (has_caps) {
    add_caps(frame, rectangle, result);
    if (!options.items) result.items = {};
  }
  result.pixels_painted = 0;
  result.fragments_displayed = 0;
  result.decisions = {};
  for (const BandResult& band : found) {
    result.pixels_painted += band.pixels;
    result.fragments_displayed += band.fragments;
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

}  // namespace halfspace::fast
