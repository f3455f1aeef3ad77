#pragma once

#include <array>
#include <optional>

#include "halfspace/camera.hpp"
#include "halfspace/polygon.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::fast {

/// The colour of a triangle in Gouraud shading as a function of the image point
/// (x, y): a channel, from 0 to 255, is the quotient of its form and the last
/// one, each `form[0] x + form[1] y + form[2]` (S5.4). In parallel views the
/// last one is the same everywhere, so that the channels are affine.
struct ColorForms {
  std::array<std::array<double, 3>, 4> forms{};
};

/// The forms of a polygon, the last one positive where the polygon is seen, or
/// nothing if it has one colour all over.
///
/// Requires: the polygon's plane does not hold the eye.
/// Exact:    each number is a double within an ulp of the exact one, all four
///           forms being multiplied by one power of two.
std::optional<ColorForms> color_forms(const Scene& scene, const Camera& camera,
                                      PolygonId polygon);

}  // namespace halfspace::fast
