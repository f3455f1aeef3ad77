#include "halfspace/clip.hpp"

#include <algorithm>
#include <string>

namespace halfspace {
namespace {

Int128 magnitude(Int128 value) { return value < 0 ? -value : value; }

Int128 common_divisor(Int128 a, Int128 b) {
  while (b != 0) {
    a %= b;
    std::swap(a, b);
  }
  return a;
}

/// The plane without what its numbers share.
/// Requires: the normal is not zero.
ClipPlane reduced(const ClipPlane& plane) {
  Int128 divisor = 0;
  for (const Int128 value : {plane.a, plane.b, plane.c, plane.d})
    divisor = common_divisor(divisor, magnitude(value));
  return {plane.a / divisor, plane.b / divisor, plane.c / divisor,
          plane.d / divisor};
}

std::optional<Error> fault_of(const ClipPlane& plane, int grid_bits,
                              std::int64_t index) {
  if (plane.a == 0 && plane.b == 0 && plane.c == 0) {
    return Error{ErrorCode::kZeroArea,
                 "clip plane " + std::to_string(index) +
                     " has a normal that is zero, which is no plane",
                 index};
  }
  const Int128 normal = Int128{1} << (2 * grid_bits + 1);
  const Int128 offset = Int128{1} << std::min(3 * grid_bits + 3, 126);
  if (std::max({magnitude(plane.a), magnitude(plane.b), magnitude(plane.c)}) <=
          normal &&
      magnitude(plane.d) <= offset) {
    return std::nullopt;
  }
  return Error{ErrorCode::kOutOfRange,
               "clip plane " + std::to_string(index) +
                   " has a number beyond its bits: " +
                   std::to_string(2 * grid_bits + 1) + " of a normal, " +
                   std::to_string(std::min(3 * grid_bits + 3, 126)) +
                   " of an offset",
               index};
}

}  // namespace

Result<std::vector<ClipPlane>> make_clips(const std::vector<ClipPlane>& planes,
                                          int grid_bits) {
  std::vector<ClipPlane> result;
  for (std::size_t k = 0; k < planes.size(); ++k) {
    const auto index = static_cast<std::int64_t>(k);
    if (const auto fault = fault_of(planes[k], grid_bits, index)) return *fault;
    const ClipPlane plane = reduced(planes[k]);
    if (std::find(result.begin(), result.end(), plane) != result.end())
      continue;
    if (result.size() == kMostClipPlanes) {
      return Error{ErrorCode::kOutOfRange,
                   "an image has at most 8 clip planes, and this is one more",
                   index};
    }
    result.push_back(plane);
  }
  return result;
}

}  // namespace halfspace
