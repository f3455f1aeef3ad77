#include "raster/gouraud.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>

#include "exact/filter.hpp"

namespace halfspace::fast {
namespace {

/// a line plus `factor` times another. Bits: see edge_function(), and 8 of a
/// colour, 2 of three summands and 2 of exact_channel(): 238 of 256.
void add(EdgeFunction<4>& sum, const EdgeFunction<4>& line, int factor) {
  sum.a = sum.a + multiply<4>(line.a, Int128{factor});
  sum.b = sum.b + multiply<4>(line.b, Int128{factor});
  sum.c = sum.c + multiply<4>(line.c, Int128{factor});
}

}  // namespace

bool has_gradient(const Scene& scene, PolygonId polygon) {
  return has_gradient(scene.corner_colors(polygon));
}

bool has_gradient(std::span<const Rgb> colors) {
  return std::adjacent_find(colors.begin(), colors.end(),
                            std::not_equal_to<>()) != colors.end();
}

void GouraudShader::prepare_exact() {
  exact_ready_ = true;
  const auto corners = scene_.corners(polygon_);
  const auto colors = scene_.corner_colors(polygon_);
  exact_sums_ = {};
  exact_total_ = {};
  for (std::size_t k = 0; k < 3; ++k) {
    const EdgeFunction<4> weight = edge_function(
        scene_.point(corners[(k + 1) % 3]), scene_.point(corners[(k + 2) % 3]),
        camera_, view_.samples);
    add(exact_total_, weight, eye_sign_);
    const std::array<int, 3> channels = {colors[k].r, colors[k].g, colors[k].b};
    for (std::size_t c = 0; c < 3; ++c) {
      add(exact_sums_[c], weight, eye_sign_ * channels[c]);
    }
  }
}

/// The weights as edge_function() has them, in doubles.
///
/// All is a product of differences, which are taken before anything is rounded
/// that is larger than they are: the error is one of what is near, whatever the
/// grid and the place in it. Let D bound the sizes of the differences of the
/// corners to the eye, L those of the edges, S those of the image points to the
/// eye, the view's slack included in D and S. A difference to the eye is off by
/// 5u D, an edge by u L. A component of the cross product has two products of
/// at most D L, off by 7u D L each, and a difference: 16u D L in all, and is at
/// most 2 D L. Its product with a component of a camera vector, off by 5u, is
/// off by 16u + 10u + 2u = 28u times that component; three of them 84u and
/// their sums 10u, so the three parts a i, b j, c of a weight together by 94u
/// D L S, and they are at most 6 D L S. A sum of a channel has three of them,
/// times 255 at most: 282u from these, 18u from the factors, 30u from two sums;
/// its value at a pixel has two products and two sums more: 54u. So it is off
/// by 255 times 384u D L S, and the total by 384u D L S. A quotient of at most
/// 256 is off by (255 + 256) 384u D L S over the total, and its own roundings
/// add 3u 256; as the total is at most 18 D L S that is 18 times that over the
/// total. 2^18 u D L S bounds all of it.
///
/// Without perspective the direction stands in place of a difference to the
/// eye, D being its largest component, and a corner in place of the eye for S.
void GouraudShader::prepare() {
  ready_ = true;
  using Point = std::array<double, 3>;
  const auto minus = [](const Point& p, const Point& q) {
    return Point{p[0] - q[0], p[1] - q[1], p[2] - q[2]};
  };
  const auto plus = [](const Point& p, const Point& q) {
    return Point{p[0] + q[0], p[1] + q[1], p[2] + q[2]};
  };
  const auto dot = [](const Point& p, const Point& q) {
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
  };
  const auto size = [](const Point& p) {
    return std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
  };
  const auto colors = scene_.corner_colors(polygon_);
  if (!has_corners_) read_corners();
  Gradient& g = gradient_;
  std::array<std::array<double, 4>, 3> across{}, down{}, at{};
  double edge = 0;
  double direction = view_.perspective ? 0 : size(view_.eye);
  double sight = view_.perspective ? size(view_.sight) : 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto point = [this](std::size_t c) {
      const Vertex& v = corners_[c % 3];
      return Point{v.x, v.y, v.z};
    };
    const Point from = point(k + 1);
    const Point to = point(k + 2);
    // The edge in place of `from` less the eye: the same product.
    const Point u = view_.perspective
                        ? minus(minus(to, view_.eye), view_.eye_rest)
                        : view_.eye;
    const Point v = view_.perspective ? minus(from, to) : minus(to, from);
    const Point s = view_.perspective
                        ? view_.sight
                        : plus(minus(view_.start, from), view_.start_rest);
    edge = std::max(edge, size(v));
    direction = std::max(direction, size(u));
    sight = std::max(sight, size(s));
    const Point m = {eye_sign_ * (u[1] * v[2] - u[2] * v[1]),
                     eye_sign_ * (u[2] * v[0] - u[0] * v[2]),
                     eye_sign_ * (u[0] * v[1] - u[1] * v[0])};
    const double a = dot(m, view_.right);
    const double b = dot(m, view_.down);
    const double c = dot(m, s);
    const std::array<double, 4> factors = {
        static_cast<double>(colors[k].r), static_cast<double>(colors[k].g),
        static_cast<double>(colors[k].b), 1.0};
    for (std::size_t f = 0; f < 4; ++f) {
      across[k][f] = factors[f] * a;
      down[k][f] = factors[f] * b;
      at[k][f] = factors[f] * c;
    }
  }
  for (std::size_t f = 0; f < 4; ++f) {
    g.a[f] = across[0][f] + across[1][f] + across[2][f];
    g.b[f] = down[0][f] + down[1][f] + down[2][f];
    g.c[f] = at[0][f] + at[1][f] + at[2][f];
  }
  gradient_.doubt = 0x1p18 * kRounding * edge * (direction + view_.slack) *
                    (sight + view_.span + view_.slack);
}

