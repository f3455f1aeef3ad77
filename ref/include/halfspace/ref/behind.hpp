#pragma once

#include "halfspace/camera.hpp"
#include "halfspace/ref/predicate.hpp"

namespace halfspace::ref {

/// Whether no ray of the image meets the open half-space on that side of the
/// plane (S3.10; FAQ).
///
/// Requires: side is not Side::kOn.
/// Exact:    yes.
bool is_behind(const Plane& plane, const Camera& camera, Side side);

}  // namespace halfspace::ref
