#include "halfspace/fast/shade/scalars.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "base/parallel.hpp"
#include "halfspace/assert.hpp"
#include "halfspace/cap_parts.hpp"
#include "halfspace/threads.hpp"
#include "shade/corner_blend.hpp"
#include "shade/exact_double.hpp"
#include "shade/scalar_classes.hpp"
#include "shade/scalar_layers.hpp"

namespace halfspace::fast {
namespace {

/// m c / 255, rounded half up.
std::uint8_t dimmed(int full, int light) {
  return static_cast<std::uint8_t>((2 * full * light + 255) / 510);
}

int channel_in(const Rgb& color, std::size_t channel) {
  return channel == 0 ? color.r : channel == 1 ? color.g : color.b;
}

/// The colours of pixels, one after another. Each thread has its own.
class ScalarShader {
 public:
  ScalarShader(const Scene& scene, const CameraData& camera, const View& view,
               const ImageOptions& options, const ScalarColors& scalars)
      : scene_(scene),
        options_(options),
        scalars_(scalars),
        samples_(view.samples),
        classes_(scalars.scale),
        is_smooth_(options.shading == Shading::kGouraud &&
                   !scene.data().corner_colors.empty()) {
    shaded_.reserve(kShaded);
    for (std::size_t k = 0; k < kShaded; ++k)
      shaded_.push_back({kBackground, false, CornerBlend(scene, camera, view)});
  }

  /// The colour of all of a polygon, if it has one.
  static std::optional<Rgb> flat_color(const Scene& scene,
                                       const ImageOptions& options,
                                       const ScalarColors& scalars,
                                       PolygonId polygon) {
    const std::int32_t own = scalars.classes[static_cast<std::size_t>(polygon)];
    if (own < 0) return std::nullopt;
    Rgb light = scene.color(polygon);
    const auto lights = options.shading == Shading::kGouraud
                            ? scene.corner_colors(polygon)
                            : std::span<const Rgb>();
    if (!lights.empty()) {
      light = lights[0];
      if (std::any_of(lights.begin(), lights.end(),
                      [&](const Rgb& other) { return other != light; }))
        return std::nullopt;
    }
    return plain_color(scalars.colors[static_cast<std::size_t>(own)], light);
  }

  /// The colour of sample (i, j).
  Rgb color(PolygonId seen, std::int32_t i, std::int32_t j) {
    if (seen == last_) return last_color_;
    if (seen == kBackground) return options_.background;
    const auto p = static_cast<std::size_t>(seen);
    if (p >= scene_.polygon_count()) {
      return cap_color_at_sample(options_, cap_item(p - scene_.polygon_count()),
                                 i, j, samples_);
    }
    if (const auto flat = flat_color(scene_, options_, scalars_, seen)) {
      last_ = seen;
      last_color_ = *flat;
      return last_color_;
    }
    const std::int32_t known = scalars_.classes[p];
    const auto lights = scene_.corner_colors(seen);
    const bool varies = is_smooth_ && !std::equal(lights.begin() + 1,
                                                  lights.end(), lights.begin());
    const CornerBlend& blend = blend_of(seen);
    const CornerBlend::Shares shares = blend.at(i, j);
    const std::int32_t own =
        known >= 0 ? known : class_at(blend, shares, seen, i, j);
    const Rgb full = scalars_.colors[static_cast<std::size_t>(own)];
    if (!varies) {
      return plain_color(full, is_smooth_ ? lights[0] : scene_.color(seen));
    }
    return lit_color(blend, shares, full, lights, i, j);
  }

  const FilterStats& stats() const { return stats_; }

 private:
  /// Polygons by their ids, of which the last bits are their places.
  static constexpr std::size_t kShaded = 512;
  struct Shaded {
    PolygonId polygon = kBackground;
    bool is_there = false;
    CornerBlend blend;
  };

  static Rgb plain_color(const Rgb& full, const Rgb& light) {
    return {dimmed(full.r, light.r), dimmed(full.g, light.g),
            dimmed(full.b, light.b)};
  }

  const CornerBlend& blend_of(PolygonId polygon) {
    Shaded& shaded = shaded_[static_cast<std::size_t>(polygon) % kShaded];
    if (!shaded.is_there || shaded.polygon != polygon) {
      shaded.polygon = polygon;
      shaded.is_there = true;
      shaded.blend.start(polygon);
    }
    return shaded.blend;
  }

