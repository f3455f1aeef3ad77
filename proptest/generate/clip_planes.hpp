#pragma once

#include <cstdint>
#include <vector>

#include "halfspace/clip.hpp"
#include "halfspace/scene_file.hpp"

/// Clip planes for a scene that was drawn, made of nothing but the scene.
namespace halfspace::generate {

/// A number that scenes with other corners seldom have.
std::uint64_t number_of(const Scene& scene);

/// `count` planes through corners or one step beside them, steep or along axes,
/// as make_clips() makes them; none where it refuses them.
/// Requires: the scene has vertices.
std::vector<ClipPlane> clip_planes(const Scene& scene, std::uint64_t count);

}  // namespace halfspace::generate
