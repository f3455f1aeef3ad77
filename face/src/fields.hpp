#pragma once

#include <vector>

#include "halfspace/csg/surface.hpp"
#include "halfspace/fast/to_mesh.hpp"
#include "node.hpp"

namespace halfspace::detail {

/// Gives the polygons of a mesh the properties of the operands' polygons that
/// they come from: colours and materials as they are; fields as the affine
/// function over the operand's polygon, exactly, rounded once.
///
/// `rounded` is the mesh as it came out, `solid` what it was made from.
void carry_properties(const Evaluation& evaluation, const fast::Solid& solid,
                      const fast::ExportedMesh& rounded, Mesh& mesh);

}  // namespace halfspace::detail
