#pragma once

#include "halfspace/csg/outcome.hpp"
#include "halfspace/fast/solid.hpp"
#include "node.hpp"

namespace halfspace::detail {

/// The solid as its file has it (F7): the bytes of the program. By face where
/// it comes from: a use of the evaluation, or after those a cut. The module for
/// the web has another function of this name (decision 0029).
/// Requires: the solid is the evaluation's, and bounded.
csg::FileSolid for_file(const Evaluation& evaluation, fast::Solid solid);

}  // namespace halfspace::detail
