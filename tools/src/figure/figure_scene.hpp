#pragma once

#include <string>
#include <vector>

#include "cli/loading.hpp"
#include "figure/figures.hpp"
#include "halfspace/scene_file.hpp"

namespace halfspace::tools {

/// The files as one scene, each exact if a grid holds all.
///
/// A mesh without faces has no polygons.
/// Errors: those of io::load_scene(); kUnknownFormat: a .scene beside others.
Result<FigureScene> load_figure(const std::vector<std::string>& paths,
                                const io::ImportOptions& options);

/// The figure of one file that was read.
FigureScene figure_of(const std::string& path, SceneFile file);

}  // namespace halfspace::tools
