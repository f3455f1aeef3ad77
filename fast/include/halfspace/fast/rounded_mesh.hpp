#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "halfspace/fast/solid.hpp"
#include "halfspace/result.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::fast {

/// The numbers that a file has for coordinates.
enum class FileNumber : std::uint8_t { kDouble, kFloat };

/// How a solid becomes a mesh of a file's numbers.
struct RoundingOptions {
  FileNumber number = FileNumber::kDouble;
  /// Whether all polygons are triangles.
  bool triangles = false;
  int threads = 1;  ///< 0: as many as the machine has
  /// No point of the surface may move farther than this along an axis. Units:
  /// model units.
  std::optional<double> max_move = std::nullopt;
  /// Corners on straight creases stay, and with them the borders of the
  /// polygons that faces come from.
  bool keep_corners = false;
};

/// A solid's surface in a file's numbers (S6.8). Units: model units.
///
/// The corners of polygon `p` are `corners[first_corner[p]]` up to but not
/// including `corners[first_corner[p + 1]]`.
struct RoundedMesh {
  std::vector<std::array<double, 3>> vertices;
  std::vector<std::uint32_t> first_corner = {0};
  std::vector<VertexId> corners;
  std::vector<std::int32_t> faces;  ///< by polygon: which face it is a part of
  std::vector<Rgb> colors;          ///< by polygon
  std::size_t moved = 0;  ///< vertices of the solid that numbers do not hold
  /// No point of this surface is farther from the solid's along an axis.
  double max_move = 0;
  double spacing = 0;          ///< of the grid that vertices were rounded to
  std::size_t rounds = 0;      ///< roundings of vertices, one after another
  std::size_t crossings = 0;   ///< places where the first rounding made contact
  std::size_t faces_lost = 0;  ///< faces of the solid of which nothing is left
  std::size_t parts_before = 0;  ///< of the surface, connected along edges
  std::size_t parts_after = 0;
};

/// The solid as strictly convex polygons, or as triangles, whose vertices are
/// numbers of the file, and which are a solid's surface again (S6.8): read as
/// they are they are closed, do not cross themselves, wind round points once or
/// not at all; no two vertices are in one place, and no polygon is without area
/// or has a straight corner.
///
/// Grid: what must be rounded goes to multiples of one power of two: of floats,
///       the spacing at the greatest coordinate; of doubles, 32 times that, so
///       that grids of 54 bits have room for the file beside larger solids.
///       Vertices of the solid that are numbers of the file stay.
/// Shape: polygons whose corners are not exactly in one plane any more are
///        triangles. Corners that must be rounded and lie on a straight crease,
///        with nearly planar sides of one colour and part, are left out, unless
///        options.max_move leaves no room for the four steps that may move the
///        surface, or options.keep_corners is set: a triangle beside them may
///        reach beyond the polygon that it comes from. Vertices are in the
///        order of their coordinates, polygons in that of their corners.
/// Keeps: colours, and where polygons came from.
/// Errors: kOutOfRange (a coordinate is beyond the numbers; the surface moves
///         farther than it may; no grid was found on which it crosses nothing:
///         the message names places).
/// Cost:   n log n where rounding makes no contact; else of resolve(), for each
///         round.
/// Source: VL25, with a uniform grid and a coarser one only where triangles
///         meet that did so before; SZL92, LAW77 and HM83 for triangles.
Result<RoundedMesh> rounded_mesh(const Solid& solid,
                                 const RoundingOptions& options = {});

/// A scene whose surface does not cross itself any more.
struct SettledScene {
  Scene scene;                      ///< in the unit and grid of the other
  std::vector<PolygonId> polygons;  ///< by polygon: which one it is a part of
  /// No point of its surface is farther from the other's along an axis. Units:
  /// grid steps.
  double max_move = 0;
  std::size_t contacts = 0;  ///< where the other one's surface met itself
};

/// The surface of a solid whose vertices were moved to the points of a grid,
/// and which crosses itself for that: it becomes a solid's again, on the same
/// grid, as a result that is rounded to a file's numbers does (S6.8).
///
/// Requires: closed (make_solid() takes it); the surface crossed itself nowhere
///           before its vertices were moved. Otherwise the result is that of
///           resolution (S6.7), rounded.
/// Keeps:    colours.
/// Errors:   kOutOfRange (no rounding was found that does not cross itself; the
///           message names a place, in grid steps).
/// Cost:     n log n, and that of resolve(), for each round.
Result<SettledScene> settled_scene(const Scene& scene, int threads = 1);

}  // namespace halfspace::fast
