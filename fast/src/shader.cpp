#include "shader.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "filter.hpp"

namespace halfspace::fast {
namespace {

/// a line plus `factor` times another. Bits: see edge_line(), and 8 of a
/// colour, 2 of three summands and 2 of exact_channel(): 238 of 256.
void add(ImageLine<4>& sum, const ImageLine<4>& line, int factor) {
  sum.a = sum.a + multiply<4>(line.a, Int128{factor});
  sum.b = sum.b + multiply<4>(line.b, Int128{factor});
  sum.c = sum.c + multiply<4>(line.c, Int128{factor});
}

}  // namespace

bool has_gradient(const Scene& scene, PolygonId polygon) {
  const auto colors = scene.corner_colors(polygon);
  return std::adjacent_find(colors.begin(), colors.end(),
                            std::not_equal_to<>()) != colors.end();
}

void Shader::prepare() {
  ready_ = true;
  const auto corners = scene_.corners(polygon_);
  const auto colors = scene_.corner_colors(polygon_);
  exact_sums_ = {};
  exact_total_ = {};
  for (std::size_t k = 0; k < 3; ++k) {
    const ImageLine<4> weight =
        edge_line(scene_.point(corners[(k + 1) % 3]),
                  scene_.point(corners[(k + 2) % 3]), camera_);
    add(exact_total_, weight, eye_sign_);
    const std::array<int, 3> channels = {colors[k].r, colors[k].g, colors[k].b};
    for (std::size_t c = 0; c < 3; ++c) {
      add(exact_sums_[c], weight, eye_sign_ * channels[c]);
    }
  }
  const auto rounded = [](const ImageLine<4>& line) {
    return Line{to_double(line.a), to_double(line.b), to_double(line.c)};
  };
  // Each coefficient is off by 2u of its size at most, each product by u and
  // each of two sums by u: 5u of the sum of sizes, for pixels of the image. A
  // quotient N / D, at most 256, is off by (N's error + 256 D's) / D, and its
  // own rounding and that of the reciprocal by 3u 256, which D's share, twice
  // counted here, pays for: no D exceeds the sum of its sizes.
  const auto error = [this](const Line& line) {
    return 8 * kRounding *
           (2.0 * camera_.width_px * std::abs(line.a) +
            2.0 * camera_.height_px * std::abs(line.b) + std::abs(line.c));
  };
  total_ = rounded(exact_total_);
  doubt_ = 2 * 256 * error(total_);
  for (std::size_t c = 0; c < 3; ++c) {
    sums_[c] = rounded(exact_sums_[c]);
    doubt_ += 2 * error(sums_[c]);
  }
}

int Shader::shade(std::int32_t x, std::int32_t j, std::uint32_t bits,
                  std::uint8_t* line) {
  if (!ready_) prepare();
  const double v = 2.0 * j + 1;
  const double total_here = total_.b * v + total_.c;
  std::array<double, 3> sums_here;
  for (std::size_t c = 0; c < 3; ++c) {
    sums_here[c] = sums_[c].b * v + sums_[c].c;
  }
  int exact = 0;
  for (; bits != 0; bits &= bits - 1) {
    const int k = __builtin_ctz(bits);
    const double u = 2.0 * (x + k) + 1;
    const double reciprocal = 1 / (total_.a * u + total_here);
    const double doubt = doubt_ * reciprocal;
    for (std::size_t c = 0; c < 3; ++c) {
      // Half up: the floor of the value and a half. A total too small to
      // trust makes the doubt large, or negative, or no number.
      const double value = (sums_[c].a * u + sums_here[c]) * reciprocal + 0.5;
      const bool usable = doubt >= 0 && doubt < 0.25;
      auto level = static_cast<std::int32_t>(usable ? value : 128.0);
      const double above = value - level;
      if (!usable || !(above > doubt && above < 1 - doubt)) {
        ++exact;
        level = exact_channel(c, x + k, j, std::clamp(level, 0, 255));
      }
      line[3 * k + static_cast<int>(c)] = static_cast<std::uint8_t>(level);
    }
  }
  return exact;
}

std::uint8_t Shader::exact_channel(std::size_t channel, std::int32_t i,
                                   std::int32_t j, std::int32_t guess) const {
  // The greatest k with k <= sum / total + 1/2, or 2 k total <= 2 sum + total.
  const Wide<4> total = exact_total_.at_centre(i, j);
  const Wide<4> sum = exact_sums_[channel].at_centre(i, j);
  const Wide<4> level = sum + sum + total;
  const auto reaches = [&](std::int32_t k) {
    return !(level - multiply<4>(total, Int128{2 * k})).is_negative();
  };
  std::int32_t k = guess;
  while (k > 0 && !reaches(k)) --k;
  while (k < 255 && reaches(k + 1)) ++k;
  return static_cast<std::uint8_t>(k);
}

}  // namespace halfspace::fast
