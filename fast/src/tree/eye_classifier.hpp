#pragma once

#include "camera/moved_camera.hpp"
#include "camera/view.hpp"
#include "halfspace/fast/build.hpp"
#include "tree/tree_reader.hpp"

namespace halfspace::fast {

/// Decides on which side of a tree's planes the eye is.
class EyeClassifier {
 public:
  EyeClassifier(const TreeReader& reader, const View& view,
                const CameraData& camera, FilterStats& stats,
                const MovedCamera* moved = nullptr)
      : reader_(reader),
        view_(view),
        camera_(camera),
        moved_(moved),
        stats_(stats) {}

  int operator()(const Plane& plane, PlaneId id) const {
    const int known = filtered_sign(view_.eye_value(plane));
    if (known != 0) {
      ++stats_.filtered;
      return known;
    }
    ++stats_.exact;
    const int decided = exact(id);
    stats_.zero += decided == 0 ? 1 : 0;
    return decided;
  }

 private:
  int exact(PlaneId id) const;

  const TreeReader& reader_;
  const View& view_;
  const CameraData& camera_;
  const MovedCamera* moved_;  ///< in the frame of an object, or null
  FilterStats& stats_;
};

}  // namespace halfspace::fast
