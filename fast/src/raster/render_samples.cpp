#include <algorithm>
#include <array>

#include "base/parallel.hpp"
#include "base/threads.hpp"
#include "base/tsan.hpp"
#include "halfspace/assert.hpp"
#include "halfspace/fast/render.hpp"
#include "halfspace/threads.hpp"
#include "raster/caps.hpp"
#include "raster/frame.hpp"
#include "raster/render_pass.hpp"
#include "raster/sample_means.hpp"
#include "tree/node_boxes.hpp"

namespace halfspace::fast {
namespace {

/// So many samples are decided together: their ids fill half of a second-level
/// cache of 2 MiB.
constexpr std::int32_t kStripSamples = 1 << 18;

/// Where colours are added up, so many pixels are decided together: their sums
/// are 6 bytes each.
constexpr std::int32_t kStripPixels = 1 << 18;

/// Whether flat colours of samples are added up as they are drawn, and whether
/// samples are blended or changed: not in a module for the web, for its size.
#if defined(__wasm__)
constexpr bool kAddsUp = false;
constexpr bool kHasBytes = false;
#else
constexpr bool kAddsUp = true;
constexpr bool kHasBytes = true;
#endif

class SampledImage {
 public:
  SampledImage(const Scene& scene, const BspTree& tree, const Camera& camera,
               const ImageOptions& image, const RenderOptions& options,
               const Pass& pass, const Rectangle& rectangle, Rendering& result)
      : scene_(scene),
        tree_(tree),
        camera_(camera),
        image_(image),
        options_(options),
        rectangle_(rectangle),
        result_(result),
        reader_(scene, tree),
        view_(make_view(camera, extent_of(tree, scene.grid_bits()),
                        pass.samples)),
        samples_(pass.samples),
        pass_(pass),
        has_bytes_(kHasBytes &&
                   (pass.alpha != kOpaque || pass.retouch != nullptr)) {
    const bool has_caps = image.caps && !image.clips.empty();
    if (has_caps) find_caps();
    adds_up_ = kAddsUp && samples_ > 1 && !has_caps && options.colors &&
               !options.items && !has_bytes_ && is_flat();
  }

  bool adds_up() const { return adds_up_; }

  /// Fills lines from `top` up to `bottom` of the rectangle.
  void fill(std::int32_t top, std::int32_t bottom, Rendering& strip) {
    RenderOptions own = options_;
    own.threads = 1;
    own.items = options_.items || pass_.retouch != nullptr ||
                (!adds_up_ && !has_bytes_);
    own.colors = has_bytes_ && options_.colors;
    own.rectangle = Rectangle{rectangle_.left * samples_, top * samples_,
                              rectangle_.right * samples_, bottom * samples_};
    Pass pass = pass_;
    pass.caps = image_.caps ? &caps_ : nullptr;
    const std::int32_t line = top - rectangle_.top;
    if (adds_up_) pass.means = &result_.colors.at(0, line);
    run(scene_, tree_, camera_, image_, own, pass, strip);
    if (kHasBytes && own.colors) {
      if (pass_.retouch != nullptr) (*pass_.retouch)(strip);
      write_means(strip.colors, line);
    }
    const std::int64_t stride = own.rectangle->right - own.rectangle->left;
    if (options_.items) {
      std::copy(strip.items.pixels.begin(), strip.items.pixels.end(),
                result_.items.pixels.begin() + line * samples_ * stride);
    }
    FilterStats stats = strip.decisions;
    if (options_.colors && !adds_up_ && !has_bytes_) {
      SampleMeans means(reader_, view_, camera_.data(), image_,
                        best_kernel(options_.simd));
      for (std::int32_t j = top; j < bottom; ++j) {
        const PolygonId* items =
            strip.items.pixels.data() + (j - top) * samples_ * stride;
        means.row(items, stride, rectangle_.left, rectangle_.right, j,
                  &result_.colors.at(0, j - rectangle_.top));
      }
      stats.add(means.stats());
    }
    const Lock lock(mutex_);
    result_.pixels_painted += strip.pixels_painted;
    result_.fragments_displayed += strip.fragments_displayed;
    result_.tiles_touched += strip.tiles_touched;
    result_.decisions.add(stats);
  }

