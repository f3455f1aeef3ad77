#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "halfspace/api.hpp"
#include "halfspace/mesh.hpp"
#include "halfspace/progress.hpp"
#include "halfspace/result.hpp"

namespace halfspace {

namespace detail {
struct SolidNode;
struct Evaluation;
}  // namespace detail

/// The error in one line: a few words for its code, and the message.
inline std::string to_string(const Error& error) {
  return std::string(to_string(error.code)) + ": " + error.message;
}

/// How work is done, which does not change its result.
struct WorkOptions {
  int threads = 0;  ///< 0: as many as the machine has
  Progress progress = {};
};

/// How a mesh or a file becomes a solid.
struct OperandOptions {
  /// Take what the surface winds round at least once, where it crosses itself,
  /// in place of refusing it.
  bool resolve = false;
  /// Make polygons in one plane that share an edge and all properties one face
  /// before anything else: a mesh of triangles takes a third of the work.
  bool merge_coplanar = true;
  /// Let the finest grid round the coordinates, where other operands need one
  /// that does not hold them, in place of an error. So do scripts. Coordinates
  /// that no grid of 54 bits holds by themselves are rounded in any case.
  bool may_round = false;
};

/// How a surface that is no solid's is mended. What has to be done is done:
/// polygons that others cover go, borders are welded, polygons are turned to
/// agree, holes are filled, components turned outwards, and what crosses itself
/// is resolved by winding number.
struct MendOptions {
  /// Welds vertices at borders that are no farther apart, along any axis;
  /// nothing: four steps of floats of the mesh's size. Units: model units.
  std::optional<double> weld = std::nullopt;
  /// Fills borders that are half as wide as their component, too.
  bool close_all = false;
  /// Makes an open surface a shell as thick as this, in place of filling it.
  std::optional<double> thicken = std::nullopt;
};

/// Which faces in one plane become one in a result.
enum class MergeFaces : std::uint8_t {
  kOrigin,  ///< parts of one face of one operand
  kPlane,   ///< all, whatever their properties: the least surface
  kNone,
};

/// How a solid becomes a mesh.
struct MeshOptions {
  MergeFaces merge = MergeFaces::kOrigin;
  bool triangles = false;  ///< triangles only, in place of convex polygons
  int threads = 0;         ///< 0: as many as the machine has
  Progress progress = {};  ///< of working the solid out
};

/// Where a point is against a solid.
enum class Location : std::uint8_t { kInside, kOn, kOutside };

/// An affine map: (x, y, z) goes to rows[i] . (x, y, z, 1).
using AffineMap = std::array<std::array<double, 4>, 3>;

/// An outline in a plane, with or without holes; no two of these loops may
/// cross. Either direction of a loop will do. The last point of a loop is
/// joined to its first.
struct Outline {
  std::vector<Point2> points;
  std::vector<std::vector<Point2>> holes = {};
};

/// The plane normal . p = offset; its negative side is where normal . p is
/// less. Shape: normal is not zero.
struct Plane {
  Point normal;
  double offset = 0;
};

/// A region of a plane in space: its boundary, counterclockwise as seen from
/// the plane's positive side, and holes, clockwise.
struct Region {
  std::vector<Point> boundary;
  std::vector<std::vector<Point>> holes;
};

/// What rounding did on the way to a solid: all there is of it (S1.7).
struct RoundingReport {
  std::size_t moved = 0;  ///< coordinates
  double max_move = 0;    ///< no coordinate moved farther. Units: model units
  double step = 0;        ///< of the grid that all operands are on
  int grid_bits = 0;      ///< 26, 40 or 54
};

/// A solid: a value that is an expression of other solids.
///
/// An expression is worked out when something is asked of it, once, and then
/// kept. Copies are cheap and share that. Solids may be used in any threads at
/// once; what is worked out is the same in each.
///
/// Numbers: a double of at most 12 significant decimal digits is that decimal,
///   so 0.1 is one tenth; any other is the double. A mesh's coordinates are
///   decimals if all of them are such, else doubles; rounded where no grid
///   holds them.
/// Grids: all operands of a result are put on one grid of integers, of up to 54
///   bits, exactly: whatever units they came in, and however they were shifted,
///   mirrored, turned by quarter turns or scaled. Curved solids, and what was
///   moved by other maps where no grid holds that, are rounded to the grid,
///   once; rounding() says how far. From there on everything is exact.
/// Errors: functions that make and combine solids cannot fail: what is wrong
///   comes out where the solid is used, as the Result of that: the codes of
///   reading; kOutOfRange (no grid holds all operands); kOpen,
///   kInsideOut, kSelfCrossing (an operand is no solid; the message names it
///   and where); kUnbounded (a result that reaches infinitely far); kStopped.
///   What Error::index counts is said at ErrorCode.
/// Units: model units, and degrees. A file's or a mesh's numbers are in model
///   units, whatever those are.
/// Cost: making, moving and combining take no time. The first question checks
///   operands that were not made here (n log n in their polygons) and takes the
///   booleans (n log n, and what surfaces have in common); the next ones take
///   what is said at them, with n the faces.
/// Source: S6 of spec/, with the papers that it names.
class HALFSPACE_API Solid {
 public:
  /// The empty solid.
  Solid();

