#include "ray/ray_line.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace halfspace::fast {

RayLine::RayLine(const LatticeVector& origin, const LatticeVector& direction,
                 Reach reach, int shift, int grid_bits) {
  const double step = std::ldexp(1.0, -shift);
  origin_ = {step * to_double(origin.x), step * to_double(origin.y),
             step * to_double(origin.z)};
  direction_ = {step * to_double(direction.x), step * to_double(direction.y),
                step * to_double(direction.z)};
  const double limit = std::ldexp(1.0, grid_bits - 1);
  double farthest = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    inverse_[a] = 1 / direction_[a];
    farthest = std::max(farthest, std::abs(origin_[a]));
    longest_ = std::max(longest_, std::abs(direction_[a]));
    sum_ += std::abs(direction_[a]);
  }
  reach_ = farthest + limit;
  range_ = {
      reach == Reach::kLine ? -kInfinity : 0,
      reach == Reach::kSegment || reach == Reach::kBetween ? 1 : kInfinity};
  meet_grid(limit);
}

/// Leaves the parameters with which it is in the grid, and a little more: 2^-20
/// of the grid outweighs all roundings, which are 2^-50 of 2^6 grids.
void RayLine::meet_grid(double limit) {
  const auto wide = static_cast<float>(limit * (1 + 0x1p-20));
  range_ = clipped(range_, {{-wide, -wide, -wide}, {wide, wide, wide}});
}

std::optional<ParameterRange> RayLine::meet(const FilterPlane& plane) const {
  const double slope = along(plane.plane);
  // Half of the slope is sure then: the quotient below is off by no more than
  // twice the error of the value over the slope, and roundings of 3u.
  if (!(std::abs(slope) > 2 * slope_error(plane))) return std::nullopt;
  const double t = -at_origin(plane.plane) / slope;
  const double doubt = 2 * error_at(plane, t) / std::abs(slope);
  return ParameterRange{t - doubt, t + doubt};
}

/// The origin is off by u E, and a point by u of |t| D, which is at most
/// E + M where the box is: 16u (E + M) outweighs both. Quotients are off by 3u
/// of themselves. A direction of 0 makes infinities of the right signs, or
/// where the origin is on the widened box no number, which decides nothing.
ParameterRange RayLine::clipped(ParameterRange range, const Box& box) const {
  const double margin = 16 * kRounding * reach_;
  for (std::size_t a = 0; a < 3; ++a) {
    double near = (double{box.low[a]} - margin - origin_[a]) * inverse_[a];
    double far = (double{box.high[a]} + margin - origin_[a]) * inverse_[a];
    if (inverse_[a] < 0) std::swap(near, far);
    near -= 8 * kRounding * std::abs(near);
    far += 8 * kRounding * std::abs(far);
    if (near > range.first) range.first = near;
    if (far < range.last) range.last = far;
  }
  return range;
}

/// By the signs of direction . (p x q) for its edges, with p and q from the
/// origin. Let m bound the sizes of the coordinates of p and q, and e how far
/// they are off: the vertex's own error, and 4u (E + M) for the origin and the
/// difference. Then p x q is off by 4 m e + 2 e^2 and 4u of 2 m^2, and the
/// product with the direction, itself off by u, by another 4u: 40u m^2 a
/// component with room for the bound's own roundings.
int RayLine::passes(const TreeReader& reader,
                    const TreeFragment& fragment) const {
  struct At {
    double x, y, z, size, error;
  };
  const auto at = [&](const Corner& corner) {
    const Vertex v = reader.vertex(corner.vertex);
    const double x = v.x - origin_[0];
    const double y = v.y - origin_[1];
    const double z = v.z - origin_[2];
    return At{x, y, z, std::max({std::abs(x), std::abs(y), std::abs(z)}),
              v.error + 4 * kRounding * reach_};
  };
  const auto corners = reader.corners(fragment);
  At p = at(corners.back());
  bool some_left = false;
  bool some_right = false;
  bool sure = true;
  for (const Corner& corner : corners) {
    const At q = at(corner);
    const double side = direction_[0] * (p.y * q.z - p.z * q.y) +
                        direction_[1] * (p.z * q.x - p.x * q.z) +
                        direction_[2] * (p.x * q.y - p.y * q.x);
    const double m = std::max(p.size, q.size);
    const double e = std::max(p.error, q.error);
    const int sign = filtered_sign(
        {side, sum_ * (4 * m * e + 2 * e * e + 40 * kRounding * m * m)});
    some_left = some_left || sign > 0;
    some_right = some_right || sign < 0;
    if (some_left && some_right) return -1;
    sure = sure && sign != 0;
    p = q;
  }
  return sure ? 1 : 0;
}

}  // namespace halfspace::fast
