#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "halfspace/boolean.hpp"
#include "halfspace/csg/exact.hpp"
#include "halfspace/csg/plan.hpp"
#include "halfspace/fast/check_operand.hpp"
#include "halfspace/fast/solid.hpp"
#include "halfspace/io/attributes.hpp"
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
  /// Whether it is found out that faces in one plane are apart, which spares
  /// looking at them each time that the solid is used.
  bool find_coplanar = false;
  bool repair = false;
  /// The word by which a user asks for `repair`, for messages.
  std::string repair_word = "repair";
  /// What mends other faults, for messages; empty: nothing is said of it.
  std::string mending_word = {};
  /// Whether it is an error if no grid holds the solids exactly. Free sources
  /// are rounded all the same. So are, if need be, those that reading rounded
  /// or that may be rounded; those moved by a map that is not made of mirrors,
  /// quarter turns, powers of 2 and 5, and shifts by short decimals; and planes
  /// whose numbers are not short.
  bool exact = false;
  /// What must be rounded goes to a grid of 54 bits, where it moves the least,
  /// and not to one that is fine enough for most.
  bool finest_grid = false;
  /// How surfaces are checked, one after another: by how many threads, and who
  /// is shown the share of each that is done, and may stop it (kStopped).
  fast::CheckOptions check = {};
};

/// Where the colour of a polygon is from.
enum class ColorSource : std::uint8_t {
  kNone,   ///< it has none, and so the usual one
  kGiven,  ///< the file that it is of
  kLit     ///< a scene, whose colours are those of a picture
};

/// A solid before it is moved: that of a file, or one made in memory.
struct Source {
  std::string path;                 ///< for messages
  Scene scene;                      ///< empty where `exact` is
  std::vector<PolygonId> polygons;  ///< of the file, by polygon of the scene
  /// The solid of a `.hsolid` file: it has no polygons on a grid.
  std::shared_ptr<const SolidData> exact;
  bool to_repair = false;  ///< its surface passes through itself
  /// Its coordinates were computed: any grid that is fine enough may hold them.
  bool is_free = false;
  /// It may be rounded, as little as can be, where no grid holds all: matters
  /// with OperandOptions::exact, for else all may.
  bool may_round = false;
  /// Faces in one plane and of one colour become one before anything is done
  /// with them (by the fast library): a third of the work for a mesh of
  /// triangles. Origins then name the first of them.
  bool merge_coplanar = false;
  /// Known to have no such faces: then nothing is done.
  bool is_lean = false;
  /// Where it has some, and what comes of them is convex: the solid with those
  /// as one, and by its polygon the file's, for use as it stands.
  std::shared_ptr<const GridSolid> lean = nullptr;
  std::vector<PolygonId> lean_polygons = {};
  io::ImportReport report;
  std::size_t corners_added = 0;  ///< where vertices lay within edges
  /// Where the scene is a solid's: that solid, so that what is used as it
  /// stands need not be looked at again, ...
  std::shared_ptr<const GridSolid> solid;
  /// ... and what a grid must hold of it: a step, and the least and the
  /// greatest coordinate.
  std::optional<std::array<io::Number, 3>> need;
  /// The file's faces with what it says of them; null where that is nothing.
  std::shared_ptr<const io::AttributedFaces> attributed = nullptr;
  /// By polygon of the file, or by origin of an exact solid, whether it has a
  /// colour; empty: none has.
  std::vector<bool> has_color = {};
  bool is_lit = false;  ///< of a scene: all have, and they are lit
};

/// The source whose surface is `scene`, from which corners may be missing where
/// vertices lie within edges. Nothing is looked for but that it is closed.
/// Errors: kOpen.
Result<Source> closed_source(const std::string& path, Scene scene,
                             const io::Imported& imported);

/// The solid in a file; with `flip`, with every polygon turned round. The
/// solid of a `.hsolid` file that says that it was checked is not checked
/// again. Errors: those of reading and importing, and of fast::check_operand().
/// The
///         message names the file.
Result<Source> read_source(const std::string& path,
                           const OperandOptions& options, bool flip = false);

