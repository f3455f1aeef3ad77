#include "halfspace/panorama.hpp"

#include <cstddef>

namespace halfspace {

Result<std::array<Camera, 6>> panorama(const LatticeVector& eye,
                                       int grid_bits) {
  constexpr Int128 kStep = Int128{1} << kLatticeBits;
  constexpr Int128 LatticeVector::*kAxes[3] = {
      &LatticeVector::x, &LatticeVector::y, &LatticeVector::z};
  std::array<Camera, 6> cameras;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto across = kAxes[(k + 1) % 3];
    const auto down = kAxes[(k + 2) % 3];
    for (const int side : {0, 1}) {
      CameraData data;
      data.eye = data.s0 = eye;
      data.s0.*kAxes[k] += side == 0 ? kStep : -kStep;
      data.s0.*across -= kStep;
      data.s0.*down -= kStep;
      data.sx.*across = kStep;
      data.sy.*down = kStep;
      data.width_px = data.height_px = 2;
      const Result<Camera> camera = make_camera(data, grid_bits);
      if (!camera) return camera.error();
      cameras[2 * k + static_cast<std::size_t>(side)] = *camera;
    }
  }
  return cameras;
}

}  // namespace halfspace
