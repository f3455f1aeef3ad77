#pragma once

#include <cstdint>
#include <filesystem>

#include "booleans/cases.hpp"
#include "halfspace/result.hpp"

namespace halfspace::bench {

/// The triangles in a file, its coordinates as floats, on a grid that holds all
/// but the least of those.
/// Errors: those of reading; kTooManyVertices (a face is not a triangle).
Result<Triangles> read_triangles(const std::filesystem::path& path);

/// The union of the triangles with themselves moved: by a tenth of their size;
/// or, where `turn` is not 0, turned by it about their middle. The seed chooses
/// the direction. Units: radians.
BooleanCase mesh_pair(const std::filesystem::path& path, const Triangles& mesh,
                      double turn, std::uint64_t seed);

}  // namespace halfspace::bench
