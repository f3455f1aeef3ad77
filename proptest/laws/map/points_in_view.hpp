#pragma once

#include <algorithm>
#include <cstddef>

#include "halfspace/ray.hpp"
#include "halfspace/ref/predicate.hpp"
#include "halfspace/ref/projection.hpp"
#include "halfspace/scene_file.hpp"
#include "laws/law.hpp"

/// Given points of drawings, and their ways to the eye (S9.7).
namespace halfspace {

/// Whether a point is beyond the near distance and its image in the rectangle.
inline bool is_in_view(const ref::Projection& projection, const GridPoint& p) {
  for (std::size_t v = 0; v < projection.view_volume.size(); ++v) {
    const int side =
        sign(value_at(projection.view_volume[v], ref::to_point(p)));
    const bool is_near = v == 0 && projection.view_volume.size() == 5;
    if (is_near ? side <= 0 : side < 0) return false;
  }
  return true;
}

/// The ray from a point to the eye, or in a parallel view beyond the scene.
inline Ray ray_to_eye(const SceneFile& view, const GridPoint& p) {
  const CameraData& camera = view.camera->data();
  RayData data;
  const Int128 step = Int128{1} << kLatticeBits;
  data.origin = {step * p.x, step * p.y, step * p.z};
  data.reach = Reach::kBetween;
  data.direction = camera.eye;
  const auto size = [&] {
    Int128 most = 0;
    for (const Int128& c :
         {data.direction.x, data.direction.y, data.direction.z})
      most = std::max(most, c < 0 ? -c : c);
    return most;
  };
  if (camera.perspective) {
    data.direction = {camera.eye.x - data.origin.x,
                      camera.eye.y - data.origin.y,
                      camera.eye.z - data.origin.z};
  } else {
    const int most = view.scene.grid_bits() + 13;
    while (2 * size() <= Int128{1} << most) {
      data.direction = {2 * data.direction.x, 2 * data.direction.y,
                        2 * data.direction.z};
    }
  }
  const Result<Ray> ray = make_ray(data, view.scene.grid_bits());
  HALFSPACE_LAW(ray.has_value());
  return *ray;
}

}  // namespace halfspace
