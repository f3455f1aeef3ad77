#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "halfspace/fast/build.hpp"
#include "tree/scene_planes.hpp"

namespace halfspace::fast {

/// A fragment on its way down a tree: `count` corners of the tree's array.
struct Part {
  PolygonId source = 0;
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

constexpr std::uint32_t kCountMask = kMostCornersOfFragment;

/// Whether two planes that are the same point set have opposite normals.
///
/// Products of parallel vectors' components all have one sign, so their sum in
/// doubles has it too.
inline bool opposed(const Plane& p, const Plane& q) {
  return p.a * q.a + p.b * q.b + p.c * q.c < 0;
}

/// Two parts that a plane made of one.
struct CutParts {
  Part positive;
  Part negative;
};

/// Decides and cuts the parts of a growing tree.
class TreeBuilder {
 public:
  TreeBuilder(const Scene& scene, BspTree& tree, FilterStats& stats)
      : geometry_(scene, tree.free_planes),
        vertex_count_(static_cast<std::int32_t>(scene.data().vertices.size())),
        tree_(tree),
        stats_(stats) {}

  const Geometry& geometry() const { return geometry_; }

  /// The whole polygon; its corners are added to the tree.
  Part whole(PolygonId polygon);

  /// The part against the plane (S2.1). Remembers the signs for cut().
  Relation relation(const Part& part, PlaneId id, const FilterPlane& plane);

  /// Cuts the part along the plane (S2.3).
  /// Requires: the last call was relation(part, id, plane), and spanning.
  CutParts cut(const Part& part, PlaneId id, const FilterPlane& plane);

  Vertex vertex(std::int32_t index) const {
    if (index >= vertex_count_) {
      return tree_
          .cut_vertices[static_cast<std::size_t>(index - vertex_count_)];
    }
    return to_vertex(geometry_.scene().point(index));
  }

 private:
  Geometry geometry_;
  std::int32_t vertex_count_;
  BspTree& tree_;
  FilterStats& stats_;
  std::vector<std::int8_t> signs_;
  std::vector<Bounded> values_;
  std::array<std::vector<Corner>, 2> new_corners_;
};

/// Lays the corners out in the order of the fragments, without those of
/// fragments that were cut.
void drop_unused_corners(BspTree& tree);

}  // namespace halfspace::fast
