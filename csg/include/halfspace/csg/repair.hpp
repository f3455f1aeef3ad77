#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "halfspace/csg/operands.hpp"

namespace halfspace::csg {

/// The steps of a repair, in their order. Vertices within edges become corners
/// in any case, for that changes no surface.
enum class RepairStep : std::uint8_t {
  kDuplicates,  ///< polygons that others cover go
  kWeld,        ///< vertices at borders become one with others
  kAgree,       ///< polygons are turned to agree with their neighbours
  kClose,       ///< holes are filled, or the surface is made a shell
  kOutwards,    ///< components are turned outwards
  kResolve,     ///< what crosses itself is resolved by winding number
};

/// What may be done to a surface so that it becomes a solid's.
struct RepairOptions {
  /// Steps that are left out. Where one of them would have gone on, the error
  /// names it.
  std::vector<RepairStep> without = {};
  /// Vertices at edges without a neighbour that are no farther apart than this
  /// along any axis become one. Units: model units. Nothing: four steps of
  /// floats of the size of the greatest coordinate.
  std::optional<double> weld = std::nullopt;
  /// Close holes however wide they are. Otherwise one of half the size of its
  /// component or more is left, for it may be no hole.
  bool close_all = false;
  /// Make an open surface a shell as thick as this, in place of closing holes:
  /// each polygon moved along its normal by half of it either way. Where planes
  /// that were moved so do not meet in a point, it is nearly so thick; the
  /// report says how thick it is. Units: model units.
  std::optional<double> thicken = std::nullopt;
  fast::CheckOptions check = {};
};

/// What was done, in the order in which it is.
struct RepairReport {
  std::size_t duplicates = 0;     ///< polygons that others have too
  std::size_t welded = 0;         ///< vertices that became others
  double weld_move = 0;           ///< how far one moved; model units
  std::size_t dropped = 0;        ///< polygons that welding left without area
  std::size_t corners_added = 0;  ///< where vertices lay within edges
  std::size_t turned = 0;         ///< polygons that ran against others
  std::size_t shells_turned = 0;  ///< components that faced inwards
  std::size_t planar_holes = 0;   ///< filled in their plane
  std::size_t other_holes = 0;    ///< filled by triangles of the least area
  std::size_t filled = 0;         ///< polygons that fill holes
  double thickness = 0;           ///< of the shell made of an open surface
  double least_thickness = 0;     ///< of that shell, at some polygon's corner
  double most_thickness = 0;
  /// What was found where it passed through itself, if it did: that is left to
  /// be resolved (S6.7).
  std::string crossing;

  /// Whether nothing had to be done.
  bool is_empty() const;
  /// One sentence for each thing that was done.
  std::vector<std::string> sentences() const;
};

struct Repaired {
  /// A solid, if `to_repair` is not set; else what is to be resolved. What the
  /// mesh says of its faces is there: what fills a hole is a part of a face
  /// beside it, and both sides of a shell are of the face between them.
  Source source;
  RepairReport report;
};

/// The solid that a mesh was meant to be, if what it lacks is of the kinds
/// above: duplicates go, vertices are welded, polygons of a component are
/// turned so that they agree and face outwards, holes are filled.
///
/// Each step is taken only if the surface is not a solid's yet. Nothing is done
/// to one that is: then this is make_source().
/// Exact:  but for the vertices that are welded or offset, yes. Which way a
///         component faces, what a hole is filled with and where a shell is
///         offset to are decided in doubles; the result is checked exactly.
/// Errors: kOpen, kInsideOut, kEmpty, kSelfCrossing (resolving was left out):
///         the message says what a person must decide. kStopped.
/// Source: BS95 and KLI80 for the least area of a hole's triangles.
Result<Repaired> repaired(const std::string& path, const io::Mesh& mesh,
                          const RepairOptions& options);

}  // namespace halfspace::csg
