#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "halfspace/boolean.hpp"
#include "halfspace/bsp_tree.hpp"
#include "halfspace/io/write_mesh.hpp"
#include "halfspace/result.hpp"
#include "halfspace/scene.hpp"
#include "halfspace/shadow/boolean.hpp"
#include "operands.hpp"

namespace halfspace::tools {

/// Which faces of the result that are in one plane become one, in the order of
/// their words.
enum class MergeRule : std::uint8_t { kOrigin, kColor, kPlane, kNone };
const std::vector<std::string>& merge_words();

/// How a plan is carried out, and what the result is wanted for.
struct CsgOptions {
  MergeRule merge = MergeRule::kOrigin;  ///< the fast library's
  bool triangles = false;                ///< the fast library's
  BuildOptions build;                    ///< the trees of the reference
  int threads = 1;                       ///< the fast library's
  /// The share of the fast library's booleans to be checked.
  std::optional<double> shadow;
  /// Told the share that is done; where it returns false, the work stops.
  std::function<bool(double)> progress;
};

/// Where a polygon of a result comes from.
struct CsgOrigin {
  std::int32_t leaf = 0;  ///< of the plan
  PolygonId polygon = 0;  ///< of the leaf's solid
};

/// A solid that was repaired before it was used, and what that did.
struct CsgRepair {
  std::int32_t leaf = 0;          ///< of the plan
  std::size_t crossings = 0;      ///< pairs of faces
  std::size_t faces_cut = 0;      ///< of which parts are left
  std::size_t faces_dropped = 0;  ///< of which nothing is left
};

/// The result of a plan, ready to be written.
struct CsgResult {
  /// The result exactly, where doubles hold all its vertices in grid steps.
  std::optional<Scene> scene;
  /// Its vertices as doubles, else.
  io::OutputMesh mesh;
  std::size_t moved = 0;           ///< vertices that the doubles do not hold
  double max_move = 0;             ///< no coordinate moved farther; model units
  std::size_t faces = 0;           ///< of the exact solid
  std::size_t polygons = 0;        ///< of the scene or mesh
  std::size_t bad_edges = 0;       ///< 0: it is closed, as it must be (S6.5)
  double volume = 0;               ///< rounded; model units
  std::vector<CsgOrigin> origins;  ///< by polygon; empty: not known
  /// The polygons that rounding may have turned over or flattened.
  std::vector<std::int32_t> turned;
  std::vector<CsgRepair> repairs;
  /// What was checked, if anything was to be.
  std::optional<shadow::BooleanReport> checks;
};

/// The result of the plan of the operands; nothing where it was stopped.
/// Errors: those of the operands.
Result<std::optional<CsgResult>> evaluate_fast(const CsgPlan& plan,
                                               Operands& operands,
                                               const CsgOptions& options);

/// The same by the reference, which does not know where faces come from.
/// Errors: kUnknownFormat (the plan has half-spaces).
Result<std::optional<CsgResult>> evaluate_ref(const CsgPlan& plan,
                                              Operands& operands,
                                              const CsgOptions& options);

}  // namespace halfspace::tools
