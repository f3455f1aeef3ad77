#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "exact/exact_plane.hpp"
#include "exact/filter.hpp"
#include "halfspace/fast/build.hpp"

namespace halfspace::fast {

/// An edge of a fragment in one word: the source corner it leaves, or,
/// negative, -1 - the plane that cut it.
using EdgeCode = std::int32_t;

constexpr EdgeCode splitter_edge(PlaneId plane) { return -1 - plane; }
constexpr bool is_source(EdgeCode edge) { return edge >= 0; }
constexpr PlaneId splitter_of(EdgeCode edge) { return -1 - edge; }

constexpr EdgeCode code_of(const EdgeName& name) {
  return name.kind == EdgeName::Kind::kSource ? name.index
                                              : splitter_edge(name.index);
}
constexpr EdgeName name_of(EdgeCode edge) {
  if (is_source(edge)) return {EdgeName::Kind::kSource, edge};
  return {EdgeName::Kind::kSplitter, splitter_of(edge)};
}

/// TreeFragment::corner_count has 31 bits; no fragment has more corners.
constexpr std::uint32_t kMostCornersOfFragment = 0x7fffffff;

/// A plane of the grid, exactly, as doubles.
template <int kBits>
Plane rounded(const ExactPlane<kBits>& plane) {
  const auto offset = value_at(plane, GridPoint{});
  return {to_double(Int128{plane.normal.x}), to_double(Int128{plane.normal.y}),
          to_double(Int128{plane.normal.z}), to_double(offset)};
}

/// Bounds the sizes of the vertices' coordinates.
inline double largest_coordinate(const Scene& scene) {
  std::int64_t most = 0;
  for (const GridPoint& p : scene.data().vertices)
    most = std::max({most, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return static_cast<double>(most);
}

/// A scene and the free planes of its tree: what signs are decided from.
class ScenePlanes {
 public:
  /// `most` bounds the sizes of the coordinates of vertices and free planes.
  /// Requires: `tree` outlives it, and keeps its slanted faces.
  ScenePlanes(const Scene& scene, const BspTree& tree, double most)
      : scene_(scene),
        free_planes_(tree.free_planes),
        slanted_(tree.slanted.get()),
        polygon_count_(static_cast<PlaneId>(scene.polygon_count())),
        rounding_(rounding_of_values(most)) {}
  /// For all of the grid.
  ScenePlanes(const Scene& scene, const BspTree& tree)
      : ScenePlanes(scene, tree, std::ldexp(1.0, scene.grid_bits() - 1)) {}

  const Scene& scene() const { return scene_; }
  double rounding() const { return rounding_; }
  bool is_free(PlaneId plane) const { return plane >= polygon_count_; }
  const FreePlane& free_plane(PlaneId plane) const {
    return free_planes_[static_cast<std::size_t>(plane - polygon_count_)];
  }

  /// The plane in doubles.
  Plane plane(PlaneId id) const;

  /// The plane exactly.
  template <int kBits>
  ExactPlane<kBits> exact(PlaneId id) const {
    if (!is_free(id)) return exact_plane<kBits>(plane_corners(scene_, id));
    const FreePlane& free = free_plane(id);
    if (free.axis == kSlantedFace) return exact_plane<kBits>(face_of(free));
    return axis_plane<kBits>(free.axis, free.coordinate);
  }

  /// The two ends of the source edge that leaves `corner`.
  std::array<GridPoint, 2> source_edge(PolygonId source,
                                       std::int32_t corner) const;

  /// The point in which the plane passes through an edge of a fragment, from
  /// the source's corners: errors of earlier cuts do not add up.
  Vertex crossing(PolygonId source, EdgeCode edge,
                  const FilterPlane& plane) const;

  /// The sign of the plane at the vertex between two edges of a fragment.
  int exact_sign(PolygonId source, EdgeCode before, EdgeCode after,
                 PlaneId plane) const;

 private:
  template <int kBits>
  int exact_sign_on(PolygonId source, EdgeCode before, EdgeCode after,
                    PlaneId plane) const;

  const RegionFace& face_of(const FreePlane& free) const {
    return (*slanted_)[static_cast<std::size_t>(free.coordinate)];
  }

  const Scene& scene_;
  const std::vector<FreePlane>& free_planes_;
  const std::vector<RegionFace>* slanted_;
  PlaneId polygon_count_;
  double rounding_;
};

}  // namespace halfspace::fast