  /// The box between two opposite corners. Error: kZeroArea (it is flat).
  static Solid box(Point corner, Point opposite);
  /// A sphere about the origin: `segments` meridians, and half as many bands of
  /// latitude. Its vertices are on the sphere, but for rounding.
  /// Requires for this and those below: sizes above 0, segments >= 3; else the
  ///   solid has the error kOutOfRange.
  static Solid sphere(double radius, int segments = 32);
  /// A cylinder about the z axis, from z = 0 up.
  static Solid cylinder(double radius, double height, int segments = 32);
  /// A cone or, if both radii are above 0, a frustum, from z = 0 up.
  static Solid cone(double bottom_radius, double top_radius, double height,
                    int segments = 32);
  /// A ring about the z axis: `tube_radius` about a circle of `radius`.
  static Solid torus(double radius, double tube_radius, int segments = 48,
                     int tube_segments = 24);
  /// The outline in the plane z = 0, drawn up to z = height. Exact.
  static Solid prism(const Outline& outline, double height);
  /// An outline of points (r, z) with r >= 0, turned about the z axis.
  static Solid revolution(const std::vector<Point2>& outline,
                          int segments = 32);
  /// The convex hull of four points or more, not all in one plane. Exact.
  static Solid hull(std::vector<Point> points);
  /// The solid whose surface is the mesh, faces outwards.
  static Solid from_mesh(Mesh mesh, const OperandOptions& options = {});
  /// The solid in an OBJ, STL, PLY, OFF, 3MF, GLB, glTF, scene or `.hsolid`
  /// file, gzipped or not; read when it is needed. That of a `.hsolid` file is
  /// the exact solid that was saved. What else a mesh file says of its faces
  /// and their corners (materials, names, texture coordinates, normals,
  /// numbers) stays with them, and faces do not merge across it; save() writes
  /// it.
  static Solid from_file(std::filesystem::path path,
                         const OperandOptions& options = {});
  /// What a script says (docs/guide.md has the language); its files are sought
  /// from `folder`.
  static Solid from_text(std::string_view script, std::string folder = {});
  /// All points on the negative side of a plane. A result must be bounded.
  static Solid half_space(const Plane& plane);

  /// Moved. Exact where a grid holds the result; an error where none does, if
  /// the numbers are short decimals, and else rounded.
  Solid translated(Point by) const;
  /// Scaled from the origin by factors that are not 0.
  Solid scaled(double factor) const;
  Solid scaled(Point factors) const;
  /// Turned about an axis through the origin, counterclockwise as seen from
  /// where it points. Quarter turns about coordinate axes are exact.
  /// Units: degrees.
  Solid rotated(Point axis, double degrees) const;
  /// Mirrored at a plane. Planes across an axis are exact.
  Solid mirrored(const Plane& plane) const;
  /// Moved by any map. One that flattens gives the error kZeroArea.
  Solid transformed(const AffineMap& map) const;

  /// The same solid under a name, which messages and origins use.
  Solid named(std::string name) const;
  /// The name; of other operands what made them, such as "sphere", or the file.
  std::string name() const;

  /// Union, difference, intersection, symmetric difference, complement; all
  /// regularised. Of faces that coincide the first solid's is kept.
  friend HALFSPACE_API Solid operator+(const Solid& a, const Solid& b);
  friend HALFSPACE_API Solid operator-(const Solid& a, const Solid& b);
  friend HALFSPACE_API Solid operator&(const Solid& a, const Solid& b);
  friend HALFSPACE_API Solid operator^(const Solid& a, const Solid& b);
  friend HALFSPACE_API Solid operator~(const Solid& a);
  Solid& operator+=(const Solid& other) { return *this = *this + other; }
  Solid& operator-=(const Solid& other) { return *this = *this - other; }
  Solid& operator&=(const Solid& other) { return *this = *this & other; }
  Solid& operator^=(const Solid& other) { return *this = *this ^ other; }
  /// Combines many solids at once; without any, the empty solid. The same
  /// points as one after the other, in n log n.
  static Solid union_of(std::span<const Solid> solids);
  static Solid intersection_of(std::span<const Solid> solids);
  /// The parts on the negative and on the positive side of a plane.
  std::pair<Solid, Solid> split(const Plane& plane) const;

  /// The connected parts, each with its cavities; parts that only touch are
  /// apart. Each has the operands, origins and properties of the whole, and
  /// is a solid like others. Exact. Errors: those of the solid; where a part is
  /// moved by a map that rounds it away, that has the error kOutOfRange.
  Result<std::vector<Solid>> decompose() const;

