#pragma once

#include <string>

#include "figure/figures.hpp"
#include "halfspace/io/load_scene.hpp"
#include "halfspace/result.hpp"
#include "image/scalars.hpp"

namespace halfspace::tools {

/// A file whose colours show numbers: polygons of one number have its colour.
///
/// It stands apart from load_figure(), which is linked where there is no
/// command line, too.
/// Requires: the arguments name a source.
/// Errors: those of io::load_scene(), kEmpty for a mesh without faces, too, and
///         those of load_scalars().
Result<FigureScene> load_scalar_figure(const std::string& path,
                                       const io::ImportOptions& options,
                                       const ScalarArguments& scalars);

}  // namespace halfspace::tools
