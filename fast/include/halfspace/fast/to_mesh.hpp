#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "halfspace/fast/solid.hpp"

namespace halfspace::fast {

/// How a solid becomes a mesh.
struct ExportOptions {
  /// Whether faces that are convex become triangles like the others.
  bool triangles = false;
  /// That triangulate faces at once; 0: as many as the machine has. The mesh is
  /// the same.
  int threads = 1;
  /// Whether convex polygons may have straight corners; else those that would
  /// become triangles, too.
  bool straight_corners = true;
};

/// A solid's surface in doubles (S1.8). Units: model units.
///
/// The corners of polygon `p` are `corners[first_corner[p]]` up to but not
/// including `corners[first_corner[p + 1]]`.
struct ExportedMesh {
  std::vector<std::array<double, 3>> vertices;
  std::vector<std::uint32_t> first_corner = {0};
  std::vector<VertexId> corners;
  std::vector<std::int32_t> faces;   ///< by polygon: which face it is a part of
  std::vector<std::int32_t> points;  ///< by vertex: the solid's id of its point
  std::vector<Rgb> colors;           ///< by polygon
  /// By vertex: 1 if doubles do not hold the point exactly, whatever the
  /// solid's unit is, else 0. With a power of ten above 1 or below 10^-22 it
  /// is 1.
  std::vector<std::uint8_t> is_rounded;
  std::size_t moved = 0;  ///< vertices that are rounded
  double max_move = 0;    ///< no coordinate moved farther
  /// The polygons that rounding may have flipped or flattened.
  std::vector<std::int32_t> flipped;
};

/// The solid as convex polygons, or as triangles, in doubles: the nearest ones,
/// ties to even, times the unit, if that is a power of two; else they are
/// multiplied or divided by a power of ten, which rounds once or twice more.
///
/// Shape: closed like the solid: one point is one vertex. Vertices are in the
///        order of their coordinates, polygons in that of their corners: equal
///        solids give equal meshes, whatever made them, if their faces are
///        equal. If a surface crosses itself, which booleans of solids do not
///        cause, the mesh may be open.
ExportedMesh to_mesh(const Solid& solid, const ExportOptions& options = {});

}  // namespace halfspace::fast