 private:
  /// The means of samples' bytes, from that line of the result on.
  void write_means(const ColorImage& colors, std::int32_t line) {
    const std::int32_t count = samples_ * samples_;
    for (std::int32_t j = 0; j < colors.height_px / samples_; ++j) {
      for (std::int32_t i = 0; i < colors.width_px / samples_; ++i) {
        std::array<std::int32_t, 3> sum = {count / 2, count / 2, count / 2};
        for (std::int32_t b = 0; b < samples_; ++b) {
          const Rgb* own = &colors.at(i * samples_, j * samples_ + b);
          for (std::int32_t a = 0; a < samples_; ++a, ++own) {
            sum[0] += own->r;
            sum[1] += own->g;
            sum[2] += own->b;
          }
        }
        const auto mean = [&](std::size_t c) {
          return static_cast<std::uint8_t>(sum[c] / count);
        };
        result_.colors.at(i, line + j) = {mean(0), mean(1), mean(2)};
      }
    }
  }
  /// Whether the colour of each polygon is one, a whole number.
  bool is_flat() const {
    if (image_.shading == Shading::kFlat) return true;
    if (scene_.data().corner_colors.empty()) return true;
    const auto count = static_cast<PolygonId>(scene_.polygon_count());
    PolygonId polygon = 0;
    while (polygon < count && !has_gradient(scene_, polygon)) ++polygon;
    return polygon == count;
  }
  /// Once for all strips: what crosses a clip plane crosses many of them.
  void find_caps() {
    const ClipSet clips(image_.clips, true, scene_.grid_bits());
    const Frame frame = {
        reader_, camera_.data(), image_, view_, best_kernel(options_.simd),
        clips};
    caps_ = cap_changes(
        frame, {rectangle_.left * samples_, rectangle_.top * samples_,
                rectangle_.right * samples_, rectangle_.bottom * samples_});
  }

  const Scene& scene_;
  const BspTree& tree_;
  const Camera& camera_;
  const ImageOptions& image_;
  const RenderOptions& options_;
  const Rectangle rectangle_;
  Rendering& result_;
  TreeReader reader_;
  View view_;
  std::int32_t samples_;
  const Pass& pass_;
  bool has_bytes_;  ///< samples have whole numbers as colours
  CapChanges caps_;
  bool adds_up_ = false;
  Mutex mutex_;
};

}  // namespace

Rendering run_samples(const Scene& scene, const BspTree& tree,
                      const Camera& camera, const ImageOptions& image,
                      const RenderOptions& options, const Pass& pass) {
  HALFSPACE_ASSERT(options.threads >= 0);
  HALFSPACE_ASSERT(kHasBytes ||
                   (pass.alpha == kOpaque && pass.retouch == nullptr));
  const std::int32_t samples = pass.samples;
  const int threads = thread_count(options.threads);
  HALFSPACE_ASSERT(samples == 1 || samples == 2 || samples == 4 ||
                   samples == 8);
  HALFSPACE_ASSERT(camera->width_px * samples <= kMaxImageSize &&
                   camera->height_px * samples <= kMaxImageSize);
  const Rectangle rectangle = options.rectangle.value_or(
      Rectangle{0, 0, camera->width_px, camera->height_px});
  const std::int32_t width = rectangle.right - rectangle.left;
  const std::int32_t height = rectangle.bottom - rectangle.top;
  Rendering result;
  if (options.items)
    result.items = ItemImage(width * samples, height * samples, kBackground);
  if (options.colors) result.colors = ColorImage(width, height, Rgb{});
  SampledImage sampled(scene, tree, camera, image, options, pass, rectangle,
                       result);
  std::int32_t pixels = kStripSamples / (samples * samples);
  if (sampled.adds_up()) {
    // Some for each thread.
    const std::int64_t share = std::int64_t{width} * height / (2 * threads);
    pixels = kStripPixels;
    if (threads > 1 && share < pixels)
      pixels = std::max(pixels / 16, static_cast<std::int32_t>(share));
  }
  // Whole rows of tiles: 8 samples high.
  const std::int32_t lines = std::max(8, pixels / width / 8 * 8);
  const std::int32_t strips = (height + lines - 1) / lines;
  const auto fill = [&](std::int32_t s, Rendering& strip) {
    const std::int32_t top = rectangle.top + s * lines;
    sampled.fill(top, std::min(top + lines, rectangle.bottom), strip);
  };
  if (threads == 1) {
    Rendering strip;
    for (std::int32_t s = 0; s < strips; ++s) fill(s, strip);
    return result;
  }
  const TsanForkJoin shared;
  threads::in_arena(threads, [&] {
    threads::for_each_task(strips, [&](std::int32_t s) {
      shared.task([&] {
        Rendering strip;
        fill(s, strip);
      });
    });
  });
  return result;
}

Rendering render_samples(const Scene& scene, const BspTree& tree,
                         const Camera& camera, const ImageOptions& image,
                         std::int32_t samples, const RenderOptions& options) {
  Pass pass;
  pass.samples = samples;
  return run_samples(scene, tree, camera, image, options, pass);
}

}  // namespace halfspace::fast
