#pragma once

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

}  // namespace halfspace
