#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "halfspace/csg/matrix.hpp"
#include "halfspace/csg/operands.hpp"
#include "halfspace/csg/outcome.hpp"
#include "halfspace/csg/plan.hpp"
#include "halfspace/io/attributes.hpp"

namespace halfspace::csg {

/// An operand as a source of attributes.
struct AttributedLeaf {
  /// Its file's faces before they are moved; null where nothing is said of
  /// them.
  const io::AttributedFaces* faces = nullptr;
  Matrix matrix;
  std::string name = {};  ///< in files that say where polygons come from
};

/// The operands of a result: leaves as Origin::leaf counts, then planes.
struct AttributedLeaves {
  std::vector<AttributedLeaf> leaves;
  std::size_t planes = 0;
  double max_move = 0;  ///< of their points by rounding; model units
};

/// Those of a plan.
AttributedLeaves attributed_leaves(const Plan& plan, const Operands& operands);

/// What the operands' files say of the faces that the result's polygons are
/// parts of (S6.9); null where they say nothing.
///
/// A polygon has the material, the names and the numbers of its face. A corner
/// that is no farther from a corner of the face than rounding moved points has
/// that corner's numbers; any other has those of the affine function over a
/// triangle of the face: of its fan from its first corner, that which holds the
/// corner, or else the first with an area. Normals are turned with the solid,
/// and round where the polygon's outside was the solid's inside; what fills a
/// hole beside a face, and so is in another plane, has none.
///
/// Where polygons of several faces became one (MergeRule::kColor and kPlane)
/// they have what the first has, and corners nothing.
/// Exact: in the corners' doubles, numbers are rounded once; normals of moved
///        solids are doubles.
/// Cost:  linear, but for corners that are new: of a face of n corners n each.
std::shared_ptr<const io::Attributes> carried_attributes(
    const AttributedLeaves& from, const Outcome& result,
    const EvaluateOptions& options);

}  // namespace halfspace::csg
