#pragma once

#include <cstdint>
#include <optional>

#include "halfspace/moving.hpp"
#include "halfspace/scene_file.hpp"

namespace halfspace::generate {

/// A world of moving objects (S12), and where they stand.
struct MovingView {
  Assembly assembly;
  Pose pose;
  Placement placement;
  /// The view's, or one that looks at the first object from a point of the
  /// grid.
  Camera camera;
};

/// The polygons of a view as a world with two objects, one of them in the other
/// and, where there is room, in the world too: moved so that corners meet
/// corners. Maps are shifts, exchanges of axes, reflections, small and large
/// fractions, up to the limits of S12.2. Regions are boxes, tetrahedra and
/// parallelepipeds, and may hold polygons of their owners. Nothing where the
/// numbers do not fit.
std::optional<MovingView> moving_view(const SceneFile& view,
                                      std::uint64_t seed);

/// The same of whole connected parts (S10.6) that are not divided: where the
/// scene is closed so are all models, and where polygons of an owner reach into
/// a region it has none.
std::optional<MovingView> moving_parts(const SceneFile& view,
                                       std::uint64_t seed);

}  // namespace halfspace::generate
