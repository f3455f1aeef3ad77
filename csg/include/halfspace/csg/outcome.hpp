#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "halfspace/boolean.hpp"
#include "halfspace/bsp_tree.hpp"
#include "halfspace/csg/operands.hpp"
#include "halfspace/csg/scaled.hpp"
#include "halfspace/fast/rounded_mesh.hpp"
#include "halfspace/io/write_mesh.hpp"
#include "halfspace/progress.hpp"
#include "halfspace/result.hpp"
#include "halfspace/scene.hpp"
#include "halfspace/solid_file.hpp"

namespace halfspace::csg {

/// Which faces of the result that are in one plane become one face.
enum class MergeRule : std::uint8_t {
  kOrigin,  ///< parts of one polygon
  kColor,   ///< those of one colour
  kPlane,   ///< all
  kNone,    ///< none
};

/// Carries out a union, intersection, difference or symmetric difference.
using Combine = std::function<fast::Solid(BooleanOp, const fast::Solid&,
                                          const fast::Solid&)>;

/// The library's operation of a node that combines two solids.
BooleanOp boolean_op(NodeKind kind);

/// How a plan is carried out, and what the result is wanted for.
struct EvaluateOptions {
  MergeRule merge = MergeRule::kOrigin;  ///< the fast library's
  bool triangles = false;                ///< the fast library's
  /// The numbers that the result is written in (S6.8), and how far that may
  /// move its surface. The fast library's.
  fast::FileNumber number = fast::FileNumber::kDouble;
  std::optional<double> max_move = std::nullopt;
  /// No polygon of the result is to reach beyond the one that it comes from.
  /// The fast library's.
  bool keep_corners = false;
  /// What the result is to be written to: errors of rounding it name it.
  std::string output = {};
  /// The result is wanted for a `.hsolid` file. The fast library's.
  bool exact_data = false;
  /// The attributes say where polygons come from, too. The fast library's.
  bool keep_origin = false;
  BuildOptions build;  ///< the trees of the reference
  int threads = 1;     ///< the fast library's; 0: as many as there are
  /// Replaces fast::boolean() where neither solid is a half-space, for instance
  /// to check its results. Long unions and intersections then go through it
  /// too, two solids at a time.
  Combine combine;
  Progress progress = {};
};

/// Where a polygon of a result comes from.
struct Origin {
  std::int32_t leaf = 0;  ///< of the plan
  PolygonId polygon = 0;  ///< of the leaf's solid
};

/// A solid that was repaired before it was used, and what that did.
struct Repair {
  std::int32_t leaf = 0;  ///< of the plan
  /// Pairs of faces; the reference, which looks at winding numbers alone, does
  /// not know them.
  std::optional<std::size_t> crossings;
  std::size_t faces_cut = 0;      ///< of which parts are left
  std::size_t faces_dropped = 0;  ///< of which nothing is left
};

/// What rounding a result to the file's numbers came to (S6.8).
struct RoundingReport {
  double spacing = 0;            ///< of the grid; model units
  std::size_t rounds = 0;        ///< of rounding, one after another
  std::size_t contacts = 0;      ///< where the first one made surfaces meet
  std::size_t faces_lost = 0;    ///< of which nothing is left
  std::size_t parts_before = 0;  ///< of the surface; 0 where all are there yet
  std::size_t parts_after = 0;

  /// Whether something of the solid is not there any more.
  bool lost_any() const {
    return faces_lost > 0 || parts_before != parts_after;
  }
};

/// By polygon whether it has a colour, for writers.
std::vector<bool> has_color(const std::vector<ColorSource>& sources);

/// The result of a plan, ready to be written.
struct Outcome {
  /// The result exactly, where all its vertices are points of a grid and it is
  /// not wanted in floats.
  std::optional<Scene> scene;
  /// The result exactly, if that was asked for: then it is nothing else.
  std::optional<SolidData> data;
  /// Its vertices in the file's numbers, else.
  io::OutputMesh mesh;
  std::size_t moved = 0;        ///< vertices that the numbers do not hold
  double max_move = 0;          ///< no point moved farther; model units
  std::size_t faces = 0;        ///< of the exact solid
  std::size_t polygons = 0;     ///< of the scene or mesh
  std::size_t bad_edges = 0;    ///< 0: it is closed, as it must be (S6.5)
  Scaled volume{0, {2, 0}, 3};  ///< rounded
  std::vector<Origin> origins;  ///< by polygon; empty: not known
  /// By polygon; empty where all colours are their operands' own.
  std::vector<ColorSource> color_sources;
  /// What rounding did besides, if there was any.
  std::optional<RoundingReport> rounding;
  std::vector<Repair> repairs;
  /// Of the polygons of `scene` or `mesh`; null where no operand has any.
  std::shared_ptr<const io::Attributes> attributes = nullptr;
};

/// The result of the plan as it is; nothing where it was stopped. The faces'
/// parts are the plan's leaves, and after those its planes.
/// Errors: those of the operands.
Result<std::optional<fast::Solid>> evaluate_solid(
    const Plan& plan, Operands& operands, const EvaluateOptions& options);

/// What a result was made of: an operand, or the plane of a half-space.
struct OperandPart {
  std::string name;  ///< in files; where `data` are given, those have names
  const SolidData* data = nullptr;  ///< of an exact operand
  /// How it was moved; nothing: the name says where it stands.
  std::optional<Matrix> matrix = std::nullopt;
  /// Operands of one name and place but other numbers here stay apart.
  std::int32_t alone = -1;
};

/// The plane of a half-space.
OperandPart half_part(const HalfSpace& points);

/// A solid for a `.hsolid` file, and by face where it comes from: the place of
/// an operand among those that were given, and its polygon.
struct FileSolid {
  SolidData data;
  std::vector<Origin> origins;
};

/// The solid as its file has it (F7), whose faces' parts are these operands.
/// Requires: it is bounded and closed.
FileSolid for_file(fast::Solid solid, std::span<const OperandPart> operands);

/// The solid for a `.hsolid` file. Its parts are those of exact operands, one
/// after the other, and other operands, by the names of their files.
Outcome exact_outcome(fast::Solid solid, const Plan& plan,
                      const Operands& operands, const EvaluateOptions& options);

/// The solid, ready to be written: its faces merged by options.merge.
/// Errors: those of fast::rounded_mesh().
Result<Outcome> outcome_of(fast::Solid solid, const EvaluateOptions& options);

/// The result of the plan of the operands; nothing where it was stopped.
/// Errors: those of the operands, and of fast::rounded_mesh().
Result<std::optional<Outcome>> evaluate_fast(const Plan& plan,
                                             Operands& operands,
                                             const EvaluateOptions& options);

/// The same by the reference, which does not know where faces come from.
/// Errors: kUnknownFormat (the plan has half-spaces).
Result<std::optional<Outcome>> evaluate_ref(const Plan& plan,
                                            Operands& operands,
                                            const EvaluateOptions& options);

}  // namespace halfspace::csg
