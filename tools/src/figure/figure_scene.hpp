#pragma once

#include <string>
#include <vector>

#include "cli/loading.hpp"
#include "figure/figures.hpp"

namespace halfspace::tools {

/// The files as one scene, each exact if a grid holds all.
///
/// A mesh without faces has no polygons.
/// Errors: those of io::load_scene(); kUnknownFormat: a .scene beside others.
Result<FigureScene> load_figure(const std::vector<std::string>& paths,
                                const io::ImportOptions& options);

}  // namespace halfspace::tools
