#include "raster/sample_means.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>

#include "raster/pixel_gradient.hpp"

namespace halfspace::fast {
namespace {

/// Whether smooth means are looked for in closed form first: not in a module
/// for the web, of whose size that is some kilobytes.
#if defined(__wasm__)
constexpr bool kClosedForms = false;
#else
constexpr bool kClosedForms = true;
#endif

/// Whether all items of a pixel, or of some of its lines, are one.
template <std::int32_t kSamples, std::int32_t kLines = kSamples>
bool are_equal(const PolygonId* items, std::int64_t stride = 0) {
  std::array<PolygonId, std::size_t{kSamples}> differ = {};
  for (std::int32_t b = 0; b < kLines; ++b) {
    for (std::size_t a = 0; a < kSamples; ++a)
      differ[a] |= items[b * stride + static_cast<std::int32_t>(a)] ^ items[0];
  }
  PolygonId any = 0;
  for (const PolygonId d : differ) any |= d;
  return any == 0;
}

int channel_of(const Rgb& color, std::size_t channel) {
  return channel == 0 ? color.r : channel == 1 ? color.g : color.b;
}

}  // namespace

SampleMeans::SampleMeans(const TreeReader& reader, const View& view,
                         const CameraData& camera, const ImageOptions& image,
                         const TileKernel& kernel)
    : reader_(reader),
      image_(image),
      kernel_(kernel),
      samples_(view.samples),
      gouraud_(image.shading == Shading::kGouraud &&
               !reader.scene().data().corner_colors.empty()),
      eye_side_(reader, view, camera, stats_),
      shader_(reader.scene(), camera, view),
      first_cap_(static_cast<PolygonId>(reader.scene().polygon_count())),
      last_color_(image.background) {
  if (!gouraud_) return;
  shaded_.resize(kShaded);
  exact_polygons_.fill(kBackground);
  exact_shaders_.reserve(exact_polygons_.size());
  while (exact_shaders_.size() < exact_polygons_.size())
    exact_shaders_.push_back(shader_);
}

bool SampleMeans::is_smooth(PolygonId polygon) {
  return gouraud_ && polygon != kBackground && !is_cap(polygon) &&
         shaded(polygon).is_smooth;
}

Rgb SampleMeans::flat_color(PolygonId polygon, std::int32_t i,
                            std::int32_t j) const {
  if (polygon == kBackground) return image_.background;
  if (is_cap(polygon)) {
    return cap_color_at_sample(image_, cap_of(polygon), i, j, samples_);
  }
  const Scene& scene = reader_.scene();
  return gouraud_ ? scene.corner_colors(polygon)[0] : scene.color(polygon);
}

const SampleMeans::Shaded& SampleMeans::shaded(PolygonId polygon) {
  Shaded& place = shaded_[static_cast<std::size_t>(polygon) % kShaded];
  if (place.polygon != polygon) {
    place.polygon = polygon;
    place.is_smooth = has_gradient(reader_.scene(), polygon);
    if (place.is_smooth) place.gradient = shader_of(polygon).gradient();
  }
  return place;
}

GouraudShader& SampleMeans::shader_of(PolygonId polygon) {
  if (shader_polygon_ != polygon) {
    shader_polygon_ = polygon;
    shader_.start(polygon, eye_side_(reader_.planes().plane(polygon), polygon));
  }
  return shader_;
}

void SampleMeans::row(const PolygonId* items, std::int64_t stride,
                      std::int32_t left, std::int32_t right, std::int32_t j,
                      Rgb* colors) {
  switch (samples_) {
    case 2:
      return fill_row<2>(items, stride, left, right, j, colors);
    case 4:
      return fill_row<4>(items, stride, left, right, j, colors);
    case 8:
      return fill_row<8>(items, stride, left, right, j, colors);
    default:
      return fill_row<1>(items, stride, left, right, j, colors);
  }
}

template <std::int32_t kSamples>
void SampleMeans::fill_row(const PolygonId* items, std::int64_t stride,
                           std::int32_t left, std::int32_t right,
                           std::int32_t j, Rgb* colors) {
  for (std::int32_t i = left; i < right; ++i, ++colors, items += kSamples) {
    bool is_flat = !gouraud_;
    const bool is_one = are_equal<kSamples>(items, stride);
    if (is_one) {
      if (items[0] == last_) {
        *colors = last_color_;
        continue;
      }
      const bool is_hatched =
          is_cap(items[0]) && style_of(image_, cap_of(items[0])).hatch;
      if (!is_hatched && !is_smooth(items[0])) {
        last_ = items[0];
        last_color_ = flat_color(last_, i * kSamples, j * kSamples);
        *colors = last_color_;
        continue;
      }
      is_flat = is_flat || is_hatched;
    }
    const std::int32_t x = i * kSamples;
    const std::int32_t y = j * kSamples;
    if (is_flat) {
      *colors = flat_mean<kSamples>(items, stride, x, y);
      continue;
    }
    std::optional<Rgb> quick;
    if constexpr (kClosedForms && kSamples > 1) {
      if (is_one && kernel_.full_means != nullptr) {
        const std::int32_t done =
            fill_run<kSamples>(items, stride, right - i, x, y, colors);
        if (done > 0) {
          i += done - 1;
          colors += done - 1;
          items += (done - 1) * kSamples;
          continue;
        }
      }
      quick = is_one ? full_mean<kSamples>(shaded(items[0]).gradient, x, y)
                     : mixed_mean<kSamples>(items, stride, x, y);
    }
    *colors = quick ? *quick : smooth_mean<kSamples>(items, stride, x, y);
  }
}

/// Channels are added up together, 21 bits each: 64 samples fill 14 of them.
template <std::int32_t kSamples>
Rgb SampleMeans::flat_mean(const PolygonId* items, std::int64_t stride,
                           std::int32_t i, std::int32_t j) const {
  constexpr std::int32_t kCount = kSamples * kSamples;
  constexpr std::uint64_t kOne =
      1 | std::uint64_t{1} << 21 | std::uint64_t{1} << 42;
  const Rgb* own = reader_.scene().data().colors.data();
  const auto polygons = static_cast<std::uint32_t>(first_cap_);
  std::uint64_t sum = kCount / 2 * kOne;
  for (std::int32_t b = 0; b < kSamples; ++b) {
    for (std::int32_t a = 0; a < kSamples; ++a) {
      const PolygonId item = items[b * stride + a];
      const Rgb color = static_cast<std::uint32_t>(item) < polygons ? own[item]
                        : item == kBackground
                            ? image_.background
                            : cap_color_at_sample(image_, cap_of(item), i + a,
                                                  j + b, kSamples);
      sum +=
          color.r | std::uint64_t{color.g} << 21 | std::uint64_t{color.b} << 42;
    }
  }
  const auto channel = [sum](int shift) {
    return static_cast<std::uint8_t>((sum >> shift & 0x1fffff) / kCount);
  };
  return {channel(0), channel(21), channel(42)};
}

template <std::int32_t kSamples>
std::optional<Rgb> SampleMeans::full_mean(const Gradient& gradient,
                                          std::int32_t i, std::int32_t j) {
  ChannelSums sums;
  PixelGradient<kSamples>(gradient, i, j).add_all(sums);
  const auto mean = rounded_mean<kSamples * kSamples>(sums);
  if (mean) stats_.filtered += 3;
  return mean;
}

template <std::int32_t kSamples>
std::int32_t SampleMeans::fill_run(const PolygonId* items, std::int64_t stride,
                                   std::int32_t most, std::int32_t i,
                                   std::int32_t j, Rgb* colors) {
  std::int32_t length = 1;
  while (length < most && items[length * kSamples] == items[0] &&
         are_equal<kSamples>(items + length * kSamples, stride)) {
    ++length;
  }
  const std::int32_t done = kernel_.full_means(
      shaded(items[0]).gradient, kSamples, i, j, length, &colors->r);
  stats_.filtered += 3 * static_cast<std::uint64_t>(done);
  return done;
}

template <std::int32_t kSamples>
std::optional<Rgb> SampleMeans::mixed_mean(const PolygonId* items,
                                           std::int64_t stride, std::int32_t i,
                                           std::int32_t j) {
  constexpr std::int32_t kCount = kSamples * kSamples;
  std::size_t part_count = 0;
  std::array<std::int32_t, 4> whole = {};
  const auto add_whole = [&](std::int32_t n, const Rgb& color) {
    whole[0] += n * color.r;
    whole[1] += n * color.g;
    whole[2] += n * color.b;
  };
  std::uint64_t left = ~std::uint64_t{0} >> (64 - kCount);
  while (left != 0) {
    const std::int32_t first = std::countr_zero(left);
    const PolygonId item = items[first / kSamples * stride + first % kSamples];
    const std::uint64_t own = samples_of<kSamples>(items, stride, item);
    left &= ~own;
    if (is_cap(item)) {
      for (std::uint64_t bits = own; bits != 0; bits &= bits - 1) {
        const std::int32_t k = std::countr_zero(bits);
        add_whole(1, flat_color(item, i + k % kSamples, j + k / kSamples));
      }
      continue;
    }
    if (item != kBackground) {
      if (const Shaded& seen = shaded(item); seen.is_smooth) {
        // Two that would have one place are rare.
        for (std::size_t p = 0; p < part_count; ++p) {
          if (parts_[p].gradient == &seen.gradient) return std::nullopt;
        }
        parts_[part_count++] = {&seen.gradient, moments_of<kSamples>(own)};
        continue;
      }
    }
    add_whole(std::popcount(own), flat_color(item, i, j));
  }
  const auto mean = mean_of<kSamples>({parts_.data(), part_count}, whole, i, j);
  if (mean) stats_.filtered += 3;
  return mean;
}

template <std::int32_t kSamples>
std::optional<Rgb> SampleMeans::mean_of(
    std::span<const MeanPart> parts, const std::array<std::int32_t, 4>& whole,
    std::int32_t i, std::int32_t j) const {
  if (kernel_.mixed_mean != nullptr) {
    Rgb mean;
    const auto count = static_cast<std::int32_t>(parts.size());
    const bool decided = kernel_.mixed_mean(parts.data(), count, whole.data(),
                                            kSamples, i, j, &mean.r);
    return decided ? std::optional(mean) : std::nullopt;
  }
  ChannelSums sums = {{static_cast<double>(whole[0]),
                       static_cast<double>(whole[1]),
                       static_cast<double>(whole[2])}};
  for (const MeanPart& part : parts)
    PixelGradient<kSamples>(*part.gradient, i, j).add(part.moments, sums);
  return rounded_mean<kSamples * kSamples>(sums);
}

/// A channel of a sample is off by at most doubt / total (Gradient). Of up to
/// 64 values of at most 256 a sum of doubles is off by 64 2^14 u = 2^-33 in any
/// order, and 2^-30 with what rounding adds to the bound.
template <std::int32_t kSamples>
Rgb SampleMeans::smooth_mean(const PolygonId* items, std::int64_t stride,
                             std::int32_t i, std::int32_t j) {
  // One of each column of samples.
  std::array<std::array<double, std::size_t{kSamples}>, 3> sums = {};
  std::array<double, std::size_t{kSamples}> doubts = {};
  const auto add = [&](const Gradient& g, std::size_t a, double v) {
    const double u = i + static_cast<std::int32_t>(a);
    const double reciprocal = 1 / (g.a[3] * u + (g.b[3] * v + g.c[3]));
    for (std::size_t c = 0; c < 3; ++c)
      sums[c][a] += (g.a[c] * u + (g.b[c] * v + g.c[c])) * reciprocal;
    const double own = g.doubt * reciprocal;
    // A total too small to trust makes the doubt large, negative or no number.
    doubts[a] += own >= 0 && own < 1 ? own : 0x1p30;
  };
  for (std::int32_t b = 0; b < kSamples; ++b) {
    const PolygonId* line = items + b * stride;
    const double v = j + b;
    if (are_equal<kSamples, 1>(line) && is_smooth(line[0])) {
      const Gradient g = shaded(line[0]).gradient;
      for (std::size_t a = 0; a < kSamples; ++a) add(g, a, v);
      continue;
    }
    for (std::size_t a = 0; a < kSamples; ++a) {
      const PolygonId item = line[a];
      if (is_smooth(item)) {
        add(shaded(item).gradient, a, v);
        continue;
      }
      const Rgb color =
          flat_color(item, i + static_cast<std::int32_t>(a), j + b);
      sums[0][a] += color.r;
      sums[1][a] += color.g;
      sums[2][a] += color.b;
    }
  }
  std::array<double, 3> sum = {};
  double doubt = 0x1p-30;
  for (std::size_t a = 0; a < kSamples; ++a) {
    for (std::size_t c = 0; c < 3; ++c) sum[c] += sums[c][a];
    doubt += doubts[a];
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

/// The samples of one item come one after another: its shader is prepared once.
template <class Visit>
void SampleMeans::for_samples(const PolygonId* items, std::int64_t stride,
                              const Visit& visit) const {
  std::uint64_t left = ~std::uint64_t{0} >> (64 - samples_ * samples_);
  while (left != 0) {
    const std::int32_t first = std::countr_zero(left);
    const PolygonId item = items[first / samples_ * stride + first % samples_];
    for (std::uint64_t rest = left; rest != 0; rest &= rest - 1) {
      const std::int32_t k = std::countr_zero(rest);
      const std::int32_t a = k % samples_;
      const std::int32_t b = k / samples_;
      if (items[b * stride + a] != item) continue;
      left &= ~(std::uint64_t{1} << k);
      visit(item, a, b);
    }
  }
}

/// The polygons of a pixel are asked for again, for each channel.
GouraudShader& SampleMeans::exact_shader_of(PolygonId polygon) {
  const auto found =
      std::find(exact_polygons_.begin(), exact_polygons_.end(), polygon);
  if (found != exact_polygons_.end())
    return exact_shaders_[static_cast<std::size_t>(found -
                                                   exact_polygons_.begin())];
  const std::size_t at = next_exact_++ % exact_polygons_.size();
  exact_polygons_[at] = polygon;
  exact_shaders_[at].start(polygon,
                           eye_side_(reader_.planes().plane(polygon), polygon));
  return exact_shaders_[at];
}

double SampleMeans::close_sum(std::size_t channel, const PolygonId* items,
                              std::int64_t stride, std::int32_t i,
                              std::int32_t j) {
  double sum = 0;
  for_samples(
      items, stride, [&](PolygonId item, std::int32_t a, std::int32_t b) {
        sum += is_smooth(item)
                   ? exact_shader_of(item).close_value(channel, i + a, j + b)
                   : channel_of(flat_color(item, i + a, j + b), channel);
      });
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
  for_samples(
      items, stride, [&](PolygonId item, std::int32_t a, std::int32_t b) {
        if (is_smooth(item)) {
          sum += exact_shader_of(item).exact_value(channel, i + a, j + b);
        } else {
          sum += channel_of(flat_color(item, i + a, j + b), channel);
        }
      });
  return rounded_channel(sum / (samples_ * samples_));
}

}  // namespace halfspace::fast
