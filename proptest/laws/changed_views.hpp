#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <utility>

#include "adapters/answers.hpp"
#include "halfspace/bsp_tree.hpp"
#include "halfspace/scene_file.hpp"

/// Pictures of views, and of views with something changed.
namespace halfspace {

/// The picture of a view by the tree of these options.
template <class Impl>
Image picture(const SceneFile& view, const BuildOptions& options = {}) {
  return Impl::render(view.scene, Impl::build(view.scene, options),
                      *view.camera, view.options);
}

inline SceneFile with_camera(const SceneFile& view, const CameraData& camera) {
  SceneFile changed = view;
  changed.camera = *make_camera(camera, view.scene.grid_bits());
  return changed;
}

inline SceneFile with_scene(const SceneFile& view, Scene scene) {
  SceneFile changed = view;
  changed.scene = std::move(scene);
  return changed;
}

/// Corner colours on all polygons, which differ on triangles.
inline SceneFile with_corner_colors(const SceneFile& view) {
  SceneData data = view.scene.data();
  data.corner_colors.assign(data.corners.size(), {});
  for (std::size_t p = 0; p + 1 < data.first_corner.size(); ++p) {
    const std::size_t first = data.first_corner[p];
    const std::size_t count = data.first_corner[p + 1] - first;
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t c = count == 3 ? k : 0;
      data.corner_colors[first + k] = {
          static_cast<std::uint8_t>(c == 0 ? 255 : 17 * p),
          static_cast<std::uint8_t>(c == 1 ? 0 : 100 + c + p),
          static_cast<std::uint8_t>(c == 2 ? 3 : 2)};
    }
  }
  return with_scene(view, *make_scene(std::move(data)));
}

/// The view with a pixel for each of the `k` by `k` samples of a pixel: all
/// scaled by `k` but the steps from pixel to pixel, and so many times as large;
/// nothing where the scene or the camera has no room.
inline std::optional<SceneFile> magnified(const SceneFile& view,
                                          std::int32_t k) {
  SceneData scene = view.scene.data();
  const std::int64_t room = (std::int64_t{1} << 53) / k;
  for (GridPoint& p : scene.vertices) {
    if (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) >= room)
      return std::nullopt;
    p = {k * p.x, k * p.y, k * p.z};
  }
  scene.grid_bits = std::max(scene.grid_bits, grid_bits_for(scene.vertices));
  CameraData camera = view.camera->data();
  for (LatticeVector* v : {&camera.eye, &camera.s0})
    *v = {k * v->x, k * v->y, k * v->z};
  camera.width_px *= k;
  camera.height_px *= k;
  const Result<Camera> made = make_camera(camera, scene.grid_bits);
  if (!made) return std::nullopt;
  SceneFile result = with_scene(view, *make_scene(std::move(scene)));
  result.camera = *made;
  return result;
}

}  // namespace halfspace