/// The solid of a mesh in memory; `name` is that in messages.
/// Errors: those of importing and of fast::check_operand().
Result<Source> primitive_source(const std::string& name, const io::Mesh& mesh,
                                const OperandOptions& options);

/// The solid that an imported scene is; `path` names it in messages.
/// Errors: those of make_scene() and of fast::check_operand().
Result<Source> make_source(const std::string& path,
                           const io::Imported& imported,
                           const OperandOptions& options);

/// The solid, its faces noting the polygons of a file that they are parts of.
/// Requires: none of them has been made from others.
fast::Solid numbered(fast::Solid solid, const std::vector<PolygonId>& polygons);

/// The solids of a plan, all on the grid that holds them: whatever units they
/// came in, and however they were moved, exact wherever one grid can hold them.
class Operands {
 public:
  /// Reads the files that the plan uses and chooses the grid (S1.7).
  ///
  /// Requires: `script` and `plan` outlive the operands, which are the plan's.
  /// Errors: those of read_source().
  static Result<Operands> load(const Script& script, const Plan& plan,
                               const OperandOptions& options);

  /// The same of sources that are there, one for each file of the script.
  /// Errors: kOutOfRange (options.exact, and no grid of 54 bits will do).
  static Result<Operands> join(
      std::vector<std::shared_ptr<const Source>> sources, const Script& script,
      const Plan& plan, const OperandOptions& options);

  /// Whether something was rounded, and a grid of 54 bits would round it less:
  /// then a surface that passes through itself for that may be whole there.
  bool can_be_finer() const {
    return report_.moved > 0 && report_.grid_bits < 54 && !options_.grid_bits;
  }
  /// The same operands on such a grid.
  Result<Operands> on_finest_grid() const;

  /// The solid of a leaf, mirrored ones turned outwards again.
  /// Errors: those of make_source(); kOutOfRange (it is less than a step of
  ///         the grid). The message names the file, and where in the
  ///         script it is moved.
  Result<std::shared_ptr<const GridSolid>> leaf(std::int32_t id);

  /// Whether a leaf is the solid of a `.hsolid` file, which the grid holds
  /// exactly: then it has no polygons on a grid, but exact_leaf().
  bool is_exact(std::int32_t leaf) const {
    return exact_[static_cast<std::size_t>(leaf)];
  }

  /// Such a leaf's solid, where it is moved to. The polygons of its faces are
  /// its file's origins.
  /// Errors: those of fast::to_solid(). The message names the file.
  Result<fast::Solid> exact_leaf(std::int32_t id, const fast::Solid& with);

  /// The parts of which a leaf's polygons are, if its file has any.
  const SolidData* parts_of(std::int32_t leaf) const;

  /// The faces of a leaf's file with what it says of them, before they are
  /// moved; null where that is nothing.
  const io::AttributedFaces* attributed(std::int32_t leaf) const {
    return source_of(leaf).attributed.get();
  }

  /// For each polygon of a loaded leaf: the polygon of its file that it is, or
  /// is a part of.
  const std::vector<PolygonId>& polygons_of(std::int32_t leaf) const {
    return polygons_[static_cast<std::size_t>(leaf)];
  }

  /// Where the colour of a polygon of a leaf's file is from. Planes, which are
  /// numbered after the leaves, have none.
  ColorSource color_source(std::int32_t part, PolygonId polygon) const;

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

  /// Whether faces in one plane of a leaf that was asked for are to become one.
  bool to_merge(std::int32_t leaf) const {
    return source_of(leaf).merge_coplanar &&
           !lean_[static_cast<std::size_t>(leaf)];
  }

  /// Whether nobody looked for that.
  bool are_trusted() const { return !options_.find_crossings; }

  /// How many corners were added where vertices lay within edges, so far.
  std::size_t corners_added() const { return corners_added_; }

  /// Where surfaces that were rounded met themselves for that, so far; they
  /// were moved a little more, until they are solids again (S6.8).
  std::size_t settled_contacts() const { return settled_contacts_; }

