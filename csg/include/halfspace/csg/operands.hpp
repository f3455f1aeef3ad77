#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "halfspace/boolean.hpp"
#include "halfspace/csg/plan.hpp"
#include "halfspace/fast/solid.hpp"
#include "halfspace/io/import.hpp"
#include "halfspace/result.hpp"

namespace halfspace::csg {

/// How operands are read.
struct OperandOptions {
  /// The folder that files in quotes are sought in; empty: where we are.
  std::string folder;
  std::optional<int> grid_bits = std::nullopt;
  /// Whether surfaces that cross themselves, or wind round something twice, are
  /// found, which takes time, and then whether they are noted, and not refused.
  bool find_crossings = true;
  bool repair = false;
  /// The word by which a user asks for `repair`, for messages.
  std::string repair_word = "repair";
};

/// The solid, its faces noting the polygons of a file that they are parts of.
/// Requires: none of them has been made from others.
fast::Solid numbered(fast::Solid solid, const std::vector<PolygonId>& polygons);

/// The solids of a plan, all on the grid that holds them: whatever units they
/// came in, and however they were moved, exact wherever one grid can hold them.
class Operands {
 public:
  /// Reads the files and chooses the grid (S1.7).
  ///
  /// Requires: `script` and `plan` outlive the operands, which are the plan's.
  /// Errors: those of reading and importing; kOpen, kSelfCrossing, kInsideOut
  ///         (bad edges, faces that cross, inside out). The message names the
  ///         file.
  static Result<Operands> load(const Script& script, const Plan& plan,
                               const OperandOptions& options);

  /// The solid of a leaf, mirrored ones turned outwards again.
  /// Errors: those of importing; kOpen, kSelfCrossing, kInsideOut;
  ///         kOutOfRange (it is less than a step of the grid). The message names
  ///         the file, and where in the script it is moved.
  Result<GridSolid> leaf(std::int32_t id);

  /// Of each polygon of a leaf that was asked for the one in its file that it
  /// is, or is a part of.
  const std::vector<PolygonId>& polygons_of(std::int32_t leaf) const {
    return polygons_[static_cast<std::size_t>(leaf)];
  }

  /// Three points of a plane.
  /// Errors: kZeroArea (rounding put them on a line).
  Result<std::array<GridPoint, 3>> plane(std::int32_t id);

  /// The empty solid there.
  GridSolid nothing() const;

  /// What reading, moving and rounding did so far; the grid of all.
  const io::ImportReport& report() const { return report_; }

  /// Whether the surface of a leaf that was asked for crosses itself.
  bool to_repair(std::int32_t leaf) const {
    return repair_[static_cast<std::size_t>(leaf)];
  }

  /// The word by which a user asks for that.
  /// The error of a leaf of which a repair leaves no surface.
  Error nothing_left(std::int32_t leaf) const;

  /// Whether nobody looked for that.
  bool are_trusted() const { return !options_.find_crossings; }

  /// How many corners were added where vertices lay within edges, so far.
  std::size_t corners_added() const { return corners_added_; }

  /// How many polygons a leaf's file has.
  std::size_t polygon_count(std::int32_t leaf) const;

  /// A leaf in words: its name, or its file, and where it is.
  std::string name_of(std::int32_t leaf) const;

  /// The file of a leaf.
  const std::string& path_of(std::int32_t leaf) const;

 private:
  struct Source {
    std::string path;
    Scene scene;
    std::vector<PolygonId> polygons;  ///< as Loaded::polygons
    bool to_repair = false;
  };

  Operands(const Script& script, const Plan& plan,
           const OperandOptions& options)
      : script_(&script),
        plan_(&plan),
        options_(options),
        repair_(plan.leaves.size()),
        polygons_(plan.leaves.size()) {}
  Scene closed(Scene scene);
  Result<bool> needs_repair(const GridSolid& solid,
                            const std::vector<PolygonId>& polygons) const;
  Result<Done> read_files();
  Result<Done> choose_grid();
  const Source& source_of(std::int32_t leaf) const;
  Result<Scene> moved_scene(const Leaf& leaf, std::vector<PolygonId>& polygons);

  const Script* script_;
  const Plan* plan_;
  OperandOptions options_;
  std::vector<Source> sources_;                   // by file of the script
  std::vector<bool> repair_;                      // by leaf
  std::vector<std::vector<PolygonId>> polygons_;  // by leaf
  io::ImportReport report_;
  std::size_t corners_added_ = 0;
};

}  // namespace halfspace::csg
