#pragma once

#include <cstdint>

#include "halfspace/fast/to_mesh.hpp"
#include "node.hpp"

namespace halfspace::detail {

/// How the values of fields are decided: by doubles with bounds, and exactly
/// only where those do not tell; or exactly always. The values are the same.
enum class FieldPath : std::uint8_t { kFiltered, kExact };

/// Gives the polygons of a mesh the origins and properties of the operands'
/// polygons that they come from: colours and materials as they are; fields as
/// the affine function over the operand's polygon, exactly, rounded once.
///
/// `rounded` is the mesh as it came out, `solid` what it was made from.
void carry_properties(const Evaluation& evaluation, const fast::Solid& solid,
                      const fast::ExportedMesh& rounded, Mesh& mesh,
                      FieldPath path = FieldPath::kFiltered);

}  // namespace halfspace::detail