  /// Whether two are the same expression, made at the same place; not whether
  /// they are the same points, which is is_empty(a ^ b).
  friend bool operator==(const Solid&, const Solid&) = default;

  /// Works the solid out now: what any question does first.
  Result<Done> evaluate(const WorkOptions& options = {}) const;
  /// The surface in doubles, with origins, and with the operands' properties if
  /// any of them has some. Equal solids of equal operands give equal meshes.
  /// Exact: rounded once, to nearest, from exact vertices; properties too.
  /// Cost:  n log n. Source: S1.8.
  Result<Mesh> mesh(const MeshOptions& options = {}) const;
  /// Writes the surface; the name of the file says the format. Grid coordinates
  /// are written exactly. A name that ends in `.hsolid` gets the solid itself,
  /// exactly (spec/solid-format.md), with no options.
  /// What a file's numbers do not hold is rounded so that it stays a solid
  /// (S6.8). Materials, names and numbers of the operands' files go with their
  /// faces, as far as the format has room (S6.9).
  /// Errors: kUnwritable, kUnknownFormat, too; kUnbounded (for `.hsolid`).
  /// Cost:   that of mesh(); where rounding makes contact, that of a boolean.
  Result<Done> save(const std::filesystem::path& path,
                    const MeshOptions& options = {}) const;
  /// The operands that the result was made of, unmoved, half-spaces last: as
  /// Origin::operand counts.
  Result<std::vector<Solid>> operands() const;
  /// How many polygons of mesh() come from operands of each name. Cost: that of
  /// mesh().
  Result<std::map<std::string, std::size_t>> polygons_by_operand() const;
  /// What rounding did to the operands. Source: S1.7.
  Result<RoundingReport> rounding() const;

  /// Whether there is no point in it.
  Result<bool> is_empty() const;
  /// The volume and the surface's area, rounded to the nearest double, in cubes
  /// and squares of model units. Cost, here and to inertia(): n.
  Result<double> volume() const;
  Result<double> area() const;
  /// The volume in full: a decimal, or a fraction such as 1/3.
  Result<std::string> exact_volume() const;
  /// The area in full, where it is rational: nothing where it is not.
  Result<std::optional<std::string>> exact_area() const;
  /// The bounding box, to the nearest doubles. Error: kEmpty.
  Result<Bounds> bounds() const;
  /// The centre of mass, to the nearest doubles; 0 where it is less than 2^-100
  /// grid steps. Error: kEmpty.
  Result<Point> centroid() const;
  /// The tensor of inertia about the centre of mass at density 1, to the
  /// nearest doubles, 0 as above: entry (i, j) is the integral of |p|^2 [i = j]
  /// - p_i p_j. Error: kEmpty.
  Result<std::array<std::array<double, 3>, 3>> inertia() const;
  /// How many connected surfaces there are, and their handles in all: 1 of a
  /// torus. Parts that only touch, at a point or along an edge, count as apart
  /// where the surface goes round the edge.
  Result<std::size_t> shell_count() const;
  Result<std::int64_t> genus() const;

  /// Where a point is. Exact. Cost: n. Error: kNotFinite.
  Result<Location> locate(Point point) const;
  /// Whether the interiors of two have a point in common; whether the closed
  /// solids have one; whether all of `other` is in this one. Exact.
  /// Cost: a boolean of both; of touches() also n log n, and the faces that are
  ///   near the other solid.
  /// Error: kUnbounded (of touches(), where a half-space by itself is beside
  ///   the other solid).
  Result<bool> overlaps(const Solid& other) const;
  Result<bool> touches(const Solid& other) const;
  Result<bool> contains(const Solid& other) const;
  /// Where a plane cuts the solid: the regions of the plane with the solid on
  /// both sides, or on its negative side. Loops of a region do not cross.
  /// Exact: rounded once, to nearest. Cost: n log n.
  /// Errors: kNotFinite, kZeroArea (of the plane).
  Result<std::vector<Region>> section(const Plane& plane) const;

 private:
  using Node = std::shared_ptr<const detail::SolidNode>;
  explicit Solid(Node node) : node_(std::move(node)) {}
  Node node_;
  friend struct detail::SolidNode;
};

/// A solid that was mended, and a sentence for each thing that was done.
struct Mended {
  Solid solid;
  std::vector<std::string> done;
};

/// The solid that the surface in a mesh file was meant to be.
///
/// Exact:  but for what is welded, or offset to a shell, yes.
/// Errors: those of reading; kOpen, kInsideOut, kEmpty: the message says what
///         is left to decide.
HALFSPACE_API Result<Mended> mended(const std::filesystem::path& path,
                                    const MendOptions& options = {});

}  // namespace halfspace
