#pragma once

#include <cstdint>

#include "halfspace/camera.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::agree {

/// Numbers from a seed, the same on every machine.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : state_(seed) {}

  /// 64 random bits.
  std::uint64_t next();
  /// A number from `low` to `high`, both included.
  std::int64_t from_to(std::int64_t low, std::int64_t high);
  bool one_in(std::int64_t count) { return from_to(1, count) == 1; }

 private:
  std::uint64_t state_;
};

/// What a random scene is made to hurt with.
enum class Kind {
  kSmall,     ///< few grid points: shared vertices, edges and planes
  kFaces,     ///< faces of boxes, with straight corners and shared planes
  kWide,      ///< the whole range of the grid
  kSlivers,   ///< the whole range, nearly degenerate
  kParallel,  ///< parallel planes, a grid step apart or a few
  kFine,      ///< planes that nearly coincide, and nearly pass through corners
};
constexpr Kind kKinds[] = {Kind::kSmall,   Kind::kFaces,    Kind::kWide,
                           Kind::kSlivers, Kind::kParallel, Kind::kFine};
const char* name_of(Kind kind);

/// A random scene of `polygons` polygons, or a few fewer: what is not valid is
/// left out. Every polygon has corner colours where `corner_colors`.
Scene random_scene(Kind kind, int grid_bits, int polygons, Draws& draws,
                   bool corner_colors = false);

/// A random camera that looks at the scene of that kind, made to hurt: eyes on
/// planes, at corners and among the polygons, axes along the grid with pixel
/// centres on vertices, near distances within the scene.
Camera random_camera(Kind kind, const Scene& scene, std::int32_t width_px,
                     std::int32_t height_px, Draws& draws);

}  // namespace halfspace::agree
