#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "halfspace/polygon.hpp"
#include "halfspace/result.hpp"

namespace halfspace {

/// A region's hull has at most so many points (S12.1).
constexpr std::size_t kMostHullPoints = 30;

/// A plane by three points that are not on one line (S1.4). Of a face they are
/// points of the region, which is on the positive side of the plane, and in it.
using RegionFace = std::array<GridPoint, 3>;

/// A convex region, boundary included (S12.1): a box with faces across the
/// axes, or the convex hull of points. Units: grid steps of the owner.
struct ObjectRegion {
  GridPoint low;
  GridPoint high;
  /// Without points the box is the region. Else their convex hull is, and the
  /// box is the least that holds them.
  std::vector<GridPoint> hull = {};
  /// The faces of the hull that are not across an axis: what is in the box and
  /// on the positive side of all of them is the region.
  std::vector<RegionFace> slanted = {};
  friend bool operator==(const ObjectRegion&, const ObjectRegion&) = default;
};

/// The convex hull of points (S12.1); some may be inside.
///
/// Errors: kOutOfRange: fewer than 4 points, more than kMostHullPoints, or all
///         of them in one plane.
/// Exact:  yes.
/// Cost:   the fourth power of their number.
Result<ObjectRegion> hull_region(std::vector<GridPoint> points);

/// The points whose convex hull the region is: the hull's, or the eight corners
/// of the box.
std::vector<GridPoint> corners_of(const ObjectRegion& region);

/// The sign of a face's plane at a point. Exact: yes.
int side_of(const RegionFace& face, const GridPoint& p);

/// A plane that has one region on one side and the other on the other, each in
/// part on the plane maybe; nothing if they have a common inner point (S12.1).
///
/// Its first point is one of the grid, and the others are beyond it by no more
/// than the grid's size.
/// Exact: yes: planes along a face of one, or along an edge of each, part two
///        convex sets if any plane does.
std::optional<RegionFace> parting_plane(const ObjectRegion& a,
                                        const ObjectRegion& b);

/// Whether two regions have a common inner point (S12.1). Exact: yes.
bool share_space(const ObjectRegion& a, const ObjectRegion& b);

}  // namespace halfspace
