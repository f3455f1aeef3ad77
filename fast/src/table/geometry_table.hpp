#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/hash_index.hpp"
#include "exact/canonical_plane.hpp"
#include "exact/exact_plane.hpp"
#include "exact/filter.hpp"
#include "halfspace/polygon.hpp"
#include "table/append_list.hpp"

namespace halfspace::fast {

inline double coordinate(const Vertex& v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

/// A plane as a point set, in doubles, and a grid point on it.
struct TablePlane {
  FilterPlane filter;
  GridPoint origin;
};

/// A point: one of the grid, or the meet of three planes.
struct TableVertex {
  static constexpr std::uint32_t kOnGrid = 0xffffffff;

  Vertex approximate;
  std::array<std::int32_t, 3> planes{-1, -1, -1};  ///< where it was met
  /// Where its exact coordinates begin, if it is not on the grid.
  std::uint32_t exact = kOnGrid;
  bool is_grid() const { return exact == kOnGrid; }
  /// Requires: is_grid(). Exact: coordinates have 53 bits and a sign.
  GridPoint point() const {
    return {static_cast<std::int64_t>(approximate.x),
            static_cast<std::int64_t>(approximate.y),
            static_cast<std::int64_t>(approximate.z)};
  }
};

/// Where three planes meet, before it has an id: see
/// GeometryTable::ask_meet().
struct AskedMeet {
  std::array<std::int32_t, 3> planes{-1, -1, -1};  ///< ascending
  std::int32_t known = -1;                         ///< its id, if it has one
  std::uint64_t triple_hash = 0;                   ///< of the planes
  bool is_computed = false;                        ///< what follows is known
  bool is_grid = false;
  std::uint64_t hash = 0;  ///< of the point
  Vertex approximate;
  std::size_t first_word = 0;  ///< of its coordinates, if it is not on the grid
};

/// A plane with an orientation: `flipped` if against the table's.
struct OrientedPlane {
  std::int32_t plane = -1;
  bool flipped = false;
};

/// The planes and points of solids, each interned: equal planes have equal ids,
/// and so do equal points.
///
/// Points are made from planes and planes only from points of the grid, so no
/// number outgrows the bit budget (S1.6), however long the chain of booleans
/// (plane-based representation: SI89, BF09).
///
/// Threads: const functions may run beside one thread that extends the table,
/// on planes and points known before. plane_count() and vertex_count() are for
/// that thread.
class GeometryTable {
 public:
  explicit GeometryTable(int grid_bits)
      : grid_bits_(grid_bits), rounding_(rounding_of_values(grid_bits)) {}

  int grid_bits() const { return grid_bits_; }
  double rounding() const { return rounding_; }
  std::size_t plane_count() const { return planes_.size(); }
  std::size_t vertex_count() const { return vertices_.size(); }
  const TablePlane& plane(std::int32_t p) const {
    return planes_[static_cast<std::size_t>(p)];
  }
  const TableVertex& vertex(std::int32_t v) const {
    return vertices_[static_cast<std::size_t>(v)];
  }
  /// Begins to fetch what vertex() will give.
  void prefetch_vertex(std::int32_t v) const { __builtin_prefetch(&vertex(v)); }
  /// The plane's normal, exactly: its first component that is not zero is
  /// positive. Its components may have a common divisor.
  Vector3<Int128> normal(std::int32_t plane) const;
  /// The normal divided by its components' greatest common divisor.
  Vector3<Int128> reduced_normal(std::int32_t plane) const;

  /// Takes planes and points of another table, which get the ids 0, 1, 2, ...
  /// in this order: as add_plane(), add_point() and meet() would make them, in
  /// less time. Leaves memory for little else.
  ///
  /// Requires: this table is empty, of the same grid; no id is there twice;
  ///           planes that meet in the points are among the planes. Nothing
  ///           extends the other table meanwhile.
  void copy(const GeometryTable& from, std::span<const std::int32_t> planes,
            std::span<const std::int32_t> points);
  /// Makes room for more points of the grid and planes.
  void reserve(std::size_t points, std::size_t planes);
  /// The same for points where planes meet, most of them not on the grid.
  void reserve_meets(std::size_t points);
  std::int32_t add_point(const GridPoint& point);
  /// The same for many at once, which takes less time; adds them to `ids`.
  void add_points(std::span<const GridPoint> points,
                  std::vector<std::int32_t>& ids);
  /// The plane of a polygon with these defining corners (S1.4).
  OrientedPlane add_plane(const std::array<GridPoint, 3>& corners);
  /// The same for many at once, which takes less time; adds them to `planes`.
  void add_planes(std::span<const std::array<GridPoint, 3>> corners,
                  std::vector<OrientedPlane>& planes);
  /// The plane through `origin` with this normal.
  /// Requires: it is the plane of a polygon on the grid, or of add_line_plane.
  OrientedPlane add_plane(const Vector3<Int128>& normal,
                          const GridPoint& origin);
  /// The plane through two points of the grid and along an axis, not theirs.
  std::int32_t add_line_plane(std::int32_t u, std::int32_t v, int axis);
  /// Where three planes meet.
  /// Requires: in one point.
  std::int32_t meet(std::int32_t p, std::int32_t q, std::int32_t r);
  /// The same in two steps, so that threads may share the first one, while
  /// nothing extends the table: whether the point is known, and if it is not
  /// and `computes`, its coordinates, which are added to `words`.
  AskedMeet ask_meet(std::int32_t p, std::int32_t q, std::int32_t r,
                     bool computes, std::vector<std::uint64_t>& words) const;
  /// Begins to fetch what add_asked() reads.
  void prefetch_asked(const AskedMeet& asked) const {
    triple_index_.prefetch(asked.triple_hash);
    vertex_index_.prefetch(asked.hash);
  }
  /// The point's id. `words`: those that ask_meet() added to.
  std::int32_t add_asked(const AskedMeet& asked,
                         std::span<const std::uint64_t> words);

  /// -1, 0, 1: the side of the plane, as it stands in the table, that holds
  /// the point.
  int side(std::int32_t plane_id, std::int32_t vertex_id) const {
    const int known = filtered_sign(value_at(
        plane(plane_id).filter, vertex(vertex_id).approximate, rounding_));
    return known != 0 ? known : side_exactly(plane_id, vertex_id);
  }
  /// -1, 0, 1 as the first point's coordinate is less than, equal to or
  /// greater than the second's.
  int compare(int axis, std::int32_t u, std::int32_t v) const {
    const Vertex& a = vertex(u).approximate;
    const Vertex& b = vertex(v).approximate;
    const double d = coordinate(a, axis) - coordinate(b, axis);
    const double error = (a.error + b.error) * (1 + 0x1p-50);
    if (d > error) return 1;
    if (d < -error) return -1;
    return u == v || error == 0 ? 0 : compare_exactly(axis, u, v);
  }
  /// The sign of the determinant of q - p and r - p, in the coordinates `axis`
  /// + 1 and `axis` + 2 (cyclically): their turn as seen against the axis.
  int turn(int axis, std::int32_t p, std::int32_t q, std::int32_t r) const;
  /// The sign of component `axis` of the cross product of two normals.
  int cross_sign(int axis, std::int32_t p, std::int32_t q) const;
  /// The sign of the product of two normals.
  int dot_sign(std::int32_t p, std::int32_t q) const;
  /// The sign of a component of the normal.
  int normal_sign(std::int32_t plane, int axis) const;

  /// The coordinates as the nearest doubles, ties to even. `rounded`: whether
  /// one of them is off.
  std::array<double, 3> nearest(std::int32_t vertex, bool& rounded) const;

  /// Whether the planes are not parallel. If so, `axis` is the one along which
  /// their line runs the most, as far as doubles are sure.
  bool line_axis(std::int32_t p, std::int32_t q, int& axis) const;
  /// The axis along which two different points differ the most, as far as
  /// doubles are sure.
  int edge_axis(std::int32_t u, std::int32_t v) const;

 private:
  /// Three planes that were met, and where.
  struct Triple {
    std::array<std::int32_t, 3> planes;
    std::int32_t vertex;
  };

  int side_exactly(std::int32_t plane, std::int32_t vertex) const;
  int compare_exactly(int axis, std::int32_t u, std::int32_t v) const;
  std::int32_t enter_point(const GridPoint& point, std::uint64_t hash);
  template <int kBits>
  OrientedPlane enter(const CanonicalPlane<kBits>& plane);
  std::int32_t known_meet(const std::array<std::int32_t, 3>& planes,
                          std::uint64_t hash) const;
  std::int32_t note_triple(const std::array<std::int32_t, 3>& planes,
                           std::uint64_t hash, std::int32_t vertex);
  template <int kBits>
  std::uint64_t make_exact(
      TableVertex& v,
      std::array<typename Grid<kBits>::Determinant, 4>& c) const;
  template <int kBits>
  ExactPlane<kBits> exact_at(std::int32_t plane) const;
  template <int kBits>
  std::array<typename Grid<kBits>::Determinant, 4> exact(
      std::int32_t vertex) const;
  template <int kBits>
  bool put_on_grid(
      TableVertex& v,
      const std::array<typename Grid<kBits>::Determinant, 4>& c) const;
  std::int32_t add_meet(const std::array<std::int32_t, 3>& planes);
  std::size_t words_of_meet() const;
  template <class Append>
  std::int32_t enter_meet(TableVertex& v, std::uint64_t hash,
                          const Append& append);

  int grid_bits_;
  double rounding_;
  AppendList<TablePlane> planes_;
  /// By plane: its normal, on grids where doubles do not hold it.
  AppendList<Vector3<Int128>> normals_;
  AppendList<TableVertex> vertices_;
  AppendList<std::uint64_t> exact_;
  AppendList<Triple> triples_;
  HashIndex plane_index_;
  HashIndex vertex_index_;
  HashIndex triple_index_;
};

}  // namespace halfspace::fast
