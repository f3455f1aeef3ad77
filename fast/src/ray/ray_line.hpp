#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "exact/filter.hpp"
#include "halfspace/camera.hpp"
#include "halfspace/fast/types.hpp"
#include "halfspace/ray.hpp"
#include "tree/tree_reader.hpp"

namespace halfspace::fast {

/// Beyond every parameter.
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// From which parameter to which; empty where first > last.
struct ParameterRange {
  double first = 0;
  double last = 0;
};

/// A ray in doubles, as it passes the scene. Everything here errs on the side
/// of what is nearer: what it rules out is not there.
///
/// With u = 2^-53, E the greatest of the origin's coordinates in size, D of the
/// direction's, M = 2^(n-1) and N the sum of a normal's sizes: the value of a
/// plane at p(t) is A + t B with A = n.origin + d and B = n.direction. A is off
/// by 7u (N E + N M), for its coefficients are by 2u, the origin by u, a
/// product by u and three sums by 3u; B in the same way by 6u N D. Multiplying
/// and adding A and t B adds 2u of N (E + M) + |t| N D. So 16u N (E + M + |t|
/// D) bounds all of it.
class RayLine {
 public:
  /// Units: 2^-shift grid steps.
  RayLine(const LatticeVector& origin, const LatticeVector& direction,
          Reach reach, int shift, int grid_bits);

  /// The parameters with which it can meet the scene.
  const ParameterRange& range() const { return range_; }

  /// The value of a plane at parameter t.
  Bounded value_at(const FilterPlane& plane, double t) const {
    const double value = at_origin(plane.plane) + t * along(plane.plane);
    return {value, error_at(plane, t)};
  }

  /// Between which parameters it meets a plane; nothing if it may run along it.
  std::optional<ParameterRange> meet(const FilterPlane& plane) const;

  /// On which side of a plane it goes, or 0 if that is in doubt.
  int direction_sign(const FilterPlane& plane) const {
    return filtered_sign({along(plane.plane), slope_error(plane)});
  }

  /// The part of a range that can be in the box.
  ParameterRange clipped(ParameterRange range, const Box& box) const;

  /// Whether it passes within a fragment: 1 and -1 for yes and no, 0 if that is
  /// in doubt.
  int passes(const TreeReader& reader, const TreeFragment& fragment) const;

 private:
  double at_origin(const Plane& p) const {
    return p.a * origin_[0] + p.b * origin_[1] + p.c * origin_[2] + p.d;
  }
  double along(const Plane& p) const {
    return p.a * direction_[0] + p.b * direction_[1] + p.c * direction_[2];
  }
  double error_at(const FilterPlane& plane, double t) const {
    return 16 * kRounding * plane.size * (reach_ + std::abs(t) * longest_);
  }
  double slope_error(const FilterPlane& plane) const {
    return 8 * kRounding * plane.size * longest_;
  }
  void meet_grid(double limit);

  std::array<double, 3> origin_;
  std::array<double, 3> direction_;
  std::array<double, 3> inverse_;
  double reach_ = 0;    ///< E + M
  double longest_ = 0;  ///< D
  double sum_ = 0;      ///< of the direction's sizes
  ParameterRange range_;
};

}  // namespace halfspace::fast
