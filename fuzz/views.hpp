#pragma once

#include "fuzz.hpp"
#include "generate/shapes.hpp"
#include "generate/viewpoints.hpp"
#include "halfspace/bsp_tree.hpp"
#include "halfspace/clip.hpp"
#include "halfspace/scene_file.hpp"

/// What the bytes of a fuzzer mean to the generators of proptest/.
namespace halfspace::fuzz {

inline BuildOptions build_options_of(Bytes& bytes) {
  BuildOptions options;
  options.rule = static_cast<RootRule>(bytes.below(9));
  options.candidates = 1 + static_cast<std::uint32_t>(bytes.below(6));
  options.seed = bytes.next();
  return options;
}

/// From 1 on: mostly up to `few`, for what is small is tried often, but of
/// eight bytes one means up to `most`.
inline int size_of(Bytes& bytes, int few, int most) {
  const int byte = bytes.next();
  return 1 + byte % (byte < 224 ? few : most);
}

inline generate::ViewRecipe view_recipe_of(Bytes& bytes) {
  generate::ViewRecipe view;
  view.eye = static_cast<generate::EyeKind>(bytes.below(5));
  view.aim = static_cast<generate::AimKind>(bytes.below(5));
  view.near = static_cast<generate::NearKind>(bytes.below(3));
  const int flags = bytes.below(8);
  view.perspective = (flags & 1) == 0;
  view.cull = (flags & 2) != 0;
  view.gouraud = (flags & 4) != 0;
  view.other = bytes.below(24);
  view.edge = bytes.below(12);
  view.width_px = size_of(bytes, 6, 16);
  view.height_px = size_of(bytes, 4, 12);
  view.numbers = bytes.numbers(12);
  return view;
}

inline generate::SceneRecipe scene_recipe_of(Bytes& bytes) {
  generate::SceneRecipe scene;
  scene.stretch = static_cast<generate::Stretch>(bytes.below(4));
  const int more = bytes.next();
  scene.jitter = (more & 1) != 0;
  scene.corner_colors = (more & 2) != 0;
  const bool is_large = more >= 224;
  if (!is_large) scene.most_polygons = 12;
  while (!bytes.empty() && scene.shapes.size() < (is_large ? 10 : 4)) {
    const auto kind = static_cast<generate::ShapeKind>(bytes.below(12));
    const int other = bytes.below(24);
    scene.shapes.push_back({kind, other, bytes.numbers(9)});
  }
  return scene;
}

/// The camera, the scene and the options that the bytes mean.
inline SceneFile view_of(Bytes& bytes) {
  const generate::ViewRecipe view = view_recipe_of(bytes);
  return generate::make(generate::make(scene_recipe_of(bytes)), view);
}

/// The scene's text, written only where something is not so.
struct Shown {
  const SceneFile& view;
  explicit operator std::string() const { return write_scene(view); }
};

/// A clip plane through a corner, by a number.
inline ClipPlane plane_at_a_corner(const SceneFile& view, std::size_t number) {
  GridPoint p{};
  if (!view.scene.data().vertices.empty())
    p = view.scene.data().vertices[number % view.scene.data().vertices.size()];
  const auto normal = [&](std::size_t by) {
    return static_cast<std::int64_t>(number / by % 5) - 2;
  };
  const std::int64_t a = 2 * normal(1) + 1;
  const std::int64_t b = normal(5);
  const std::int64_t c = normal(25);
  return {a, b, c, -(Int128{a} * p.x + Int128{b} * p.y + Int128{c} * p.z)};
}

}  // namespace halfspace::fuzz
