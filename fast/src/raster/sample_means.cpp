#include "raster/sample_means.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "halfspace/cap_stripes.hpp"

namespace halfspace::fast {
namespace {

/// Whether all items of a pixel are one.
template <std::int32_t kSamples>
bool are_equal(const PolygonId* items, std::int64_t stride) {
  PolygonId differ = 0;
  for (std::int32_t b = 0; b < kSamples; ++b) {
    for (std::int32_t a = 0; a < kSamples; ++a)
      differ |= items[b * stride + a] ^ items[0];
  }
  return differ == 0;
}

bool are_equal(const PolygonId* items, std::int64_t stride,
               std::int32_t samples) {
  switch (samples) {
    case 2:
      return are_equal<2>(items, stride);
    case 4:
      return are_equal<4>(items, stride);
    case 8:
      return are_equal<8>(items, stride);
    default:
      return true;
  }
}

int channel_of(const Rgb& color, std::size_t channel) {
  return channel == 0 ? color.r : channel == 1 ? color.g : color.b;
}

}  // namespace

SampleMeans::SampleMeans(const TreeReader& reader, const View& view,
                         const CameraData& camera, const ImageOptions& image)
    : reader_(reader),
      image_(image),
      samples_(view.samples),
      gouraud_(image.shading == Shading::kGouraud &&
               !reader.scene().data().corner_colors.empty()),
      eye_side_(reader, view, camera, stats_),
      first_cap_(static_cast<PolygonId>(reader.scene().polygon_count())),
      last_color_(image.background) {
  if (gouraud_) {
    shaders_.reserve(kShaders);
    for (std::size_t k = 0; k < kShaders; ++k) {
      shaders_.push_back(
          {kBackground, GouraudShader(reader.scene(), camera, view)});
    }
  }
}

bool SampleMeans::is_smooth(PolygonId polygon) const {
  return gouraud_ && polygon != kBackground && !is_cap(polygon) &&
         has_gradient(reader_.scene(), polygon);
}

Rgb SampleMeans::flat_color(PolygonId polygon, std::int32_t i,
                            std::int32_t j) const {
  if (polygon == kBackground) return image_.background;
  if (is_cap(polygon)) {
    return cap_color_at_sample(*image_.caps,
                               static_cast<std::size_t>(polygon - first_cap_),
                               i, j, samples_);
  }
  const Scene& scene = reader_.scene();
  return gouraud_ ? scene.corner_colors(polygon)[0] : scene.color(polygon);
}

GouraudShader& SampleMeans::shader_of(PolygonId polygon) {
  Shaded& shaded = shaders_[static_cast<std::size_t>(polygon) % kShaders];
  if (shaded.polygon != polygon) {
    shaded.polygon = polygon;
    shaded.shader.start(polygon,
                        eye_side_(reader_.planes().plane(polygon), polygon));
  }
  return shaded.shader;
}

Rgb SampleMeans::mean(const PolygonId* items, std::int64_t stride,
                      std::int32_t i, std::int32_t j) {
  if (are_equal(items, stride, samples_)) {
    if (items[0] == last_) return last_color_;
    const bool is_hatched = is_cap(items[0]) && image_.caps->hatch;
    if (!is_hatched && !is_smooth(items[0])) {
      last_ = items[0];
      last_color_ = flat_color(last_, i, j);
      return last_color_;
    }
  }
  if (!gouraud_) return flat_mean(items, stride, i, j);
  return smooth_mean(items, stride, i, j);
}

Rgb SampleMeans::flat_mean(const PolygonId* items, std::int64_t stride,
                           std::int32_t i, std::int32_t j) const {
  std::array<std::uint32_t, 3> sum = {};
  PolygonId polygon = items[0];
  Rgb color = flat_color(polygon, i, j);
  for (std::int32_t b = 0; b < samples_; ++b) {
    for (std::int32_t a = 0; a < samples_; ++a) {
      const PolygonId item = items[b * stride + a];
      if (item != polygon || is_cap(item)) {
        polygon = item;
        color = flat_color(polygon, i + a, j + b);
      }
      sum[0] += color.r;
      sum[1] += color.g;
      sum[2] += color.b;
    }
  }
  const auto count = static_cast<std::uint32_t>(samples_ * samples_);
  const auto channel = [&](std::size_t c) {
    return static_cast<std::uint8_t>((2 * sum[c] + count) / (2 * count));
  };
  return {channel(0), channel(1), channel(2)};
}

/// A channel of a sample is off by at most doubt / total (Gradient). Of up to
/// 64 values of at most 256 a sum of doubles is off by 64 2^14 u = 2^-33, and
/// 2^-30 with what rounding adds to the bound.
Rgb SampleMeans::smooth_mean(const PolygonId* items, std::int64_t stride,
                             std::int32_t i, std::int32_t j) {
  std::array<double, 3> sum = {};
  double doubt = 0x1p-30;
  for (std::int32_t b = 0; b < samples_; ++b) {
    for (std::int32_t a = 0; a < samples_; ++a) {
      const PolygonId item = items[b * stride + a];
      if (!is_smooth(item)) {
        const Rgb color = flat_color(item, i + a, j + b);
        sum[0] += color.r;
        sum[1] += color.g;
        sum[2] += color.b;
        continue;
      }
      const Gradient& g = shader_of(item).gradient();
      const double u = i + a;
      const double v = j + b;
      const double reciprocal = 1 / (g.a[3] * u + (g.b[3] * v + g.c[3]));
      for (std::size_t c = 0; c < 3; ++c)
        sum[c] += (g.a[c] * u + (g.b[c] * v + g.c[c])) * reciprocal;
      const double own = g.doubt * reciprocal;
      // A total too small to trust makes the doubt large, negative or no
      // number.
      doubt += own >= 0 && own < 1 ? own : 0x1p30;
    }
  }
  const double count = samples_ * samples_;
  std::array<std::uint8_t, 3> mean = {};
  for (std::size_t c = 0; c < 3; ++c) {
    const double value = sum[c] + count / 2;
    const bool usable = doubt < count / 4;
    const double level = usable ? std::floor(value / count) : 0;
    const double above = value - level * count;
    if (usable && above > doubt && above < count - doubt) {
      ++stats_.filtered;
      mean[c] = static_cast<std::uint8_t>(level);
    } else {
      ++stats_.exact;
      mean[c] = exact_mean(c, items, stride, i, j);
    }
  }
  return {mean[0], mean[1], mean[2]};
}

double SampleMeans::close_sum(std::size_t channel, const PolygonId* items,
                              std::int64_t stride, std::int32_t i,
                              std::int32_t j) {
  double sum = 0;
  for (std::int32_t b = 0; b < samples_; ++b) {
    for (std::int32_t a = 0; a < samples_; ++a) {
      const PolygonId item = items[b * stride + a];
      sum += is_smooth(item)
                 ? shader_of(item).close_value(channel, i + a, j + b)
                 : channel_of(flat_color(item, i + a, j + b), channel);
    }
  }
  return sum;
}

/// Sums of close values are off by 64 2^-42 and what adding up rounds, 2^-33.
std::uint8_t SampleMeans::exact_mean(std::size_t channel,
                                     const PolygonId* items,
                                     std::int64_t stride, std::int32_t i,
                                     std::int32_t j) {
  constexpr double kDoubt = 0x1p-32;
  const double count = samples_ * samples_;
  const double value = close_sum(channel, items, stride, i, j) + count / 2;
  const double level = std::floor(value / count);
  const double above = value - level * count;
  if (above > kDoubt && above < count - kDoubt)
    return static_cast<std::uint8_t>(level);
  ++stats_.zero;
  BigRational sum = 0;
  for (std::int32_t b = 0; b < samples_; ++b) {
    for (std::int32_t a = 0; a < samples_; ++a) {
      const PolygonId item = items[b * stride + a];
      if (is_smooth(item)) {
        sum += shader_of(item).exact_value(channel, i + a, j + b);
        continue;
      }
      sum += channel_of(flat_color(item, i + a, j + b), channel);
    }
  }
  return rounded_channel(sum / (samples_ * samples_));
}

}  // namespace halfspace::fast
