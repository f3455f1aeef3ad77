#pragma once

#include <array>

#include "halfspace/camera.hpp"
#include "halfspace/result.hpp"

namespace halfspace {

/// The panorama of an eye (S7.7): six cameras whose images are the faces of a
/// cube round it, so that every direction is seen in one of them.
///
/// Exact:  yes.
/// Errors: those of make_camera().
Result<std::array<Camera, 6>> panorama(const LatticeVector& eye, int grid_bits);

}  // namespace halfspace
