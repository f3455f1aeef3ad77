#pragma once

#include "camera/view.hpp"
#include "halfspace/fast/build.hpp"
#include "tree/tree_reader.hpp"

namespace halfspace::fast {

/// Decides which sides of planes no ray of the image meets (S3.10).
class BehindTest {
 public:
  BehindTest(const TreeReader& reader, const View& view,
             const CameraData& camera)
      : reader_(reader), view_(view), camera_(camera) {}

  /// Whether the open half-space on side `side` of the plane is behind, the eye
  /// being on side `eye_sign`.
  bool operator()(const Plane& plane, PlaneId id, int eye_sign,
                  int side) const {
    if (view_.perspective ? eye_sign == side : eye_sign != 0) return false;
    return is_behind(plane, id, side);
  }

 private:
  bool is_behind(const Plane& plane, PlaneId id, int side) const;
  int exact_sign(PlaneId id, int right, int bottom) const;

  const TreeReader& reader_;
  const View& view_;
  const CameraData& camera_;
};

}  // namespace halfspace::fast
