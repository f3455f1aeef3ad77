#include "shade/corner_blend.hpp"

#include <algorithm>
#include <cmath>

#include "exact/filter.hpp"

namespace halfspace::fast {

/// Each weight is off by at most W: 920u R^2 L in perspective, with R bounding
/// the coordinates of the view and of the eye together and L those of the
/// edges, and else 432u E R L, with E the largest component of the direction
/// (the derivation is that of GouraudShader::prepare()). A total T, of three,
/// is off by 3W, so a share by 4W/T and what a quotient and its sum of three
/// round, 8u. A sum of three values times shares is off by 12W/T + 24u of the
/// largest value, and 4u for its own roundings. With 48W < T, which a doubt
/// below 1/4 means, the computed total stands for the true one if 16 is
/// written for 12; 64u is more than 28u.
void CornerBlend::start(PolygonId triangle) {
  triangle_ = triangle;
  using Point = std::array<double, 3>;
  const auto minus = [](const Point& p, const Point& q) {
    return Point{p[0] - q[0], p[1] - q[1], p[2] - q[2]};
  };
  const auto dot = [](const Point& p, const Point& q) {
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
  };
  const auto corners = scene_.corners(triangle);
  const auto point = [&](std::size_t c) {
    const Vertex v = to_vertex(scene_.point(corners[c % 3]));
    return Point{v.x, v.y, v.z};
  };
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Point from = point(k + 1);
    const Point to = point(k + 2);
    const Point u = view_.perspective ? minus(to, view_.eye) : view_.eye;
    const Point v = view_.perspective ? minus(from, to) : minus(to, from);
    longest =
        std::max({longest, std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
    const Point m = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                     u[0] * v[1] - u[1] * v[0]};
    a_[k] = dot(m, view_.right);
    b_[k] = dot(m, view_.down);
    c_[k] = dot(m, minus(view_.start, view_.perspective ? view_.eye : from));
  }
  const double eye = std::max(
      {std::abs(view_.eye[0]), std::abs(view_.eye[1]), std::abs(view_.eye[2])});
  const double reach = view_.reach + (view_.perspective ? eye : 0.0);
  const double weight_error = kRounding * longest * reach *
                              (view_.perspective ? 920 * reach : 432 * eye);
  error_ = 16 * weight_error;
  least_doubt_ = 64 * kRounding;
}

BigRational CornerBlend::exact_sum(
    std::int32_t i, std::int32_t j,
    const std::array<BigRational, 3>& values) const {
  const auto corners = scene_.corners(triangle_);
  BigRational sum = 0;
  BigInteger total = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const BigInteger weight =
        to_big_integer(edge_function(scene_.point(corners[(k + 1) % 3]),
                                     scene_.point(corners[(k + 2) % 3]),
                                     camera_, view_.samples)
                           .at_centre(i, j));
    total += weight;
    sum += weight * values[k];
  }
  return sum / total;
}

}  // namespace halfspace::fast
