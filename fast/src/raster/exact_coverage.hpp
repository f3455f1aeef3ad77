#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "camera/edge_function.hpp"
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

/// A tree and its scene, as the display reads them.
class TreeReader {
 public:
  TreeReader(const Scene& scene, const BspTree& tree)
      : geometry_(scene, tree.free_planes),
        tree_(tree),
        points_(scene.data().vertices.data()),
        vertex_count_(static_cast<std::int32_t>(scene.data().vertices.size())) {
  }

  const Geometry& geometry() const { return geometry_; }
  const Scene& scene() const { return geometry_.scene(); }
  const BspTree& tree() const { return tree_; }

  std::span<const Corner> corners(const TreeFragment& fragment) const {
    return {tree_.corners.data() + fragment.first_corner,
            fragment.corner_count};
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

 private:
  Geometry geometry_;
  const BspTree& tree_;
  const GridPoint* points_;
  std::int32_t vertex_count_;
};

/// The side of a splitter on which a fragment lies that has an edge by it.
inline int side_of(const TreeReader& reader, const TreeFragment& fragment,
                   PlaneId splitter) {
  const Geometry& geometry = reader.geometry();
  const FilterPlane plane = filter_plane(geometry.plane(splitter));
  const auto corners = reader.corners(fragment);
  for (const Corner& corner : corners) {
    const int known = known_sign(
        value_at(plane, reader.vertex(corner.vertex), geometry.rounding()));
    if (known != 0) return known;
  }
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Corner& before = corners[k == 0 ? corners.size() - 1 : k - 1];
    const int sign = geometry.exact_sign(fragment.source, before.edge,
                                         corners[k].edge, splitter);
    if (sign != 0) return sign;
  }
  return 0;
}

/// Decides, exactly, which samples a fragment covers (S4.5): where doubles
/// cannot tell, and where a fragment reaches up to the eye.
template <int kBits>
class ExactScan {
 public:
  ExactScan(const TreeReader& reader, const CameraData& camera)
      : reader_(reader), camera_(camera) {}

  /// The fragment that is meant from now on; the eye is on side `eye_sign` of
  /// its source, and not on its plane.
  void start(const TreeFragment& fragment, int eye_sign) {
    fragment_ = &fragment;
    eye_sign_ = eye_sign;
    ready_ = false;
  }

  /// The pixels of line `j`, of those in `range`, that it covers.
  PixelRange line(std::int32_t j, PixelRange range) {
    if (!ready_) prepare();
    for (const Line& line : lines_) range = clipped(range, line, j);
    return range;
  }

 private:
  static constexpr std::size_t kWords = Grid<kBits>::kWords;
  using Line = ImageLine<kWords>;

  void add(const Line& line, int inside) {
    lines_.push_back(inside > 0 ? line : -line);
  }
  template <std::size_t kOther>
  static Line widened(const ImageLine<kOther>& line) {
    return {Wide<kWords>(line.a), Wide<kWords>(line.b), Wide<kWords>(line.c)};
  }

  void prepare() {
    ready_ = true;
    lines_.clear();
    const Geometry& geometry = reader_.geometry();
    const PolygonId source = fragment_->source;
    const SeenPlane<kBits> support =
        see(geometry.exact<kBits>(source), camera_);
    for (const Corner& corner : reader_.corners(*fragment_)) {
      if (is_source(corner.edge)) {
        const auto ends = geometry.source_edge(source, corner.edge);
        add(widened(edge_line(ends[0], ends[1], camera_)), eye_sign_);
      } else {
        const PlaneId splitter = splitter_of(corner.edge);
        add(meet_line<kBits>(support,
                             see(geometry.exact<kBits>(splitter), camera_)),
            eye_sign_ * side_of(reader_, *fragment_, splitter));
      }
    }
    if (camera_.near) {
      add(widened(
              near_line<kBits>(support, *camera_.near, camera_.perspective)),
          eye_sign_);
    }
  }

  const TreeReader& reader_;
  const CameraData& camera_;
  const TreeFragment* fragment_ = nullptr;
  int eye_sign_ = 0;
  bool ready_ = false;
  std::vector<Line> lines_;
};

}  // namespace halfspace::fast
