#pragma once

#include <cstdint>
#include <vector>

#include "halfspace/clip.hpp"
#include "halfspace/scene_file.hpp"

/// Clip planes for a scene that was drawn.
namespace halfspace::generate {

/// `count` planes through corners or one step beside them, steep or along axes,
/// as make_clips() makes them; none where it refuses them. Which, `number`
/// says. Requires: the scene has vertices.
std::vector<ClipPlane> clip_planes(const Scene& scene, std::uint64_t number,
                                   std::uint64_t count);

}  // namespace halfspace::generate
