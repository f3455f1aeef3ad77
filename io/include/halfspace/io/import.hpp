#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "halfspace/io/mesh.hpp"
#include "halfspace/io/stop.hpp"
#include "halfspace/result.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::io {

/// A light far away.
struct Light {
  std::array<double, 3> to_light = {0.15, -0.45, 0.88};  ///< about 1 long
  double strength = 1;
};

/// How a mesh becomes a scene (S1.7).
struct ImportOptions {
  /// Use this grid (26, 40 or 54), and round where it is too small.
  std::optional<int> grid_bits;
  /// Divide the grid steps further, by powers of the unit's base, while every
  /// coordinate stays within this many bits and within the grid: gives cameras
  /// a finer lattice for nothing. 0 keeps the coarsest unit that is exact.
  int refine_bits = 0;
  /// Give the scene colours at its corners, and make every polygon a triangle.
  bool gouraud = false;
  /// Make every polygon a triangle, without colours at its corners, too.
  bool triangles = false;
  /// Tell which vertex of the mesh each corner of the scene was.
  bool keep_vertices = false;
  /// Replaces the colours of the mesh, and that of surfaces without one.
  std::optional<Rgb> surface = std::nullopt;
  /// Light the colours of the mesh by the directions of its faces, as surfaces
  /// without colours are lit.
  bool light_colors = false;
  /// Where light comes from. A surface has the ambient share of its colour, and
  /// of the rest what each light adds, up to all of it.
  std::vector<Light> lights = {Light()};
  double ambient = 0.22;  ///< 0 to 1
  /// Corners are lit by the normals of those faces at the vertex that turn by
  /// at most so much from the corner's own; nothing: of all.
  std::optional<double> crease_deg = std::nullopt;
  Stop stop = {};  ///< asked while the mesh is read and imported
  /// Use this unit on that grid, or one of 26 bits, and round to it: for what
  /// joins a scene. Requires: coordinates of less than 2^62 units.
  std::optional<Unit> unit = std::nullopt;
};

/// Colours as they are, and the usual one unlit: for what is written again.
ImportOptions unlit();

/// What import did to a mesh (S1.7).
struct ImportReport {
  std::size_t vertices = 0;      ///< of the mesh
  std::size_t polygons = 0;      ///< of the mesh
  std::size_t moved = 0;         ///< coordinates that were rounded
  double max_move = 0;           ///< how far at most. Units: model units
  std::size_t triangulated = 0;  ///< polygons of the mesh cut into triangles
  std::size_t dropped = 0;       ///< polygons of the mesh without area
  Unit unit;
  int grid_bits = 26;
};

/// The scene that a mesh became, and what was done to it.
struct Imported {
  Scene scene;
  /// For each polygon of the scene: the face of the mesh that it is, or is a
  /// part of.
  std::vector<PolygonId> faces;
  ImportReport report;
  /// For each corner of the scene, the vertex of the mesh; empty unless
  /// ImportOptions::keep_vertices.
  std::vector<VertexId> corner_vertices = {};
  /// By face of the mesh whether it has a colour there: its own, its vertices'
  /// or its material's. Empty: none has.
  std::vector<bool> has_color = {};
};

/// The scene of a mesh (S1.7).
///
/// Grid: the unit is the coarsest power of ten, or of two, of at most 1 of
///   which all coordinates of the faces' vertices are multiples, so that they
///   fit the fewest of 26, 40 or 54 bits (of the asked-for ones); a unit
///   greater than 1 is tried where that does not fit. Base ten goes first if
///   the mesh was text, base two if it was not. If nothing fits, they are
///   rounded, halves away from zero, to the grid of 54 (or the asked-for) bits
///   whose unit is the least power of two that holds the greatest of them.
///   Where the options give a unit, it is that one.
/// Polygons: equal points become one vertex. Corners that repeat the one before
///   go; what has no area is dropped. What is not planar or not convex, or
///   visits a point twice, is cut into triangles, none of them without area,
///   whose edges sum up to the polygon's; for a weakly simple planar polygon
///   (one with holes on bridges, too) they tile it. Straight corners stay.
/// Colours: the face's in the file, else the mean of its vertices', else its
///   material's, else the usual one lit by its direction. At corners: the
///   vertex's in the file, else the face's, else its material's, else the usual
///   one lit by the sum of the normals at the vertex. The options say whether
///   the file's are lit, too.
///
/// Exact:  but for the rounding reported, yes.
/// Errors: kEmpty (vertices, but no faces); kOutOfRange (a polygon to be cut
///         into triangles with over 100,000 corners; a grid of other than 26,
///         40, 54 bits; coordinates that no unit, or not the one that is given,
///         reaches; polygons of which
///         rounding takes more than it leaves); kBadIndex; kStopped.
/// Cost:   linear, but for polygons to be cut: n log n in their corners,
///         mostly, and quadratic at worst.
Result<Imported> import_scene(const Mesh& mesh, const ImportOptions& options);

}  // namespace halfspace::io
