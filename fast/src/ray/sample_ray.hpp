#pragma once

#include <cstdint>
#include <optional>

#include "camera/clip_function.hpp"
#include "halfspace/image.hpp"
#include "ray/ray_line.hpp"

namespace halfspace::fast {

/// The ray through a pixel's centre, in halves of lattice steps: exact, and
/// infinitely near the sample's (S4.4).
inline RayLine ray_of_centre(const CameraData& camera, std::int32_t i,
                             std::int32_t j, int grid_bits) {
  const auto at = [&](Int128 s0, Int128 sx, Int128 sy) {
    return 2 * s0 + (2 * Int128{i} + 1) * sx + (2 * Int128{j} + 1) * sy;
  };
  const LatticeVector s = {at(camera.s0.x, camera.sx.x, camera.sy.x),
                           at(camera.s0.y, camera.sx.y, camera.sy.y),
                           at(camera.s0.z, camera.sx.z, camera.sy.z)};
  const LatticeVector e = {2 * camera.eye.x, 2 * camera.eye.y,
                           2 * camera.eye.z};
  constexpr int kShift = kLatticeBits + 1;
  if (camera.perspective) {
    return RayLine(e, {s.x - e.x, s.y - e.y, s.z - e.z}, Reach::kRay, kShift,
                   grid_bits);
  }
  return RayLine(s, {-e.x, -e.y, -e.z}, Reach::kLine, kShift, grid_bits);
}

/// What is seen at one sample (S4.5, S5.3): polygons are offered one by one.
template <int kBits>
class SampleRay {
 public:
  SampleRay(const TreeReader& reader, const CameraData& camera,
            const ImageOptions& options, std::int32_t i, std::int32_t j)
      : reader_(reader), camera_(camera), options_(options), i_(i), j_(j) {}

  PolygonId seen() const { return seen_; }

  void offer(PolygonId polygon) {
    if (polygon == seen_) return;
    const ProjectedPlane<kBits> plane =
        projected(reader_.planes().template exact<kBits>(polygon), camera_);
    const int side = sign(plane.eye);
    if (side == 0 || (options_.cull && side < 0)) return;
    if (!is_in_front(plane, side, polygon)) return;
    if (!covers(polygon, plane, side)) return;
    seen_ = polygon;
    plane_ = plane;
    side_ = side;
  }

 private:
  /// Of what is seen so far; P(e) Q(s) - Q(e) P(s) tells for eyes on positive
  /// sides.
  bool is_in_front(const ProjectedPlane<kBits>& plane, int side,
                   PolygonId polygon) const {
    if (seen_ == kBackground) return true;
    const int order =
        side * side_ *
        meet_function<kBits>(plane, plane_).sign_at_sample(i_, j_);
    return order != 0 ? order > 0 : polygon < seen_;
  }

  bool covers(PolygonId polygon, const ProjectedPlane<kBits>& plane,
              int side) const {
    const auto count =
        static_cast<std::int32_t>(reader_.scene().corners(polygon).size());
    for (std::int32_t k = 0; k < count; ++k) {
      const auto ends = reader_.planes().source_edge(polygon, k);
      if (side *
              edge_function(ends[0], ends[1], camera_).sign_at_sample(i_, j_) <=
          0)
        return false;
    }
    for (const ClipPlane& clip : options_.clips) {
      const auto line =
          meet_function<kBits>(plane, projected<kBits>(clip, camera_));
      // A polygon in the clip plane stays.
      if (!is_zero(line) && side * line.sign_at_sample(i_, j_) <= 0)
        return false;
    }
    if (!camera_.near) return true;
    return side *
               near_function<kBits>(plane, *camera_.near, camera_.perspective)
                   .sign_at_sample(i_, j_) >
           0;
  }

  const TreeReader& reader_;
  const CameraData& camera_;
  const ImageOptions& options_;
  std::int32_t i_;
  std::int32_t j_;
  PolygonId seen_ = kBackground;
  ProjectedPlane<kBits> plane_;
  int side_ = 0;
};

}  // namespace halfspace::fast
