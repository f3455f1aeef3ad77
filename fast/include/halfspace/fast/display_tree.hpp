#pragma once

#include <cstddef>

#include "halfspace/fast/build.hpp"

namespace halfspace::fast {

/// What a tree for display depends on beside the scene.
struct DisplayTreeOptions {
  /// Lists of so many fragments or fewer are not divided. Longer ones are where
  /// a plane pays: where none does, a leaf may be longer.
  std::size_t leaf_size = 512;
  /// What a cut costs, in fragments that a ray meets: more makes the tree
  /// smaller and its leaves longer.
  double cut_weight = 2;
  /// How many cuts the tree may make for each polygon, about, beyond the first
  /// 100,000: what would need more lies in longer leaves. Bounds the memory.
  double most_cuts = 4;
  /// How many polygons' own planes are tried where no plane across an axis
  /// divides well; 0 for none.
  std::size_t own_planes = 8;
  /// Threads to work with; 0 for as many as the machine has.
  int threads = 0;
  /// Called now and then, one call at a time, from any of the threads, with the
  /// share that is done, from 0 to 1. Where it returns false, the work stops.
  Progress progress;
};

/// A tree for displaying the scene (S3.1, S3.7) that divides it well with few
/// cuts: any tree gives the same image.
///
/// Its splitters are planes across an axis (free planes) and, where those would
/// cut too much, planes of polygons. Of the fragments on one side of a splitter
/// all are on that side. The fragments that lie in a splitter are its node's,
/// in id order; those of a leaf, triangles first, then quadrangles, hide each
/// other as their depths say (S5.3). Which plane divides is what a ray through
/// the box of a list has to pay for: fragments met, by the areas of the halves
/// (the surface area argument of Naylor 1993, MacDonald & Booth 1990).
///
/// Gives the tree, its boxes and blocks; no nodes if `progress` stopped it.
/// Requires: options.leaf_size >= 1; options.threads >= 0.
/// Exact:    yes: planes are chosen by floats, sides decided exactly.
/// Cost:     n log n; no recursion. The same tree for any number of threads.
BspTree build_display_tree(const Scene& scene,
                           const DisplayTreeOptions& options = {});
BspTree build_display_tree(const Scene& scene,
                           const DisplayTreeOptions& options,
                           FilterStats& stats);

/// Whether some node of the tree is a leaf: such a tree is for render() alone.
bool has_leaves(const BspTree& tree);

/// Makes every leaf a subtree whose splitters are planes of its fragments, so
/// that the tree can be walked back to front (S3.7), painted and inserted into.
///
/// The same tree for the same tree.
/// Exact: yes.
/// Cost:  for a leaf of k fragments k log k decisions, at worst k squared.
void divide_leaves(BspTree& tree, const Scene& scene);

/// What the arrays of a tree take. Units: bytes.
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

/// What the tree takes, array by array.
TreeBytes bytes_by_array(const BspTree& tree);

/// What the tree takes. Units: bytes.
std::size_t bytes_of(const BspTree& tree);

}  // namespace halfspace::fast
