#pragma once

#include <string>
#include <vector>

#include "cli/loading.hpp"
#include "figure/figures.hpp"

namespace halfspace::tools {

/// The files as one scene, each exact if a grid holds all.
///
/// A mesh without faces has no polygons.
/// With scalars it is one file, and polygons of one number have its colour.
/// Errors: those of io::load_scene() and load_scalars(); kUnknownFormat: a
///         .scene beside others.
Result<FigureScene> load_figure(const std::vector<std::string>& paths,
                                const io::ImportOptions& options,
                                const ScalarArguments& scalars = {});

}  // namespace halfspace::tools
