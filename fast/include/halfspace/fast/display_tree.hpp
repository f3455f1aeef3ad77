#pragma once

#include <cstddef>

#include "halfspace/fast/build.hpp"

namespace halfspace::fast {

/// The options of build_display_tree().
struct DisplayTreeOptions {
  /// Lists of up to this many fragments are not divided, unless they overdraw
  /// much. Longer ones are divided where that lowers the cost.
  std::size_t leaf_size = 512;
  /// The cost of a cut, in fragments that a ray meets: a greater weight makes
  /// the tree smaller and its leaves longer.
  double cut_weight = 2;
  /// The number of cuts that the tree may make for each polygon, about, beyond
  /// the first 100,000. Leaves get longer where it is used up. Bounds memory.
  double most_cuts = 4;
  /// The number of polygons whose planes are tried where no plane across an
  /// axis divides well; 0 for none.
  std::size_t own_planes = 8;
  int threads = 0;  ///< 0: as many as the machine has
  Progress progress = {};
};

/// A tree for displaying the scene (S3.1, S3.7) with few cuts and large leaves.
/// Any tree gives the same image. docs/display-tree.md explains the algorithm.
///
/// Splitters are planes across an axis (free planes) and, where those would cut
/// too much, planes of polygons. They are chosen by the surface area heuristic
/// (GS87, MB90; for BSP trees NAY93). Fragments that lie in a splitter belong
/// to its node, in id order. Those of a leaf, triangles first, then
/// quadrangles, are ordered by depth when they are drawn (S5.3).
///
/// Shape:    the tree with boxes and blocks; no nodes if `progress` stopped it.
/// Requires: options.leaf_size >= 1; options.threads >= 0.
/// Exact:    yes: planes are chosen by floats, sides decided exactly.
/// Cost:     n log n; no recursion. The same tree for any number of threads.
BspTree build_display_tree(const Scene& scene,
                           const DisplayTreeOptions& options = {});
BspTree build_display_tree(const Scene& scene,
                           const DisplayTreeOptions& options,
                           FilterStats& stats);

/// The memory of a tree by array. Units: bytes.
struct TreeBytes {
  std::size_t nodes = 0;
  std::size_t boxes = 0;
  std::size_t fragments = 0;
  std::size_t corners = 0;
  std::size_t cut_vertices = 0;
  std::size_t free_planes = 0;
  std::size_t blocks = 0;

  std::size_t total() const {
    return nodes + boxes + fragments + corners + cut_vertices + free_planes +
           blocks;
  }
  friend bool operator==(const TreeBytes&, const TreeBytes&) = default;
};

TreeBytes bytes_by_array(const BspTree& tree);

/// The memory of a tree in all. Units: bytes.
std::size_t bytes_of(const BspTree& tree);

}  // namespace halfspace::fast
