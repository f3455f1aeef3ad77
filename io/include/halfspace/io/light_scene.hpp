#pragma once

#include <vector>

#include "halfspace/scene.hpp"

namespace halfspace::io {

/// The scene with the colours of its polygons lit by the directions in which
/// they face, as import lights those of surfaces without colours (S1.7).
///
/// `is_lit`: by polygon whether it stays as it is; empty: none does. Colours at
/// corners stay.
Scene lit_scene(const Scene& scene, const std::vector<bool>& is_lit);

}  // namespace halfspace::io