  /// How many polygons a leaf's file has.
  std::size_t polygon_count(std::int32_t leaf) const;

  /// A leaf in words: its name, or its file, and where it is.
  std::string name_of(std::int32_t leaf) const;

  /// The name of a leaf in files: that of its file as it was given, without
  /// folders; or that of the function that made it.
  std::string name_in_files(std::int32_t leaf) const;

  /// The same, before the leaf is moved, so that one name is one solid:
  /// primitives have a hash of their meshes.
  std::string part_name(std::int32_t leaf) const;

  /// Whether a function of the script made the leaf.
  bool is_primitive(std::int32_t leaf) const;

  /// The file of a leaf.
  const std::string& path_of(std::int32_t leaf) const;

 private:
  Operands(const Script& script, const Plan& plan,
           const OperandOptions& options)
      : script_(&script),
        plan_(&plan),
        options_(options),
        exact_(plan.leaves.size()),
        needs_(plan.leaves.size()),
        repair_(plan.leaves.size()),
        lean_(plan.leaves.size()),
        polygons_(plan.leaves.size()) {}
  Scene closed(Scene scene);
  bool may_settle(std::int32_t leaf, const Result<bool>& repairs) const;
  Result<GridSolid> settled(const Scene& scene,
                            std::vector<PolygonId>& polygons);
  Error located(std::int32_t leaf, Error error) const;
  Result<Done> find_exact_leaves();
  Result<Done> round_leaf(std::int32_t leaf);
  Result<Done> round_what_grid_lacks();
  void add_need(std::int32_t leaf, std::vector<io::Number>& coordinates) const;
  bool stays_in_place(std::int32_t leaf) const;
  bool is_rounded_by_move(std::int32_t leaf) const;
  bool is_empty(std::int32_t leaf) const;
  std::int32_t leaf_count() const {
    return static_cast<std::int32_t>(plan_->leaves.size());
  }
  const Matrix& matrix_of(std::int32_t leaf) const;
  Unit unit_of(std::int32_t leaf) const;
  void set_grid(const Unit& unit, int bits);
  /// What a grid need not hold, beside what is free.
  enum Rounds : unsigned {
    kNothing = 0,
    kMoved = 1,     ///< what is_rounded_by_move() names, computed planes
    kImported = 2,  ///< what reading rounded
    kAllowed = 4    ///< what may be rounded
  };
  bool may_round(std::int32_t leaf) const;
  bool is_rounded(std::int32_t leaf, unsigned rounds) const;
  bool rounds_some(unsigned rounds) const;
  bool may_round_all() const;
  Result<Done> choose_grid();
  bool choose_exact_grid(unsigned rounds);
  bool choose_exact_grid(unsigned rounds, bool keeps_decimals);
  bool choose_unrounded_grid();
  Result<Done> choose_rounded_grid();
  Error about_farthest(const Error& error) const;
  io::Mesh mesh_of_needs() const;
  Error no_grid() const;
  const Source& source_of(std::int32_t leaf) const;
  Result<Scene> moved_scene(const Leaf& leaf, const Source& source,
                            std::vector<PolygonId>& polygons);

  const Script* script_;
  const Plan* plan_;
  OperandOptions options_;
  std::vector<std::shared_ptr<const Source>> sources_;  // by file
  /// By file: the surface in doubles of an exact solid that some leaf moves so
  /// that no grid holds it.
  std::vector<std::shared_ptr<const Source>> rounded_;
  std::vector<bool> exact_;                       // by leaf
  std::vector<std::optional<ExactNeed>> needs_;   // by leaf
  std::vector<bool> repair_;                      // by leaf
  std::vector<bool> lean_;                        // by leaf
  std::vector<std::vector<PolygonId>> polygons_;  // by leaf
  io::ImportReport report_;
  std::size_t corners_added_ = 0;
  std::size_t settled_contacts_ = 0;
};

}  // namespace halfspace::csg
