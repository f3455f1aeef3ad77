#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "definition/definition.hpp"
#include "generate/generate.hpp"
#include "halfspace/scene_file.hpp"
#include "halfspace/splitmix.hpp"

/// Views with clip planes that aim at trouble (S10.1).
namespace halfspace {

/// A number of the definition that has its bits, else nothing.
inline std::optional<Int128> to_int128(const definition::Integer& value) {
  if (abs(value) >> 126 != 0) return std::nullopt;
  const definition::Integer size = abs(value);
  const auto high = static_cast<std::uint64_t>(size >> 64);
  const auto low = static_cast<std::uint64_t>(size & ~std::uint64_t{0});
  const Int128 result = (Int128{high} << 64) + low;
  return value < 0 ? -result : result;
}

/// A plane that polygons lie in, or touch, or that is any: by a number.
inline std::optional<ClipPlane> clip_plane_of(const Scene& scene,
                                              std::uint64_t number) {
  const auto count = static_cast<std::uint64_t>(scene.polygon_count());
  const auto id = static_cast<PolygonId>(mix(number) % count);
  const GridPoint& p = scene.point(scene.corners(id)[mix(number + 1) % 3]);
  const Int128 sign = number % 2 == 0 ? 1 : -1;
  switch (mix(number + 2) % 4) {
    case 0: {
      const definition::Plane own = definition::plane_of(scene, id);
      const auto a = to_int128(own.a), b = to_int128(own.b),
                 c = to_int128(own.c), d = to_int128(own.d);
      if (!a || !b || !c || !d) return std::nullopt;
      return ClipPlane{sign * *a, sign * *b, sign * *c, sign * *d};
    }
    case 1:
      return ClipPlane{sign, 0, 0, -sign * p.x};
    case 2:
      return ClipPlane{0, 2 * sign, 0, -sign * (2 * Int128{p.y} + 1)};
    default:
      return ClipPlane{
          sign, -2 * sign, 3 * sign,
          -sign * (Int128{p.x} - 2 * Int128{p.y} + 3 * Int128{p.z})};
  }
}

/// One to three planes, by the seed.
inline std::vector<ClipPlane> clips_of(const SceneFile& view,
                                       std::uint64_t seed) {
  std::vector<ClipPlane> planes;
  if (view.scene.polygon_count() == 0) return planes;
  const auto count = 1 + mix(seed) % 3;
  for (std::uint64_t k = 0; k < count; ++k) {
    if (const auto plane = clip_plane_of(view.scene, mix(seed + k)))
      planes.push_back(*plane);
  }
  const auto made = make_clips(planes, view.scene.grid_bits());
  return made ? *made : std::vector<ClipPlane>();
}

/// A number that the view's vertices give.
inline std::uint64_t seed_of(const SceneFile& view) {
  std::uint64_t seed = view.scene.data().vertices.size();
  for (const GridPoint& p : view.scene.data().vertices) {
    seed = mix(seed + static_cast<std::uint64_t>(p.x + 3 * p.y + 7 * p.z));
  }
  return seed;
}

/// The view with clip planes, or as it is where a saved one has them.
inline SceneFile clipped(const SceneFile& view) {
  SceneFile result = view;
  if (result.options.clips.empty())
    result.options.clips = clips_of(view, seed_of(view));
  return result;
}

/// Closed scenes: boxes within boxes, cubes that touch, and soups.
inline generate::Views closed_views() {
  return rc::gen::oneOf(generate::nested_solids(), generate::touching_solids());
}

}  // namespace halfspace
