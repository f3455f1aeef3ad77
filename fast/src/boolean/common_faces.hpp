#pragma once

#include "intersect/operand.hpp"

namespace halfspace::fast {

/// Whether that is looked for: not in a module for the web, of whose size it is
/// some kilobytes.
#if defined(__wasm__)
constexpr bool kFindsCommonFaces = false;
#else
constexpr bool kFindsCommonFaces = true;
#endif

/// Finds the faces that both operands have, edge by edge, one way round or the
/// other, and near which either has nothing but such faces: Operand::common.
///
/// Such a face bounds the result as a whole or not at all, and no edge of any
/// face ends within it, so it need not be intersected. At its edges there may
/// be faces that both have but which are near others: each of these stands
/// beside its like, which is all that its edges there ask for.
///
/// Requires: prepare().
/// Cost:     a look at each face, unless planes are in common.
void find_common_faces(Operand& a, Operand& b, BooleanScratch& scratch);

}  // namespace halfspace::fast
