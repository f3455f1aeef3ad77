#include "halfspace/fast/shade/color_forms.hpp"

#include <algorithm>
#include <cmath>

#include "camera/edge_function.hpp"
#include "exact/big_rational.hpp"
#include "halfspace/fast/predicate.hpp"
#include "raster/gouraud.hpp"

namespace halfspace::fast {
namespace {

using BigForm = std::array<BigInteger, 3>;

/// The weight of a corner: the image line of the side opposite to it, as a
/// function of image points, which are half of what edge functions take.
BigForm weight_of(const Scene& scene, const CameraData& camera, VertexId from,
                  VertexId to) {
  const auto line = edge_function(scene.point(from), scene.point(to), camera);
  return {2 * to_big_integer(line.a), 2 * to_big_integer(line.b),
          to_big_integer(line.c)};
}

}  // namespace

std::optional<ColorForms> color_forms(const Scene& scene, const Camera& camera,
                                      PolygonId polygon) {
  if (!has_gradient(scene, polygon)) return std::nullopt;
  const auto corners = scene.corners(polygon);
  const auto colors = scene.corner_colors(polygon);
  std::array<BigForm, 4> sums;
  for (std::size_t k = 0; k < 3; ++k) {
    const BigForm weight = weight_of(scene, camera.data(), corners[(k + 1) % 3],
                                     corners[(k + 2) % 3]);
    const int parts[4] = {colors[k].r, colors[k].g, colors[k].b, 1};
    for (std::size_t f = 0; f < 4; ++f) {
      for (std::size_t c = 0; c < 3; ++c) sums[f][c] += parts[f] * weight[c];
    }
  }
  FilterStats stats;
  const bool is_turned =
      side_of_eye(scene, polygon, camera, stats) == Side::kNegative;
  unsigned bits = 0;
  for (const BigForm& sum : sums) {
    for (const BigInteger& number : sum) {
      if (number != 0)
        bits = std::max(
            bits, static_cast<unsigned>(msb(number < 0 ? -number : number)));
    }
  }
  ColorForms result;
  for (std::size_t f = 0; f < 4; ++f) {
    for (std::size_t c = 0; c < 3; ++c) {
      const double size = is_turned ? -sums[f][c].convert_to<double>()
                                    : sums[f][c].convert_to<double>();
      result.forms[f][c] = std::ldexp(size, -static_cast<int>(bits));
    }
  }
  return result;
}

}  // namespace halfspace::fast
