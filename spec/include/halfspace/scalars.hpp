#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "halfspace/polygon.hpp"
#include "halfspace/result.hpp"
#include "halfspace/scene.hpp"

namespace halfspace {

/// The value that stands for no data: not a number, of any kind.
constexpr double kNoData = std::numeric_limits<double>::quiet_NaN();

/// Numbers over a scene (S11.1): one a polygon, or one a corner.
struct ScalarField {
  bool at_corners = false;
  std::vector<double> values;  ///< in the order of polygons, or of corners

  /// The values of a polygon: one, or one a corner.
  /// Requires: a field of the scene (make_scalars()).
  std::span<const double> of(const Scene& scene, PolygonId polygon) const {
    const auto p = static_cast<std::size_t>(polygon);
    if (!at_corners) return {values.data() + p, 1};
    const std::size_t first = scene.data().first_corner[p];
    return {values.data() + first, scene.data().first_corner[p + 1] - first};
  }
};

/// The field, if it is one of the scene (S11.1).
/// Errors: kOutOfRange, kNotFinite, kNotTriangle.
Result<ScalarField> make_scalars(const Scene& scene, ScalarField field);

/// What is outside of a scale, and how it looks.
struct ScaleLimits {
  double low = 0;
  double high = 0;
  Rgb color;
  friend bool operator==(const ScaleLimits&, const ScaleLimits&) = default;
};

/// Colours for numbers (S11.3).
///
/// Shape: steps are finite, each above the one before and within the limits;
///        there is one colour more.
struct ColorScale {
  std::vector<double> steps;
  std::vector<Rgb> colors = {{255, 255, 255}};
  std::optional<ScaleLimits> limits = std::nullopt;  ///< nothing: none
  Rgb no_data = {160, 160, 160};
  friend bool operator==(const ColorScale&, const ColorScale&) = default;
};

/// Whether the scale has its shape.
bool is_valid(const ColorScale& scale);

}  // namespace halfspace
