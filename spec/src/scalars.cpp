#include "halfspace/scalars.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

namespace halfspace {
namespace {

/// Whether some value is missing, or all are equal.
bool is_plain(std::span<const double> values) {
  return std::any_of(values.begin(), values.end(),
                     [](double v) { return std::isnan(v); }) ||
         std::adjacent_find(values.begin(), values.end(),
                            std::not_equal_to<>()) == values.end();
}

}  // namespace

Result<ScalarField> make_scalars(const Scene& scene, ScalarField field) {
  const std::size_t wanted =
      field.at_corners ? scene.data().corners.size() : scene.polygon_count();
  if (field.values.size() != wanted) {
    return Error{ErrorCode::kOutOfRange,
                 "there are " + std::to_string(field.values.size()) +
                     " scalars for " + std::to_string(wanted) +
                     (field.at_corners ? " corners" : " polygons"),
                 static_cast<std::int64_t>(field.values.size())};
  }
  for (std::size_t k = 0; k < field.values.size(); ++k) {
    if (!std::isinf(field.values[k])) continue;
    return Error{ErrorCode::kNotFinite,
                 "scalar " + std::to_string(k) + " is infinite",
                 static_cast<std::int64_t>(k)};
  }
  if (!field.at_corners) return field;
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    const auto values = field.of(scene, static_cast<PolygonId>(p));
    if (values.size() == 3 || is_plain(values)) continue;
    return Error{ErrorCode::kNotTriangle,
                 "polygon " + std::to_string(p) +
                     " has different scalars at its corners and is no triangle",
                 static_cast<std::int64_t>(p)};
  }
  return field;
}

bool is_valid(const ColorScale& scale) {
  if (scale.colors.size() != scale.steps.size() + 1) return false;
  for (std::size_t k = 0; k < scale.steps.size(); ++k) {
    if (!std::isfinite(scale.steps[k])) return false;
    if (k > 0 && !(scale.steps[k - 1] < scale.steps[k])) return false;
  }
  if (!scale.limits) return true;
  const ScaleLimits& limits = *scale.limits;
  if (!std::isfinite(limits.low) || !std::isfinite(limits.high)) return false;
  return limits.low <= limits.high &&
         (scale.steps.empty() || (limits.low <= scale.steps.front() &&
                                  scale.steps.back() <= limits.high));
}

}  // namespace halfspace
