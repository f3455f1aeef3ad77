#pragma once

#include "camera/view.hpp"

namespace halfspace::fast {

/// An image plane that is not square, so far from the eye.
inline CameraData skew_camera(int steps) {
  CameraData camera;
  camera.eye = {0, 0, -steps * 256};
  camera.s0 = {-4 * 256, -4 * 256, 0};
  camera.sx = {200, 60, 30};
  camera.sy = {-50, 230, 10};
  camera.width_px = camera.height_px = 8;
  return camera;
}

/// The same vertex, moved to a corner of the cube around it: way 0 to 7.
inline Vertex moved(Vertex v, int way) {
  v.x += (way & 1) != 0 ? v.error : -v.error;
  v.y += (way & 2) != 0 ? v.error : -v.error;
  v.z += (way & 4) != 0 ? v.error : -v.error;
  return v;
}

}  // namespace halfspace::fast
