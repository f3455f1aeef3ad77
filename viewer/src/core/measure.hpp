#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "halfspace/io/view.hpp"
#include "halfspace/viewer/model.hpp"

namespace halfspace::viewer {

/// Where a point is in the image, to within a pixel's fraction; nothing behind
/// the eye. Units: pixels, y downwards.
std::optional<glm::dvec2> projected(const io::ViewOptions& camera,
                                    const glm::dvec3& point);

/// The angle at `apex` between two points, in degrees; 0 where a side has no
/// length.
double angle_deg(const glm::dvec3& a, const glm::dvec3& apex,
                 const glm::dvec3& b);

/// The area of the triangle of three points.
double triangle_area(const glm::dvec3& a, const glm::dvec3& b,
                     const glm::dvec3& c);

/// The number with six digits: planes of short numbers fit the grids of all
/// files, and people read them.
double six_digits(double value);

/// The volume and the area, in full where they are rational, and the box of
/// what the state's visible parts are together, or of what the boolean makes of
/// them: a line each.
/// Errors: those of Solid; kStopped.
Result<std::string> measures_of(const State& state, const Report& report);

}  // namespace halfspace::viewer
