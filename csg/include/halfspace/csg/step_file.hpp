#pragma once

#include <filesystem>
#include <string>

#include "halfspace/result.hpp"
#include "halfspace/solid_file.hpp"

namespace halfspace::csg {

/// Whether the name ends in `.step` or `.stp`, perhaps with `.gz` after it.
bool is_step_name(const std::filesystem::path& path);

/// The solid as a STEP file (ISO 10303-21, of AP203): a manifold solid for each
/// connected part of its interior, with its cavities; planar faces with holes,
/// straight edges, each named once by the two faces that share it. `name` is
/// the product's.
///
/// Units: the solid's are written as millimetres.
/// Exact: points, and directions of planes and lines, are the nearest doubles;
///        what meets where is the solid's.
/// Errors: those of fast::to_solid(); kEmpty (there is no face).
Result<std::string> step_text(const SolidData& data, const std::string& name);

}  // namespace halfspace::csg
