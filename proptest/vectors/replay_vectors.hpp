#pragma once

#include <cstddef>

#include "scene_json.hpp"

namespace halfspace::vectors {

/// Each runs the vectors of one file on the reference and on the fast library
/// (booleans on what has them), and fails the current test for every
/// difference. Returns how many answers were compared.
std::size_t replay_merges(const Json& vectors);
std::size_t replay_splits(const Json& vectors);
std::size_t replay_traversals(const Json& vectors);
std::size_t replay_images(const Json& vectors);
std::size_t replay_booleans(const Json& vectors);

}  // namespace halfspace::vectors
