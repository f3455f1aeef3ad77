#pragma once

#include <optional>

#include "core/session.hpp"
#include "halfspace/camera.hpp"
#include "halfspace/image.hpp"
#include "halfspace/viewer/model.hpp"

namespace halfspace::viewer {

/// What is seen at a pixel; nothing at the background and off the image.
///
/// Exact: the polygon and its corner; the point is rounded.
std::optional<PickedPoint> picked(const Model& model, const Camera& camera,
                                  const ImageOptions& options, std::int32_t x,
                                  std::int32_t y);

/// A grid coordinate as a decimal, if it has no more than 40 digits, else as
/// the double next to it. Units: model units.
std::string decimal_text(std::int64_t coordinate, const Unit& unit);

}  // namespace halfspace::viewer
