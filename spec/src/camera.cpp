#include "halfspace/camera.hpp"

#include <boost/multiprecision/cpp_int.hpp>

namespace halfspace {
namespace {

using Int256 = boost::multiprecision::int256_t;

/// The largest size of a near distance: 2^16 ray parameters (S4.3).
constexpr std::int64_t kNearMax = std::int64_t{1} << 32;

Int256 wide(Int128 value) { return Int256(value); }

/// The determinant of three vectors. Components of camera differences have at
/// most 69 bits, so this has at most 3 * 69 + 3 = 210.
Int256 determinant(const LatticeVector& u, const LatticeVector& v,
                   const LatticeVector& w) {
  return wide(u.x) * (wide(v.y) * wide(w.z) - wide(v.z) * wide(w.y)) -
         wide(u.y) * (wide(v.x) * wide(w.z) - wide(v.z) * wide(w.x)) +
         wide(u.z) * (wide(v.x) * wide(w.y) - wide(v.y) * wide(w.x));
}

bool in_range(const LatticeVector& v, Int128 limit) {
  for (const Int128 c : {v.x, v.y, v.z}) {
    if (c < -limit || c > limit) return false;
  }
  return true;
}

}  // namespace

Result<Camera> make_camera(const CameraData& data, int grid_bits) {
  const Int128 limit = Int128{1}
                       << (grid_bits - 1 + kLatticeBits + kCameraRangeBits);
  const struct {
    const char* name;
    const LatticeVector& vector;
  } parts[] = {
      {"eye", data.eye}, {"s0", data.s0}, {"sx", data.sx}, {"sy", data.sy}};
  for (const auto& [name, vector] : parts) {
    if (in_range(vector, limit)) continue;
    return Error{ErrorCode::kOutOfRange, std::string("the camera's ") + name +
                                             " has a component beyond " +
                                             to_string(limit)};
  }
  for (const std::int32_t size : {data.width_px, data.height_px}) {
    if (size >= 1 && size <= kMaxImageSize) continue;
    return Error{ErrorCode::kOutOfRange,
                 "an image has 1 to 65536 columns and rows, not " +
                     std::to_string(size)};
  }
  if (data.near) {
    const std::int64_t least = data.perspective ? 0 : -kNearMax;
    if (*data.near < least || *data.near > kNearMax) {
      return Error{ErrorCode::kOutOfRange,
                   "the near distance is from " + std::to_string(least) +
                       " to " + std::to_string(kNearMax) + ", not " +
                       std::to_string(*data.near)};
    }
  }
  LatticeVector depth = data.eye;
  if (data.perspective) {
    depth = {data.s0.x - data.eye.x, data.s0.y - data.eye.y,
             data.s0.z - data.eye.z};
  }
  if (determinant(data.sx, data.sy, depth) == 0) {
    return Error{ErrorCode::kBadCamera,
                 data.perspective
                     ? "the camera's image plane passes through its eye, or "
                       "is no plane"
                     : "the camera looks along its image plane, or that is no "
                       "plane"};
  }
  Camera camera;
  camera.data_ = data;
  return camera;
}

}  // namespace halfspace
