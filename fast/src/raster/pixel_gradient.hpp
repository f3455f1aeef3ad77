#pragma once

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "halfspace/polygon.hpp"
#include "raster/kernel/tile_kernel.hpp"

/// The sums of colours over samples of a pixel, in closed form.
namespace halfspace::fast {

/// Channels added up over samples, and by how much each sum may be off.
struct ChannelSums {
  std::array<double, 3> sum = {};
  double doubt = 0;
};

/// A gradient about the centre of a pixel, where s = N / D of affine N and D.
/// With e = (D - D0) / D0 and g = (N - N0) / D0 - s0 e, affine functions that
/// are 0 at the centre, s = s0 + g / (1 + e) = s0 + g - g e + g e^2 - ..., so
/// the moments of samples give the sum of all but what is below g e^2: at most
/// G E^2 / (1 - E) each, with the bounds G and E of |g| and |e| in the pixel.
/// Of all samples odd moments are 0, and G E^3 / (1 - E) is left.
///
/// What doubles hold of N and D is off by the gradient's doubt, over D, at a
/// sample, where s is at most 255: over D0 by 4/3 of that at most for E <= 1/4.
/// Computing N0 and D0 rounds as for a sample, and |s0| <= 512 makes twice of
/// that; the rest rounds by some 2^-49 (G + 512), below 2^-38. In all a sample
/// is off by 5 doubt / D0 + 4/3 G E^2 + 2^-38.
template <std::int32_t kSamples>
class PixelGradient {
 public:
  PixelGradient(const Gradient& gradient, std::int32_t i, std::int32_t j)
      : own_(gradient) {
    constexpr double kMiddle = 0.5 * (kSamples - 1);
    u_ = i + kMiddle;
    v_ = j + kMiddle;
    reciprocal_ = 1 / (own_.a[3] * u_ + (own_.b[3] * v_ + own_.c[3]));
    half_ = 0.5 * reciprocal_;
    e_x_ = own_.a[3] * half_;
    e_y_ = own_.b[3] * half_;
    e_ = (std::abs(e_x_) + std::abs(e_y_)) * (kSamples - 1);
    const double doubt = own_.doubt * reciprocal_;
    // Else, and where no number, nothing is known.
    is_usable_ = e_ <= 0.25 && doubt >= 0 && doubt < 1;
    doubt_ = 5 * doubt + 0x1p-38;
  }

  void add(const Moments& m, ChannelSums& to) const {
    double most = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto [s, x, y] = at_centre(c, most);
      to.sum[c] +=
          m.n * s + (x * m.x + y * m.y) -
          (x * e_x_ * m.xx + (x * e_y_ + y * e_x_) * m.xy + y * e_y_ * m.yy);
    }
    add_doubt(m.n, most, e_ * e_, to);
  }
  void add_all(ChannelSums& to) const {
    constexpr std::int32_t kCount = kSamples * kSamples;
    constexpr double kSquares = kCount * (kCount - 1) / 3;
    double most = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto [s, x, y] = at_centre(c, most);
      to.sum[c] += kCount * s - kSquares * (x * e_x_ + y * e_y_);
    }
    add_doubt(kCount, most, e_ * e_ * e_, to);
  }

 private:
  struct Centre {
    double s, x, y;
  };
  /// A channel, and g for half a sample to the right and down.
  Centre at_centre(std::size_t c, double& most) const {
    const double s =
        (own_.a[c] * u_ + (own_.b[c] * v_ + own_.c[c])) * reciprocal_;
    const double x = (own_.a[c] - s * own_.a[3]) * half_;
    const double y = (own_.b[c] - s * own_.b[3]) * half_;
    const double size = (std::abs(x) + std::abs(y)) * (kSamples - 1);
    most = std::max({most, size, std::abs(s) <= 512 ? 0 : 0x1p30});
    return {s, x, y};
  }
  void add_doubt(std::int32_t n, double most, double beyond,
                 ChannelSums& to) const {
    const double own = doubt_ + 4.0 / 3 * most * beyond;
    to.doubt += is_usable_ && most <= 256 ? n * own : 0x1p30;
  }

  const Gradient& own_;
  double u_, v_, reciprocal_, half_, e_x_, e_y_, e_, doubt_;
  bool is_usable_;
};

/// The mean of so many samples, rounded half up; nothing where a sum may be on
/// either side of a step.
template <std::int32_t kCount>
std::optional<Rgb> rounded_mean(const ChannelSums& sums) {
  // Adding up rounds as smooth_mean() says; whole numbers are added exactly.
  const double doubt = sums.doubt > 0 ? sums.doubt + 0x1p-30 : 0;
  if (!(doubt < kCount / 4)) return std::nullopt;
  std::array<std::uint8_t, 3> mean = {};
  for (std::size_t c = 0; c < 3; ++c) {
    const double value = sums.sum[c] + kCount / 2;
    // Not below 0 by more than the doubt.
    const auto level = static_cast<std::int32_t>(value * (1.0 / kCount));
    const double above = value - level * kCount;
    if (!(above >= doubt && above < kCount - doubt)) return std::nullopt;
    mean[c] = static_cast<std::uint8_t>(level);
  }
  return Rgb{mean[0], mean[1], mean[2]};
}

/// The samples of a pixel as bits, line by line, of those that see a polygon.
template <std::int32_t kSamples>
std::uint64_t samples_of(const PolygonId* items, std::int64_t stride,
                         PolygonId polygon) {
  std::uint64_t bits = 0;
#if defined(__SSE2__)
  constexpr std::int32_t kTogether = kSamples < 4 ? 1 : 4;
  const __m128i own = _mm_set1_epi32(polygon);
#else
  constexpr std::int32_t kTogether = 1;
#endif
  for (std::int32_t b = 0; b < kSamples; ++b) {
    const PolygonId* line = items + b * stride;
    for (std::int32_t a = 0; a < kSamples; a += kTogether) {
      std::uint64_t here = line[a] == polygon ? 1 : 0;
#if defined(__SSE2__)
      if constexpr (kTogether == 4) {
        const auto* four = reinterpret_cast<const __m128i*>(line + a);
        const __m128i equal = _mm_cmpeq_epi32(_mm_loadu_si128(four), own);
        here = static_cast<std::uint64_t>(
            _mm_movemask_ps(_mm_castsi128_ps(equal)));
      }
#endif
      bits |= here << (b * kSamples + a);
    }
  }
  return bits;
}

/// The moments of samples of one line, by their bits.
template <std::int32_t kSamples>
constexpr auto kLineMoments = [] {
  std::array<Moments, std::size_t{1} << kSamples> table{};
  for (std::size_t bits = 0; bits < table.size(); ++bits) {
    for (std::int32_t a = 0; a < kSamples; ++a) {
      if ((bits >> a & 1) == 0) continue;
      const std::int32_t x = 2 * a - (kSamples - 1);
      table[bits].n += 1;
      table[bits].x += x;
      table[bits].xx += x * x;
    }
  }
  return table;
}();

template <std::int32_t kSamples>
Moments moments_of(std::uint64_t bits) {
  Moments sum;
  for (std::int32_t b = 0; b < kSamples; ++b) {
    const std::uint64_t own =
        bits >> (b * kSamples) & ((std::uint64_t{1} << kSamples) - 1);
    const Moments& line = kLineMoments<kSamples>[own];
    const std::int32_t y = 2 * b - (kSamples - 1);
    sum.n += line.n;
    sum.x += line.x;
    sum.y += line.n * y;
    sum.xx += line.xx;
    sum.xy += line.x * y;
    sum.yy += line.n * y * y;
  }
  return sum;
}

}  // namespace halfspace::fast
