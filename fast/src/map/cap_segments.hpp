#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "exact/big_rational.hpp"
#include "halfspace/image.hpp"
#include "map/line_table.hpp"
#include "raster/cap_windings.hpp"

namespace halfspace::fast {

/// A point of a clip plane: exactly by two of its coordinates in space, and
/// all three in doubles, each off by some 2^-50 of itself.
struct CapPoint {
  BigRational u;
  BigRational v;
  std::array<double, 3> near{};
  double near_u = 0;
  double near_v = 0;
};

/// Where a polygon passes through a clip plane: going from `from` to `to` seen
/// with the kept side up, the solid is on the right.
struct CapSegment {
  PolygonId polygon = 0;
  CapPoint from;
  CapPoint to;
};

/// The segments in which polygons pass through a clip plane, moved by nothing
/// towards what is kept (S10.3), and the winding numbers between them.
class CapSegments {
 public:
  CapSegments(const TreeReader& reader, const CameraData& camera,
              const ClipPlane& clip);

  const std::vector<CapSegment>& all() const { return segments_; }

  /// Moves winding numbers from where they are 0 to the point of the plane that
  /// is seen at an image point, in twice the image's coordinates.
  /// Requires: no segment is seen there, nor is the plane edge-on.
  void add_at(const BigRational& x, const BigRational& y,
              CapWindings& windings) const;

 private:
  void add(PolygonId polygon);
  CapPoint point_between(const GridPoint& p, const GridPoint& q) const;
  CapPoint seen_at(const BigRational& x, const BigRational& y) const;

  const Scene& scene_;
  const CameraData& camera_;
  const ClipPlane& clip_;
  std::size_t u_ = 0;  ///< the axes that a point is told by
  std::size_t v_ = 1;
  int turn_ = 1;  ///< whether u and v turn as the plane does, seen from above
  std::vector<CapSegment> segments_;
};

}  // namespace halfspace::fast