void GouraudShader::read_corners() {
  const auto corners = scene_.corners(polygon_);
  for (std::size_t k = 0; k < 3; ++k) {
    corners_[k] = to_vertex(scene_.point(corners[k]));
  }
  has_corners_ = true;
}

int GouraudShader::shade(std::int32_t x, std::int32_t j, std::uint32_t bits,
                         std::uint8_t* colors, std::int64_t at) {
  const Gradient& g = gradient();
  const double v = j;
  int exact = 0;
  for (; bits != 0; bits &= bits - 1) {
    const int k = __builtin_ctz(bits);
    const double u = x + k;
    const double reciprocal = 1 / (g.a[3] * u + (g.b[3] * v + g.c[3]));
    const double doubt = g.doubt * reciprocal;
    for (std::size_t c = 0; c < 3; ++c) {
      // Half up: the floor of the value and a half. A total too small to
      // trust makes the doubt large, or negative, or no number.
      const double value =
          (g.a[c] * u + (g.b[c] * v + g.c[c])) * reciprocal + 0.5;
      const bool usable = doubt >= 0 && doubt < 0.25;
      auto level = static_cast<std::int32_t>(usable ? value : 128.0);
      const double above = value - level;
      if (!usable || !(above > doubt && above < 1 - doubt)) {
        ++exact;
        level = exact_channel(c, x + k, j, std::clamp(level, 0, 255));
      }
      colors[at + 3 * k + static_cast<int>(c)] =
          static_cast<std::uint8_t>(level);
    }
  }
  return exact;
}

/// As exact_channel(), with the wider numbers of a moved camera. Bits: see
/// edge_function(), and 8 of a colour, 2 of three summands and 2: 815 of 896.
std::uint8_t GouraudShader::moved_channel(std::size_t channel, std::int32_t i,
                                          std::int32_t j,
                                          std::int32_t guess) const {
  const auto corners = scene_.corners(polygon_);
  const auto colors = scene_.corner_colors(polygon_);
  Wide<14> total;
  Wide<14> sum;
  for (std::size_t k = 0; k < 3; ++k) {
    const Wide<14> weight =
        multiply<14>(edge_function(scene_.point(corners[(k + 1) % 3]),
                                   scene_.point(corners[(k + 2) % 3]), *moved_,
                                   view_.samples)
                         .at_centre(i, j),
                     Int128{eye_sign_});
    const std::array<int, 3> channels = {colors[k].r, colors[k].g, colors[k].b};
    total = total + weight;
    sum = sum + multiply<14>(weight, Int128{channels[channel]});
  }
  const Wide<14> level = sum + sum + total;
  const auto reaches = [&](std::int32_t k) {
    return !(level - multiply<14>(total, Int128{2 * k})).is_negative();
  };
  std::int32_t k = guess;
  while (k > 0 && !reaches(k)) --k;
  while (k < 255 && reaches(k + 1)) ++k;
  return static_cast<std::uint8_t>(k);
}

std::uint8_t GouraudShader::exact_channel(std::size_t channel, std::int32_t i,
                                          std::int32_t j, std::int32_t guess) {
  if (moved_ != nullptr) return moved_channel(channel, i, j, guess);
  if (!exact_ready_) prepare_exact();
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

double GouraudShader::close_value(std::size_t channel, std::int32_t i,
                                  std::int32_t j) {
  if (!exact_ready_) prepare_exact();
  return to_double(exact_sums_[channel].at_centre(i, j)) /
         to_double(exact_total_.at_centre(i, j));
}

BigRational GouraudShader::exact_value(std::size_t channel, std::int32_t i,
                                       std::int32_t j) {
  if (!exact_ready_) prepare_exact();
  return quotient_of(to_big_integer(exact_sums_[channel].at_centre(i, j)),
                     to_big_integer(exact_total_.at_centre(i, j)));
}

BigRational GouraudShader::exact_value_at(std::size_t channel,
                                          const BigRational& twice_x,
                                          const BigRational& twice_y) {
  if (!exact_ready_) prepare_exact();
  const auto value = [&](const EdgeFunction<4>& f) -> BigRational {
    return to_big_integer(f.a) * twice_x + to_big_integer(f.b) * twice_y +
           BigRational(to_big_integer(f.c));
  };
  return value(exact_sums_[channel]) / value(exact_total_);
}

}  // namespace halfspace::fast
