#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "halfspace/camera.hpp"
#include "halfspace/fast/types.hpp"
#include "halfspace/plane.hpp"
#include "halfspace/polygon.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::fast {

/// Counts of decisions, passed in by the caller, never global. A decision is
/// counted once, in `filtered` or in `exact`.
struct FilterStats {
  std::uint64_t filtered = 0;  ///< decided by the filter in doubles
  std::uint64_t exact = 0;     ///< undecided by it: exact integers decided
  std::uint64_t zero = 0;      ///< those of `exact` that were zero

  void add(const FilterStats& other) {
    filtered += other.filtered;
    exact += other.exact;
    zero += other.zero;
  }
  friend bool operator==(const FilterStats&, const FilterStats&) = default;
};

/// Index of a plane in a tree: below the scene's number of polygons it is the
/// plane of that polygon, with its orientation (S1.4); from there on it counts
/// the tree's free planes.
using PlaneId = std::int32_t;

/// A plane of no polygon: where coordinate `axis` equals `coordinate`.
/// Its positive side is where it is greater. With kSlantedFace for an axis it
/// is the plane of the tree's slanted face number `coordinate` (S12.6).
constexpr std::int32_t kSlantedFace = 3;
struct FreePlane {
  std::int32_t axis = 0;
  std::int64_t coordinate = 0;
  friend bool operator==(const FreePlane&, const FreePlane&) = default;
};

/// A polygon, or what is left of one after cuts (S2.2).
///
/// Edge `k` runs from vertex `k` to vertex `k + 1`, cyclically. The names say
/// where a vertex is exactly: between two source edges it is their common
/// corner; between a source edge and a splitter's, their meet; between two
/// splitters' edges, the meet of both splitters and the polygon's plane.
struct Fragment {
  PolygonId source = 0;
  std::vector<EdgeName> edges;
  std::vector<Vertex> vertices;  ///< as many as edges
};

/// The polygon `id` of the scene as a fragment, uncut. Its vertices are exact.
Fragment whole(const Scene& scene, PolygonId id);

/// The three corners that define a polygon's plane (S1.4): the first three in
/// a row that are not on one line.
std::array<GridPoint, 3> plane_corners(const Scene& scene, PolygonId id);

/// The plane of polygon `id` (S1.4).
Plane plane_of(const Scene& scene, PolygonId id);

/// The planes of all polygons of the scene, by polygon id (S1.4).
std::vector<Plane> planes_of(const Scene& scene);

/// The names of the scene's planes, two polygons having the same one exactly
/// if their planes are the same point set (S1.4).
///
/// Planes are looked up in a canonical form, so that "coincident" is a
/// comparison of ids.
struct PlaneTable {
  std::vector<std::int32_t> plane_of;    ///< by polygon id
  std::vector<PolygonId> first_polygon;  ///< by plane: the lowest polygon id
  std::vector<bool> same_orientation;    ///< by polygon id: as that polygon's
};
PlaneTable intern_planes(const Scene& scene);

/// The side of the plane of polygon `splitter` that holds the vertex `k` of
/// the fragment (S1.5).
///
/// Exact: yes: a filter, then integers of 4, 6 or 8 words.
/// Cost:  a decision for every vertex, all of which `stats` counts.
Side side_of(const Scene& scene, const Fragment& fragment, std::size_t k,
             PolygonId splitter, FilterStats& stats);

/// The side of the plane of polygon `splitter` that holds the camera's eye;
/// for an eye at infinity, the side towards which its direction points (S4.2).
///
/// Exact: yes.
Side side_of_eye(const Scene& scene, PolygonId splitter, const Camera& camera,
                 FilterStats& stats);

/// The fragment against the plane of polygon `splitter`, by the signs at its
/// vertices (S2.1).
///
/// Exact: yes.
Relation relation(const Scene& scene, const Fragment& fragment,
                  PolygonId splitter, FilterStats& stats);

/// The fragment by names alone (S2.2).
FragmentName name_of(const Fragment& fragment);

}  // namespace halfspace::fast
