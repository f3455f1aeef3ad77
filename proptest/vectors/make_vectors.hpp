#pragma once

#include "scene_json.hpp"

namespace halfspace::vectors {

/// The vectors of spec/vectors/, by the tests' own definition of S1 to S6: no
/// implementation has a part in what they say. Always the same.
Json merge_vectors();
Json split_vectors();
Json traversal_vectors();
Json image_vectors();
Json boolean_vectors();

}  // namespace halfspace::vectors
