#pragma once

#include "halfspace/scene.hpp"

namespace halfspace::csg {

/// The scene's data with just those vertices that a polygon has, and without
/// corners' colours.
SceneData trimmed(const Scene& scene);

}  // namespace halfspace::csg
