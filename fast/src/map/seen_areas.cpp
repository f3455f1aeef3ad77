#include "halfspace/fast/image/seen_areas.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <map>
#include <optional>
#include <utility>

#include "exact/big_rational.hpp"
#include "map/exact_moments.hpp"

namespace halfspace::fast {
namespace {

/// Enough digits that what sums of millions of arcs lose is far below a
/// double's last.
using Real =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<60>,
                                  boost::multiprecision::et_off>;
using RealVector = std::array<Real, 3>;

Real real_of(const Int128& value) {
  const bool negative = value < 0;
  const auto size = negative ? Uint128{0} - static_cast<Uint128>(value)
                             : static_cast<Uint128>(value);
  Real result = static_cast<std::uint64_t>(size >> 64);
  result = ldexp(result, 64) + static_cast<std::uint64_t>(size);
  return negative ? Real(-result) : result;
}

Real real_of(const BigRational& value) {
  return Real(numerator(value)) / Real(denominator(value));
}

RealVector real_of(const LatticeVector& v) {
  return {real_of(v.x), real_of(v.y), real_of(v.z)};
}

Real dot(const RealVector& u, const RealVector& v) {
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

RealVector cross(const RealVector& u, const RealVector& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
          u[0] * v[1] - u[1] * v[0]};
}

/// The rays of a perspective camera, and the solid angles between them.
class RayBundle {
 public:
  explicit RayBundle(const Camera& camera)
      : origin_(real_of(camera->s0)),
        across_(real_of(camera->sx)),
        down_(real_of(camera->sy)) {
    const RealVector eye = real_of(camera->eye);
    for (std::size_t k = 0; k < 3; ++k) origin_[k] -= eye[k];
    is_mirrored_ = dot(origin_, cross(across_, down_)) < 0;
    middle_ = unit_ray(Real(camera->width_px) / 2, Real(camera->height_px) / 2);
  }

  /// The solid angle of the triangle of the image's middle and two points,
  /// positive if they go round it as x and y do (OOS83).
  Real triangle(const RealVector& p, const RealVector& q) const {
    const Real sine = dot(middle_, cross(p, q));
    const Real cosine = 1 + dot(middle_, p) + dot(middle_, q) + dot(p, q);
    const Real angle = 2 * atan2(sine, cosine);
    return is_mirrored_ ? Real(-angle) : angle;
  }

  RealVector unit_ray(const Real& x, const Real& y) const {
    RealVector ray;
    for (std::size_t k = 0; k < 3; ++k)
      ray[k] = origin_[k] + x * across_[k] + y * down_[k];
    const Real length = sqrt(dot(ray, ray));
    for (Real& component : ray) component /= length;
    return ray;
  }

 private:
  RealVector origin_, across_, down_;
  RealVector middle_;
  bool is_mirrored_ = false;
};

struct RealArea {
  Real twice_area = 0;
  Real size = 0;  ///< the sum of what twice_area adds up, without signs
  Real solid_angle = 0;
};

/// A vertex of the map and the ray through it.
struct SeenPoint {
  Real x, y;
  RealVector ray;
};

std::vector<SeenPoint> points_of(const VisibleMap& map,
                                 const std::optional<RayBundle>& rays) {
  std::vector<SeenPoint> points;
  points.reserve(map.vertices.size());
  for (std::int32_t v = 0; v < std::ssize(map.vertices); ++v) {
    const ExactPoint exact = point_of(map, v);
    SeenPoint point{real_of(exact.x), real_of(exact.y), {}};
    if (rays) point.ray = rays->unit_ray(point.x, point.y);
    points.push_back(std::move(point));
  }
  return points;
}

/// The key on a side of an arc, by the number of the region there.
std::int32_t key_of(const VisibleMap& map, std::int32_t region) {
  return region < 0 ? kOutsideKey
                    : map.regions[static_cast<std::size_t>(region)].key;
}

BigRational exact_area(const VisibleMap& map, std::int32_t key) {
  BigRational twice = 0;
  for (const MapArc& arc : map.arcs) {
    const bool is_right = key_of(map, arc.right) == key;
    if (is_right == (key_of(map, arc.left) == key)) continue;
    const ExactPoint p = point_of(map, arc.from);
    const ExactPoint q = point_of(map, arc.to);
    const BigRational part = p.x * q.y - p.y * q.x;
    twice += is_right ? part : BigRational(-part);
  }
  return twice / 2;
}

}  // namespace

std::vector<SeenArea> seen_areas(const VisibleMap& map, const Camera& camera) {
  std::optional<RayBundle> rays;
  if (camera->perspective) rays.emplace(camera);
  const std::vector<SeenPoint> points = points_of(map, rays);
  std::map<std::int32_t, RealArea> sums;
  for (const MapArc& arc : map.arcs) {
    const SeenPoint& p = points[static_cast<std::size_t>(arc.from)];
    const SeenPoint& q = points[static_cast<std::size_t>(arc.to)];
    const Real twice_area = p.x * q.y - p.y * q.x;
    const Real angle = rays ? rays->triangle(p.ray, q.ray) : Real(0);
    RealArea& right = sums[key_of(map, arc.right)];
    right.twice_area += twice_area;
    right.size += abs(twice_area);
    right.solid_angle += angle;
    RealArea& left = sums[key_of(map, arc.left)];
    left.twice_area -= twice_area;
    left.size += abs(twice_area);
    left.solid_angle -= angle;
  }
  sums.erase(kOutsideKey);
  std::vector<SeenArea> areas;
  for (const auto& [key, sum] : sums) {
    // Of 60 digits 40 and more are left, or rationals add it up.
    const Real area = abs(sum.twice_area) > sum.size * Real(1e-20)
                          ? Real(sum.twice_area / 2)
                          : real_of(exact_area(map, key));
    areas.push_back(
        {key, area.convert_to<double>(), sum.solid_angle.convert_to<double>()});
  }
  return areas;
}

std::string exact_seen_area(const VisibleMap& map, std::int32_t key) {
  return exact_area(map, key).str();
}

double pixel_area(const Camera& camera) {
  const RealVector eye = real_of(camera->eye);
  const Real volume = dot(eye, cross(real_of(camera->sx), real_of(camera->sy)));
  return Real(abs(volume) / sqrt(dot(eye, eye))).convert_to<double>();
}

}  // namespace halfspace::fast
