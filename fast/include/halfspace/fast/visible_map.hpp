#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "halfspace/fast/build.hpp"
#include "halfspace/image.hpp"
#include "halfspace/result.hpp"
#include "halfspace/visible_map.hpp"

namespace halfspace::fast {

/// A line of the image, exactly: `a x + b y + c = 0` in twice the image's
/// coordinates. Two's complement, least word first.
struct MapLine {
  using Integer = std::array<std::uint64_t, 8>;
  Integer a{};
  Integer b{};
  Integer c{};
};

/// A vertex of the map: where two of its lines meet. Units: pixels.
struct MapVertex {
  double x = 0;  ///< the nearest double to the exact coordinate
  double y = 0;
  std::array<std::int32_t, 2> lines{};  ///< which meet there, not parallel
};

/// An arc of the map (S7.4), by the numbers of its vertices and of the regions
/// on its sides; -1 for the outside of the image.
struct MapArc {
  std::int32_t from = 0;
  std::int32_t to = 0;
  std::int32_t left = 0;
  std::int32_t right = 0;
  friend bool operator==(const MapArc&, const MapArc&) = default;
};

/// A region of the map (S7.3).
struct MapRegion {
  std::int32_t key = kBackgroundKey;
  /// The lowest polygon that is seen in it, or kBackground.
  PolygonId item = kBackground;
  /// Its loops are `loops[first_loop]` and the `loop_count - 1` after it: the
  /// outer one first, then its holes.
  std::int32_t first_loop = 0;
  std::int32_t loop_count = 0;
  friend bool operator==(const MapRegion&, const MapRegion&) = default;
};

/// The visible map (S7.4, S7.5).
///
/// Shape: vertices in the order of x, then y; arcs in that of their ends;
///        regions in that of the first vertices of their outer loops. A loop is
///        a closed chain of vertices, `corners[first_corner[l]]` up to but not
///        including `corners[first_corner[l + 1]]`, with its region on the
///        right of every step on a screen whose y grows downwards; it begins at
///        its first vertex.
struct VisibleMap {
  std::vector<MapLine> lines;  ///< those of vertices
  std::vector<MapVertex> vertices;
  std::vector<MapArc> arcs;
  std::vector<MapRegion> regions;
  std::vector<std::uint32_t> first_corner = {0};  ///< by loop
  std::vector<std::int32_t> corners;
  /// How many cells the tree over the image had (S7.2), before they were
  /// merged to regions.
  std::size_t cells = 0;
  FilterStats decisions;
};

/// Limits of a map, so that a map that is too large is an error in time.
struct MapLimits {
  /// At most 2^28. A cell takes some 500 bytes until the map is assembled, so
  /// that the usual limit is reached at 8 GB.
  std::size_t most_cells = 16'000'000;
  /// Those of a map that has more than its limit are counted for the error's
  /// sentence, so many at a time, or up to the limit if that is more.
  std::size_t counted_at_once = 1'000'000;
};

/// The visible map of a scene whose tree is `tree` (S7.4).
///
/// From front to back every fragment is cut out of what is still unlit of the
/// image, which is kept as a 2-D BSP tree whose lines are the images of the
/// fragments' edges; what is hidden ends at lit cells (FAQ, "two dimensional
/// BSP tree"; Naylor 1992). Cells with one key are then merged.
/// Requires: a tree of this scene; keys for all polygons or none.
/// Exact:    yes: filters in doubles, integers of fixed width behind them.
/// Errors:   kOutOfRange: more cells than the limit; says how many, or, where
///           not all fit below it at once, about how many, up to four times it.
/// Cost:     what is seen, and the way to it: leaves of the tree are divided
///           where some of the image is still unlit. For many maps by one tree
///           divide_leaves() does that once.
Result<VisibleMap> visible_map(const Scene& scene, const BspTree& tree,
                               const Camera& camera,
                               const MapOptions& options = {},
                               const MapLimits& limits = {});

/// The visible map of what the clip planes of `image` leave, with its caps
/// (S10.5): cap k has the item n + k, its hatching n + 8 + k, of n polygons,
/// and those of part q 16 q more (S10.6).
///
/// Of `image` only clip planes, caps and parts count.
/// Requires: as visible_map(); keys, if any, of caps and their hatching, too:
/// of
///           n + 16 items, or 16 more a part; a closed scene where there are
///           caps.
/// Exact, errors: as visible_map().
/// Cost:     as visible_map(), and of caps the edges that their planes cut.
Result<VisibleMap> section_map(const Scene& scene, const BspTree& tree,
                               const Camera& camera, const MapOptions& options,
                               const ImageOptions& image,
                               const MapLimits& limits = {});

/// The loops of a region, the outer one first. Units: pixels.
std::vector<std::vector<std::array<double, 2>>> loops_of(
    const VisibleMap& map, const MapRegion& region);

}  // namespace halfspace::fast
