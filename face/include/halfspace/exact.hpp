#pragma once

/// Exact access beside the face: the fast library under the names that it and
/// the reference share, and the way there from a solid.
///
/// Link:  halfspace::fast too. The shared library shows the face alone.
/// Names: those of halfspace/fast/*.hpp; each stands in halfspace::ref, too,
///        with the same meaning (spec/), in exact rationals and plain code.
#include "halfspace/fast/boolean.hpp"
#include "halfspace/fast/build.hpp"
#include "halfspace/fast/predicate.hpp"
#include "halfspace/fast/render.hpp"
#include "halfspace/fast/scan.hpp"
#include "halfspace/fast/screen.hpp"
#include "halfspace/fast/solid.hpp"
#include "halfspace/fast/split.hpp"
#include "halfspace/fast/splitter.hpp"
#include "halfspace/fast/to_mesh.hpp"
#include "halfspace/fast/traverse.hpp"
#include "halfspace/fast/visible_map.hpp"
#include "halfspace/solid.hpp"

namespace halfspace::exact {

using namespace halfspace::fast;

/// What the solid comes to: faces, planes and vertices, exactly, on the grid of
/// all its operands; Face::part counts as Origin::operand does.
/// Errors: those of the solid.
Result<fast::Solid> solid_of(const halfspace::Solid& solid);

}  // namespace halfspace::exact
