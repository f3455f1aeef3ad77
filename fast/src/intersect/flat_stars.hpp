#pragma once

#include <cstddef>
#include <cstdint>

#include "exact/flat_star.hpp"
#include "halfspace/fast/list.hpp"
#include "halfspace/fast/solid.hpp"
#include "table/shared_table.hpp"

namespace halfspace::fast {

/// Tells at once of most triangles of a closed surface that are near each other
/// that they have nothing in common but a corner or an edge that both have.
///
/// Those with a common corner: by its flat star (FlatStar), where all faces at
/// the vertex are triangles.
///
/// Those without one: they are apart if one is on one side of the other's
/// plane, in doubles.
///
/// Exact:   yes. Vertices that are not on the grid have no flat star.
/// Threads: any; nothing is added to the table.
/// Source:  VMT94.
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
    const StarCorners a = triangles_[static_cast<std::size_t>(f)];
    const StarCorners b = triangles_[static_cast<std::size_t>(g)];
    const Common common = common_of(a, b);
    if (common != Common::kNothing) return common == Common::kFlatStar;
    return is_beside(a, b) || is_beside(b, a);
  }

 private:
  /// Whether triangle `b`, which has no corner of `a`, is surely on one side of
  /// the plane of `a`.
  bool is_beside(const StarCorners& b, const StarCorners& a) const {
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
  /// By face, if anything is known, with its plane. What is no triangle has
  /// numbers that no other face has, and -1.
  List<StarCorners> triangles_;
};

}  // namespace halfspace::fast
