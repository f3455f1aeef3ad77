#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "halfspace/boolean.hpp"
#include "halfspace/io/import.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::csg {

using DoublePoint = std::array<double, 3>;

inline DoublePoint in_doubles(const GridPoint& p) {
  return {static_cast<double>(p.x), static_cast<double>(p.y),
          static_cast<double>(p.z)};
}

/// Polygons on a grid that may be anything: open, doubled, turned round.
struct Soup {
  Unit unit;
  bool decimal = false;
  std::vector<GridPoint> points;  ///< each once
  std::vector<std::vector<VertexId>> polygons;
  std::vector<PolygonId> sources;  ///< by polygon: that of the file, or -1
  std::vector<Rgb> colors;         ///< by polygon

  const GridPoint& at(VertexId v) const {
    return points[static_cast<std::size_t>(v)];
  }
  void add(std::vector<VertexId> polygon, PolygonId source, Rgb color) {
    polygons.push_back(std::move(polygon));
    sources.push_back(source);
    colors.push_back(color);
  }
};

/// A use of an edge by a polygon.
struct SoupEdge {
  VertexId low = 0;
  VertexId high = 0;
  std::int32_t polygon = 0;
  bool forward = false;
  friend auto operator<=>(const SoupEdge&, const SoupEdge&) = default;
};

/// All uses of edges in order: those of one edge in a row.
std::vector<SoupEdge> edges_of(const Soup& soup);

/// Calls `found(first, last)` for the uses of each edge.
template <class Found>
void for_edges(const std::vector<SoupEdge>& edges, Found&& found) {
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i + 1;
    while (end < edges.size() && edges[end].low == edges[i].low &&
           edges[end].high == edges[i].high)
      ++end;
    found(edges.data() + i, edges.data() + end);
    i = end;
  }
}

/// Edges that are used more often one way, in that direction, each as often as
/// it is too many times.
std::vector<std::pair<VertexId, VertexId>> open_edges(const Soup& soup);

/// As halfspace::bad_edges(), in the order of the ids of their ends.
std::vector<BadEdge> bad_edges(const Soup& soup);

/// The polygons of what was imported, where no two vertices have one point.
Soup soup_of(const io::Imported& imported);

/// The soup imported anew: polygons that are not planar are cut, those without
/// area go. `sources` become those of the soup.
Result<io::Imported> imported_soup(const Soup& soup);

/// Of polygons with the same corners in the same order, or reversed, keeps one,
/// or none where as many run either way. Returns how many went.
std::size_t drop_duplicates(Soup& soup);

struct Welded {
  std::size_t vertices = 0;
  std::int64_t move = 0;  ///< the farthest, along an axis; grid steps
};
/// Makes ends of open edges that are at most `distance` steps apart one.
Welded weld(Soup& soup, std::int64_t distance);

struct Turned {
  std::size_t polygons = 0;
  std::size_t conflicts = 0;  ///< edges whose two polygons cannot agree
};
/// Turns polygons so that the two of each edge run against each other; in each
/// component the fewer.
Turned turn_to_agree(Soup& soup);

/// Turns whole components that face inwards and are in no other. Returns how
/// many polygons each of them has.
std::vector<std::size_t> turn_outwards(Soup& soup);

struct Filled {
  std::size_t planar = 0;
  std::size_t others = 0;
  std::size_t polygons = 0;
  /// Of the widest hole that was left, if there is one: its edges, and one of
  /// its corners.
  std::size_t left_edges = 0;
  GridPoint left_at;
};
/// Fills holes: along the loops of open edges, with one polygon where they lie
/// in one plane, else with triangles of the least area in all. Leaves those of
/// half the size of their component, unless `all`.
Filled fill_holes(Soup& soup, bool all);

/// A shell round an open surface.
struct Shell {
  io::Mesh mesh;                   ///< in model units, not on the grid
  std::vector<PolygonId> sources;  ///< by face of the mesh
  /// How thick it is, measured along the normal of each polygon at each of its
  /// corners.
  double least = 0;
  double most = 0;
};
/// The surface and its copy, each polygon moved along its normal by half the
/// thickness either way, and walls between their borders. Vertices go to where
/// the planes of their polygons have gone: where those are more than three, to
/// where they nearly meet, and at an edge sharper than 29 degrees less far.
Shell shell_of(const Soup& soup, double thickness);

}  // namespace halfspace::csg