  std::int32_t class_at(const CornerBlend& blend,
                        const CornerBlend::Shares& shares, PolygonId polygon,
                        std::int32_t i, std::int32_t j) {
    const auto v = scalars_.field.of(scene_, polygon);
    const double value = shares.share[0] * v[0] + shares.share[1] * v[1] +
                         shares.share[2] * v[2];
    const double most =
        std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
    // Products of the least numbers are off by less than the second summand.
    const double doubt = most * shares.doubt + 0x1p-1070;
    if (std::isfinite(value) && std::isfinite(doubt)) {
      // That of the sample before is looked at first.
      const std::int32_t own = classes_.is_in(last_class_, value, doubt)
                                   ? last_class_
                                   : classes_.of(value, doubt);
      if (own >= 0) {
        ++stats_.filtered;
        last_class_ = own;
        return own;
      }
    }
    ++stats_.exact;
    return classes_.of(blend.exact_sum(
        i, j, {exact_double(v[0]), exact_double(v[1]), exact_double(v[2])}));
  }

  /// A channel of the light is off by 255 doubts, so of the colour, too.
  Rgb lit_color(const CornerBlend& blend, const CornerBlend::Shares& shares,
                const Rgb& full, std::span<const Rgb> lights, std::int32_t i,
                std::int32_t j) {
    std::array<std::uint8_t, 3> result{};
    const double doubt = 256 * shares.doubt;
    for (std::size_t c = 0; c < 3; ++c) {
      const double light = shares.share[0] * channel_in(lights[0], c) +
                           shares.share[1] * channel_in(lights[1], c) +
                           shares.share[2] * channel_in(lights[2], c);
      const int most = channel_in(full, c);
      const double value = most * light / 255 + 0.5;
      const bool is_told = doubt < 0.25 && value > -1 && value < 257;
      const double level = is_told ? std::floor(value) : 0;
      if (is_told && value - level > doubt && value - level < 1 - doubt) {
        ++stats_.filtered;
        result[c] = static_cast<std::uint8_t>(level);
        continue;
      }
      ++stats_.exact;
      const BigRational exact =
          blend.exact_sum(i, j,
                          {BigRational(channel_in(lights[0], c)),
                           BigRational(channel_in(lights[1], c)),
                           BigRational(channel_in(lights[2], c))});
      result[c] = rounded_channel(exact * most / 255);
    }
    return {result[0], result[1], result[2]};
  }

  const Scene& scene_;
  const ImageOptions& options_;
  const ScalarColors& scalars_;
  std::int32_t samples_;
  ScalarClasses classes_;
  bool is_smooth_;
  FilterStats stats_;
  std::vector<Shaded> shaded_;
  PolygonId last_ = -2;  ///< of one colour, which is:
  Rgb last_color_;
  std::int32_t last_class_ = 0;
};

/// The colours of a row of pixels, of which the first sample is (x, y) and its
/// item `items`, a line of samples every `stride`.
template <std::int32_t kSamples>
void color_row(ScalarShader& shader, const PolygonId* items,
               std::int64_t stride, std::int32_t x, std::int32_t y,
               std::span<Rgb> colors) {
  constexpr std::int32_t kCount = kSamples * kSamples;
  for (Rgb& color : colors) {
    std::array<std::int32_t, 3> sum = {kCount / 2, kCount / 2, kCount / 2};
    for (std::int32_t b = 0; b < kSamples; ++b) {
      for (std::int32_t a = 0; a < kSamples; ++a) {
        const Rgb own = shader.color(items[b * stride + a], x + a, y + b);
        sum[0] += own.r;
        sum[1] += own.g;
        sum[2] += own.b;
      }
    }
    const auto mean = [&sum](std::size_t c) {
      return static_cast<std::uint8_t>(sum[c] / kCount);
    };
    color = {mean(0), mean(1), mean(2)};
    items += kSamples;
    x += kSamples;
  }
}

void color_row(std::int32_t samples, ScalarShader& shader,
               const PolygonId* items, std::int64_t stride, std::int32_t x,
               std::int32_t y, std::span<Rgb> colors) {
  switch (samples) {
    case 2:
      return color_row<2>(shader, items, stride, x, y, colors);
    case 4:
      return color_row<4>(shader, items, stride, x, y, colors);
    case 8:
      return color_row<8>(shader, items, stride, x, y, colors);
    default:
      return color_row<1>(shader, items, stride, x, y, colors);
  }
}

/// The colours of layers by scalars.
class ScalarLayers final : public LayerColors {
 public:
  ScalarLayers(const Scene& scene, const Camera& camera,
               const ImageOptions& options, const ScalarColors& scalars,
               std::int32_t samples)
      : scene_(scene),
        camera_(camera.data()),
        view_(make_view(camera, scene.grid_bits(), samples)),
        options_(options),
        scalars_(scalars) {}

