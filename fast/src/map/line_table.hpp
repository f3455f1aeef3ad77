#pragma once

#include <cstdint>
#include <limits>
#include <unordered_map>
#include <vector>

#include "camera/clip_function.hpp"
#include "camera/edge_function.hpp"
#include "halfspace/fast/render.hpp"
#include "halfspace/fast/visible_map.hpp"
#include "tree/tree_reader.hpp"

namespace halfspace::fast {

using LineId = std::int32_t;

/// Clip plane k, where lines are named by planes.
constexpr PlaneId plane_id_of_clip(std::size_t k) {
  return -2 - static_cast<PlaneId>(k);
}

/// A point of the image where two lines meet, in twice the image's
/// coordinates. Either coordinate is off by at most `error`; infinite if
/// doubles know nothing.
struct MapPoint {
  double x = 0;
  double y = 0;
  float error = 0;
  VertexId vertex = -1;  ///< the vertex of the scene that is seen there, if one
};

/// The sides of the rectangle, which every table begins with. The left and the
/// top one are positive inside.
constexpr LineId kLeftSide = 0;
constexpr LineId kTopSide = 1;
constexpr LineId kRightSide = 2;
constexpr LineId kBottomSide = 3;

/// The lines of a map (S7.1) and what is decided about them: on which side of a
/// line a point is, where two others meet, and how two lines turn.
///
/// A line is kept in doubles and by name, and made again from its name where
/// doubles cannot decide.
class LineTable {
 public:
  /// The first four lines are the sides of a rectangle of the image.
  LineTable(const TreeReader& reader, const CameraData& camera,
            const Rectangle& rectangle,
            const std::vector<ClipPlane>& clips = {});

  /// The image of a source edge, positive on the side that edge_function()
  /// says.
  LineId edge(VertexId from, VertexId to);
  /// Where two planes are seen to meet, as meet_function().
  LineId meet(PolygonId support, PlaneId splitter);
  /// Where a polygon passes the near distance, as near_function().
  LineId near(PolygonId polygon);
  /// Where a clip plane is as far away as can be: positive where its function
  /// grows towards the image point (S10.3).
  LineId horizon(PlaneId clip) { return named(Kind::kHorizon, clip, 0); }
  /// x + y, or x - y, less a number of half pixels: an edge of hatching.
  LineId stripe(bool is_sum, std::int32_t halves) {
    return named(is_sum ? Kind::kSum : Kind::kDifference, halves, 0);
  }
  /// x or y less a coordinate in pixels: a line that only divides.
  LineId upright(std::int32_t x) { return axis(Kind::kColumn, x); }
  LineId level(std::int32_t y) { return axis(Kind::kRow, y); }

  /// The sign of a line at the point where two others meet.
  /// Requires: `point` is that of `a` and `b`, which are not parallel.
  int side_of(LineId line, LineId a, LineId b, const MapPoint& point) {
    if (line == a || line == b) return 0;
    const Line& l = lines_[static_cast<std::size_t>(line)];
    if (point.vertex >= 0 && (point.vertex == l.from || point.vertex == l.to))
      return 0;
    const double x = l.a * point.x;
    const double y = l.b * point.y;
    const double value = x + y + l.c;
    const double bound =
        (std::abs(l.a) + std::abs(l.b)) * point.error +
        8 * kRounding * (std::abs(x) + std::abs(y) + std::abs(l.c));
    if (value > bound * kMargin || value < -bound * kMargin) {
      ++stats_.filtered;
      return value > 0 ? 1 : -1;
    }
    return exact_side(line, a, b);
  }

  /// Whether the function is 0 everywhere: that of a plane with itself.
  bool is_zero(LineId line) const {
    // No number of so few bits rounds to 0.
    const Line& l = at(line);
    return l.a == 0 && l.b == 0 && l.c == 0;
  }
  /// The side of a plane that the eye is on.
  int side_of_eye(PlaneId plane) const;

  /// The sign of a1 b2 - b1 a2, 0 if they are parallel.
  int turn(LineId a, LineId b);

  /// Where two lines meet. Requires: they are not parallel.
  MapPoint point(LineId a, LineId b) const;

  /// The same to the nearest doubles, halved: in pixels.
  MapVertex vertex(LineId a, LineId b) const;

  /// The order of two vertices by x, then y, exactly: -1, 0 or 1.
  int compare(const std::array<LineId, 2>& p,
              const std::array<LineId, 2>& q) const;

  MapLine exact(LineId line) const;
  double slope_x(LineId line) const { return at(line).a; }
  double slope_y(LineId line) const { return at(line).b; }
  double offset(LineId line) const { return at(line).c; }
  /// The power of two that the line's function is more than these.
  int exponent(LineId line) const { return at(line).exponent; }
  const FilterStats& stats() const { return stats_; }
  /// Frees what finds lines again by name: no more are made by it.
  void forget_names() {
    // `= {}` would keep the buckets.
    edges_ = std::unordered_map<std::uint64_t, LineId>();
    meets_ = std::unordered_map<std::uint64_t, LineId>();
  }

 private:
  enum class Kind : std::uint8_t {
    kColumn,
    kRow,
    kEdge,
    kMeet,
    kNear,
    kHorizon,
    kSum,
    kDifference
  };

  /// The doubles are off by 2^-52 of themselves; the greater of `a` and `b` is
  /// at least 1 and less than 2 in size.
  struct Line {
    double a = 0;
    double b = 0;
    double c = 0;
    VertexId from = -1;  ///< the scene's vertices that it passes, if any
    VertexId to = -1;
    std::int32_t first = 0;  ///< its name, with what kind it is of
    std::int32_t second = 0;
    Kind kind = Kind::kColumn;
    std::int16_t exponent = 0;
  };
  static constexpr double kMargin = 1 + 0x1p-40;

  const Line& at(LineId line) const {
    return lines_[static_cast<std::size_t>(line)];
  }
  LineId axis(Kind kind, std::int32_t coordinate);
  /// The line of this name, made if it is new.
  LineId named(Kind kind, std::int32_t first, std::int32_t second);
  template <int kBits>
  ProjectedPlane<kBits> seen(PlaneId plane) const;
  template <int kBits>
  EdgeFunction<Grid<kBits>::kWords> exact_line(const Line& line) const;
  int exact_side(LineId line, LineId a, LineId b);

  const TreeReader& reader_;
  const CameraData& camera_;
  const std::vector<ClipPlane> clips_;
  int grid_bits_;
  std::vector<Line> lines_;
  std::unordered_map<std::uint64_t, LineId> edges_;
  std::unordered_map<std::uint64_t, LineId> meets_;
  FilterStats stats_;
};

}  // namespace halfspace::fast
