#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "map/line_table.hpp"

namespace halfspace::fast {

/// A node of the cell tree; from -4 to -1 the sides of the image rectangle.
using CellNodeId = std::int32_t;

/// An edge of a convex polygon of the image. The polygon's edges go round it
/// with the interior on the side of `side`.
struct CellEdge {
  LineId line = 0;
  std::int32_t side = 1;  ///< the sign of the line inside
  CellNodeId node = 0;    ///< the node whose line it is a part of
  MapPoint start;         ///< where the edge before it meets this one
};

/// A side of a fragment in the image: where the line has the sign `side`.
struct HalfPlane {
  LineId line = 0;
  std::int32_t side = 1;
};

constexpr int kSomeNegative = 1;
constexpr int kSomePositive = 2;

/// Cuts convex polygons of the image along lines, exactly.
class ConvexCutter {
 public:
  explicit ConvexCutter(LineTable& lines) : lines_(lines) {}

  /// The image rectangle: the top side first, in positive turns from x to y.
  /// Its edges are those of nodes -3, -2, -1 and -4.
  std::vector<CellEdge> rectangle() const;
  /// Remembers the signs of a line at the starts of the edges. Returns whether
  /// some are negative and some positive, added up.
  int classify(std::span<const CellEdge> polygon, LineId line);
  /// The parts of a polygon on the two sides of a line that was just asked
  /// about: appended.
  void cut(std::span<const CellEdge> polygon, LineId line, CellNodeId node,
           std::vector<CellEdge>& positive,
           std::vector<CellEdge>& negative) const;
  /// Leaves what is within a half-plane; whether that is anything.
  bool clip(std::vector<CellEdge>& polygon, const HalfPlane& side,
            CellNodeId node);

 private:
  LineTable& lines_;
  std::vector<std::int8_t> signs_;
  std::vector<CellEdge> positive_;
  std::vector<CellEdge> negative_;
};

}  // namespace halfspace::fast
