#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "halfspace/result.hpp"
#include "halfspace/scene.hpp"
#include "papers/report.hpp"

namespace halfspace::bench {

/// A model of FAG83 that is made in code or read from a file.
struct Model {
  std::string name;
  Scene scene;
  /// The tree's polygons in FAG83 table 1 for 1, 3, 5 and 15 candidates; empty
  /// where the paper has no such model.
  std::vector<std::string> paper;
  /// FAG83 table 2: polygons in the tree, and frames in a second; empty where
  /// the paper has no such model.
  std::array<std::string, 2> paper_frames;
};

/// Klein bottle, three cubes, ribbon plot, three atoms, and the scans.
///
/// Errors: those of reading a file.
Result<std::vector<Model>> fag83_models(
    const std::vector<std::filesystem::path>& scans);

/// FAG83 table 1: polygons in the tree by number of candidates drawn.
Report fag83_table_1(const std::vector<Model>& models, const Effort& effort);

/// HEUR fig. 4 to 7: nodes and heights of trees by H-1 to H-6.
Report heur_figures(const Effort& effort);

/// F2B: "almost 10,000 polygons are created from the original 500".
Report f2b_tree_sizes(const Effort& effort);

}  // namespace halfspace::bench
