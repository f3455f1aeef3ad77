#pragma once

#include <cstddef>
#include <cstdint>

#include "halfspace/fast/list.hpp"
#include "halfspace/fast/solid.hpp"
#include "table/shared_table.hpp"

namespace halfspace::fast {

/// Whether they are looked for: not in a module for the web, for its size.
#if defined(__wasm__)
constexpr bool kHasFlatStars = false;
#else
constexpr bool kHasFlatStars = true;
#endif

/// Tells at once of most triangles of a closed surface that are near each other
/// that they have nothing in common but a corner or an edge that both have.
///
/// Those with a common corner: let all faces at a vertex v be triangles that
/// are seen from one side along some axis, so that in that projection each
/// turns about v by less than half a turn, all in one direction. The surface is
/// closed, so they can be put in rows that lead back to where they began, and
/// each row turns about v a whole number of times. Where rows turn once in all
/// there is one row, and its triangles lie side by side: a flat star. Two of
/// them have the corner in common, or the edge, which no other face has. A row
/// goes from the points less than v to the greater ones, in the lexicographic
/// order of the projection, once for each of its turns. So turns are counted by
/// comparing coordinates.
///
/// Those without one: they are apart if one is on one side of the other's
/// plane, in doubles.
///
/// Exact:   yes. Vertices that are not on the grid have no flat star.
/// Threads: any; nothing is added to the table.
/// Source:  that what is seen from one side, and does not cross itself in
///          projection, does not cross itself: VMT94.
class FlatStars {
 public:
  /// Requires: the surface is closed, if `is_closed`; else nothing is known.
  FlatStars(const Solid& solid, bool is_closed);

  /// Begins to fetch what is known of a face, and then its plane: settle()
  /// reads that of the first of its faces.
  void prefetch(std::int32_t f) const {
    if (kHasFlatStars && !triangles_.empty())
      __builtin_prefetch(&triangles_[static_cast<std::size_t>(f)]);
  }
  void prefetch_plane(std::int32_t f) const {
    if (!kHasFlatStars || triangles_.empty()) return;
    const std::int32_t plane = triangles_[static_cast<std::size_t>(f)][3];
    if (plane >= 0) __builtin_prefetch(&table_.plane(plane));
  }

  /// Whether that is known of two faces, which are not one.
  bool settle(std::int32_t f, std::int32_t g) const {
    if (!kHasFlatStars || triangles_.empty()) return false;
    const Four a = triangles_[static_cast<std::size_t>(f)];
    const Four b = triangles_[static_cast<std::size_t>(g)];
    const Four equal = (a == Four{b[0], b[1], b[2], 0}) |
                       (a == Four{b[1], b[2], b[0], 0}) |
                       (a == Four{b[2], b[0], b[1], 0});
    // Ids of corners with flat stars are not negative, others are.
    const Four flat = equal & (a >= 0);
    if ((flat[0] | flat[1] | flat[2]) != 0) return true;
    if ((equal[0] | equal[1] | equal[2]) != 0) return false;
    return is_beside(a, b) || is_beside(b, a);
  }

 private:
  /// The corners of a triangle, ids of those without flat stars complemented,
  /// and its plane. What is no triangle has numbers that no other face has, and
  /// -1.
  using Four = std::int32_t __attribute__((vector_size(16)));

  /// Whether triangle `b`, which has no corner of `a`, is surely on one side of
  /// the plane of `a`.
  bool is_beside(const Four& b, const Four& a) const {
    if (a[3] < 0 || b[3] < 0) return false;
    const FilterPlane& plane = table_.plane(a[3]).filter;
    int sum = 0;
    for (int k = 0; k < 3; ++k) {
      const std::int32_t v = b[k] < 0 ? ~b[k] : b[k];
      sum += filtered_sign(
          value_at(plane, table_.vertex(v).approximate, table_.rounding()));
    }
    return sum == 3 || sum == -3;
  }

  const GeometryTable& table_;
  List<Four> triangles_;  ///< by face, if anything is known
};

}  // namespace halfspace::fast
