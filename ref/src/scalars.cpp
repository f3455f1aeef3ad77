#include "halfspace/ref/scalars.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "exact_double.hpp"
#include "halfspace/cap_parts.hpp"
#include "halfspace/ref/shade.hpp"

namespace halfspace::ref {
namespace {

/// A channel of the scale's colour under the light that falls on the polygon.
std::uint8_t dimmed(std::uint8_t full, const Rational& light) {
  const Rational half = Rational(1) / Rational(2);
  return static_cast<std::uint8_t>(
      floor(Rational(full) * light / Rational(255) + half).to_int64());
}

}  // namespace

std::optional<Rational> scalar_at(const Scene& scene, const Camera& camera,
                                  const ScalarField& field, PolygonId polygon,
                                  const ImagePoint& point) {
  const auto values = field.of(scene, polygon);
  for (const double value : values) {
    if (std::isnan(value)) return std::nullopt;
  }
  const bool are_equal = std::all_of(values.begin(), values.end(),
                                     [&](double v) { return v == values[0]; });
  if (are_equal) return rational_of(values[0]);
  // Values differ: a triangle (S11.1).
  const std::array<Rational, 3> share =
      corner_shares(scene, camera, polygon, point);
  Rational sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += share[k] * rational_of(values[k]);
  return sum;
}

Rgb color_of(const ColorScale& scale, const std::optional<Rational>& scalar) {
  if (!scalar) return scale.no_data;
  if (scale.limits && (*scalar < rational_of(scale.limits->low) ||
                       *scalar > rational_of(scale.limits->high))) {
    return scale.limits->color;
  }
  std::size_t k = 0;
  for (const double step : scale.steps) k += rational_of(step) <= *scalar;
  return scale.colors[k];
}

Rgb scalar_color(const Scene& scene, const Camera& camera,
                 const ImageOptions& options, const ScalarField& field,
                 const ColorScale& scale, PolygonId polygon,
                 const ImagePoint& at) {
  const Rgb full =
      color_of(scale, scalar_at(scene, camera, field, polygon, at));
  const ExactColor light =
      exact_color_at(scene, camera, polygon, at, options.shading);
  return Rgb{dimmed(full.r, light[0]), dimmed(full.g, light[1]),
             dimmed(full.b, light[2])};
}

ColorImage color_scalars(const Scene& scene, const Camera& camera,
                         const ImageOptions& options, const ItemImage& items,
                         const ScalarField& field, const ColorScale& scale,
                         std::int32_t samples) {
  const auto polygons = static_cast<PolygonId>(scene.polygon_count());
  // The colour of sample (i, j) of all.
  const auto sample = [&](std::int32_t i, std::int32_t j) {
    const PolygonId seen = items.at(i, j);
    if (seen == kBackground) return options.background;
    if (seen >= polygons) {
      return cap_color_at_sample(
          options, cap_item(static_cast<std::size_t>(seen - polygons)), i, j,
          samples);
    }
    const ImagePoint at = {Rational(2 * i + 1) / Rational(2 * samples),
                           Rational(2 * j + 1) / Rational(2 * samples)};
    return scalar_color(scene, camera, options, field, scale, seen, at);
  };
  ColorImage image(camera->width_px, camera->height_px, options.background);
  const int count = samples * samples;
  for (std::int32_t j = 0; j < image.height_px; ++j) {
    for (std::int32_t i = 0; i < image.width_px; ++i) {
      ExactColor mean = {0, 0, 0};
      for (std::int32_t s = 0; s < count; ++s) {
        const ExactColor own =
            exact(sample(i * samples + s % samples, j * samples + s / samples));
        for (std::size_t c = 0; c < 3; ++c) mean[c] += own[c];
      }
      for (Rational& channel : mean) channel = channel / Rational(count);
      image.at(i, j) = rounded_color(mean);
    }
  }
  return image;
}

}  // namespace halfspace::ref