  std::uint32_t color_of(PolygonId polygon) const override {
    const auto flat =
        ScalarShader::flat_color(scene_, options_, scalars_, polygon);
    return flat ? packed_color(flat->r, flat->g, flat->b)
                : PixelSource::kSmooth;
  }
  std::unique_ptr<Shader> shader() const override {
    return std::make_unique<OwnShader>(*this);
  }

 private:
  class OwnShader final : public Shader {
   public:
    explicit OwnShader(const ScalarLayers& all)
        : shader_(all.scene_, all.camera_, all.view_, all.options_,
                  all.scalars_) {}
    void shade(PolygonId polygon, std::int32_t x, std::int32_t y,
               std::uint32_t bits, LineColors& colors) override {
      for (; bits != 0; bits &= bits - 1) {
        const int i = std::countr_zero(bits);
        const Rgb color = shader_.color(polygon, x + i, y);
        std::uint8_t* const to = colors.data() + 3 * i;
        to[0] = color.r, to[1] = color.g, to[2] = color.b;
      }
    }
    const FilterStats& stats() const override { return shader_.stats(); }

   private:
    ScalarShader shader_;
  };

  const Scene& scene_;
  const CameraData& camera_;
  View view_;
  const ImageOptions& options_;
  const ScalarColors& scalars_;
};

/// Of all the classes that a polygon's corners have the one, or -1.
std::int32_t class_of_all(const ScalarClasses& classes,
                          std::span<const double> values) {
  for (const double value : values) {
    if (std::isnan(value)) return classes.no_data();
  }
  const std::int32_t first = classes.of(values[0]);
  for (const double value : values) {
    if (classes.of(value) != first) return -1;
  }
  return first;
}

/// Lines that a thread colours at once.
constexpr std::size_t kLines = 32;

}  // namespace

ScalarColors prepare_scalars(const Scene& scene, ScalarField field,
                             ColorScale scale) {
  HALFSPACE_ASSERT(is_valid(scale));
  ScalarColors result{std::move(field), std::move(scale), {}, {}};
  const ScalarClasses classes(result.scale);
  result.classes.resize(scene.polygon_count());
  for (std::size_t p = 0; p < result.classes.size(); ++p) {
    result.classes[p] = class_of_all(
        classes, result.field.of(scene, static_cast<PolygonId>(p)));
  }
  const auto outside = [&](const Rgb& usual) {
    return result.scale.limits ? result.scale.limits->color : usual;
  };
  result.colors.push_back(outside(result.scale.colors.front()));
  result.colors.insert(result.colors.end(), result.scale.colors.begin(),
                       result.scale.colors.end());
  result.colors.push_back(outside(result.scale.colors.back()));
  result.colors.push_back(result.scale.no_data);
  return result;
}

FilterStats color_scalars(const Scene& scene, const Camera& camera,
                          const ImageOptions& options, const ItemImage& items,
                          const ScalarColors& scalars, const ScalarOptions& how,
                          ColorImage& colors) {
  const std::int32_t n = how.samples;
  HALFSPACE_ASSERT(n == 1 || n == 2 || n == 4 || n == 8);
  const std::int32_t width = items.width_px / n;
  const std::int32_t height = items.height_px / n;
  if (colors.width_px != width || colors.height_px != height)
    colors = ColorImage(width, height, Rgb{});
  const View view = make_view(camera, scene.grid_bits(), n);
  FilterStats stats;
  Mutex mutex;
  for_blocks(how.threads, static_cast<std::size_t>(height), kLines,
             [&](std::size_t, std::size_t first, std::size_t end) {
               ScalarShader shader(scene, camera.data(), view, options,
                                   scalars);
               for (auto j = static_cast<std::int32_t>(first);
                    j < static_cast<std::int32_t>(end); ++j) {
                 color_row(n, shader, &items.at(0, j * n), items.width_px,
                           how.left * n, (how.top + j) * n,
                           {&colors.at(0, j), static_cast<std::size_t>(width)});
               }
               const Lock lock(mutex);
               stats.add(shader.stats());
             });
  return stats;
}

ColorImage color_scalars(const Scene& scene, const Camera& camera,
                         const ImageOptions& options, const ItemImage& items,
                         const ScalarColors& scalars,
                         const ScalarOptions& how) {
  ColorImage colors;
  color_scalars(scene, camera, options, items, scalars, how, colors);
  return colors;
}

std::unique_ptr<const LayerColors> scalar_layers(const Scene& scene,
                                                 const Camera& camera,
                                                 const ImageOptions& options,
                                                 const ScalarColors& scalars,
                                                 std::int32_t samples) {
  return std::make_unique<ScalarLayers>(scene, camera, options, scalars,
                                        samples);
}

}  // namespace halfspace::fast
