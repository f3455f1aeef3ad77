#pragma once

#include <optional>
#include <string>

#include "halfspace/boolean.hpp"
#include "halfspace/io/import.hpp"
#include "halfspace/result.hpp"

namespace halfspace::tools {

/// Two solids on one grid, and what putting them there took.
struct Operands {
  Solid a;
  Solid b;
  io::ImportReport report;  ///< of both together
};

/// The solids in two files, meshes or scenes, on the grid that holds both:
/// whatever units they came in, exact wherever one grid can hold them.
///
/// Errors: those of reading and importing; kEmpty (no polygons); kNotClosed.
///         The message names the file.
Result<Operands> load_operands(const std::string& path_a,
                               const std::string& path_b,
                               std::optional<int> grid_bits);

}  // namespace halfspace::tools
