#pragma once

#include <cstddef>
#include <span>

#include "halfspace/fast/build.hpp"
#include "tree/scene_planes.hpp"

namespace halfspace::fast {

/// The blocks of a leaf, the fragment after those in them, and the first of its
/// list that is in none.
struct Blocks {
  std::span<const FragmentBlock<3>> triangles;
  std::span<const FragmentBlock<4>> quadrangles;
  std::int32_t end = kNoFragment;
  std::int32_t rest = kNoFragment;
};

/// Corner c of the k-th fragment of a block.
template <std::size_t kCorners>
Vertex corner_of(const FragmentBlock<kCorners>& block, std::size_t c,
                 std::size_t k) {
  return {double{block.x[c][k]} + double{block.origin[0]},
          double{block.y[c][k]} + double{block.origin[1]},
          double{block.z[c][k]} + double{block.origin[2]},
          double{block.error[k]}};
}

/// The block that begins so. Requires: its fragments have kCorners corners.
template <std::size_t kCorners>
const FragmentBlock<kCorners>& block_of(const BlockHead& head) {
  return static_cast<const FragmentBlock<kCorners>&>(head);
}

/// A tree and its scene, as the display reads them.
class TreeReader {
 public:
  TreeReader(const Scene& scene, const BspTree& tree)
      : planes_(scene, tree),
        tree_(tree),
        points_(scene.data().vertices.data()),
        vertex_count_(static_cast<std::int32_t>(scene.data().vertices.size())) {
  }

  const ScenePlanes& planes() const { return planes_; }
  const Scene& scene() const { return planes_.scene(); }
  const BspTree& tree() const { return tree_; }

  std::span<const Corner> corners(const TreeFragment& fragment) const {
    return {tree_.corners.data() + fragment.first_corner,
            fragment.corner_count};
  }
  const TreeFragment* fragments_of(const BlockHead& block) const {
    return tree_.fragments.data() + block.first_fragment;
  }
  /// Requires: a node of the tree.
  Blocks blocks(const Node& leaf) const {
    Blocks result;
    result.end = result.rest = leaf.first_fragment;
    if (tree_.first_blocks.empty()) return result;
    const auto n = static_cast<std::size_t>(&leaf - tree_.nodes.data());
    const FirstBlocks& first = tree_.first_blocks[n];
    const FirstBlocks& end = tree_.first_blocks[n + 1];
    result.triangles = {tree_.triangles.data() + first.triangles,
                        tree_.triangles.data() + end.triangles};
    result.quadrangles = {tree_.quadrangles.data() + first.quadrangles,
                          tree_.quadrangles.data() + end.quadrangles};
    const auto go_on = [&](const auto& block) {
      result.end = block.first_fragment + block.count;
      result.rest =
          tree_.fragments[static_cast<std::size_t>(result.end - 1)].next;
    };
    if (!result.triangles.empty()) go_on(result.triangles.back());
    if (!result.quadrangles.empty()) go_on(result.quadrangles.back());
    return result;
  }
  /// Where vertex() will read.
  const void* address(std::int32_t index) const {
    if (index < vertex_count_) return points_ + index;
    return tree_.cut_vertices.data() + (index - vertex_count_);
  }
  Vertex vertex(std::int32_t index) const {
    if (index < vertex_count_) return to_vertex(points_[index]);
    return tree_.cut_vertices[static_cast<std::size_t>(index - vertex_count_)];
  }

  /// The side of a splitter on which a fragment lies that has an edge by it.
  int side_of(const TreeFragment& fragment, PlaneId splitter) const {
    const FilterPlane plane = filter_plane(planes_.plane(splitter));
    const auto edges = corners(fragment);
    for (const Corner& corner : edges) {
      const int known = filtered_sign(
          value_at(plane, vertex(corner.vertex), planes_.rounding()));
      if (known != 0) return known;
    }
    for (std::size_t k = 0; k < edges.size(); ++k) {
      const Corner& before = edges[k == 0 ? edges.size() - 1 : k - 1];
      const int sign = planes_.exact_sign(fragment.source, before.edge,
                                          edges[k].edge, splitter);
      if (sign != 0) return sign;
    }
    return 0;
  }

 private:
  ScenePlanes planes_;
  const BspTree& tree_;
  const GridPoint* points_;
  std::int32_t vertex_count_;
};

}  // namespace halfspace::fast
