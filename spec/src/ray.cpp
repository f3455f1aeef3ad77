#include "halfspace/ray.hpp"

namespace halfspace {

Result<Ray> make_ray(const RayData& data, int grid_bits) {
  const Int128 limit = Int128{1}
                       << (grid_bits - 1 + kLatticeBits + kCameraRangeBits);
  for (const LatticeVector& v : {data.origin, data.direction}) {
    for (const Int128 component : {v.x, v.y, v.z}) {
      if (-limit <= component && component <= limit) continue;
      return Error{ErrorCode::kOutOfRange,
                   "a ray reaches farther than 64 times the range of the grid"};
    }
  }
  if (data.direction == LatticeVector{}) {
    return Error{ErrorCode::kBadRay,
                 "a ray goes nowhere: its direction is zero, or its two points "
                 "are one"};
  }
  Ray ray;
  ray.data_ = data;
  return ray;
}

}  // namespace halfspace
