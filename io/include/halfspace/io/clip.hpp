#pragma once

#include <array>

#include "halfspace/camera.hpp"
#include "halfspace/clip.hpp"
#include "halfspace/io/number.hpp"
#include "halfspace/result.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::io {

/// The clip plane that keeps what has a x + b y + c z + d >= 0 in model units,
/// from a, b, c and d (S10.1).
///
/// Exact:  yes, where the integers that it takes fit the plane's bits; else the
///         four are rounded to the most bits that do.
/// Errors: kZeroArea (a, b and c are 0).
Result<ClipPlane> clip_plane(const Scene& scene,
                             const std::array<Number, 4>& numbers);

/// The clip plane that keeps what is nearer than `distance` along the direction
/// of view, from the eye or from the image plane of an orthographic view:
/// rounded once. Units: model units.
Result<ClipPlane> yon_plane(const Scene& scene, const Camera& camera,
                            double distance);

}  // namespace halfspace::io
