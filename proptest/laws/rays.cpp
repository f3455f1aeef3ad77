#include "laws/rays.hpp"

#include <algorithm>
#include <iterator>

namespace halfspace {
namespace {

using definition::Fraction;
using definition::Integer;

LatticeVector operator+(const LatticeVector& u, const LatticeVector& v) {
  return {u.x + v.x, u.y + v.y, u.z + v.z};
}
LatticeVector operator-(const LatticeVector& u, const LatticeVector& v) {
  return {u.x - v.x, u.y - v.y, u.z - v.z};
}
LatticeVector half(const LatticeVector& u) {
  return {u.x / 2, u.y / 2, u.z / 2};
}

LatticeVector to_lattice(const GridPoint& p) {
  constexpr Int128 kStep = Int128{1} << kLatticeBits;
  return {kStep * p.x, kStep * p.y, kStep * p.z};
}

/// Corners, middles of edges, a point within, of polygons one after another.
std::vector<LatticeVector> points_of(const SceneFile& view) {
  std::vector<LatticeVector> points;
  const Scene& scene = view.scene;
  for (PolygonId id = 0; id < static_cast<PolygonId>(scene.polygon_count());
       ++id) {
    const auto corners = scene.corners(id);
    const LatticeVector p = to_lattice(scene.point(corners[0]));
    const LatticeVector q = to_lattice(scene.point(corners[1]));
    const LatticeVector r = to_lattice(scene.point(corners[2]));
    points.push_back(p);
    points.push_back(half(q + r));
    points.push_back(half(half(p + q) + r));
  }
  if ((*view.camera)->perspective) points.push_back((*view.camera)->eye);
  return points;
}

Integer big(Int128 value) {
  Integer result = static_cast<std::int64_t>(value >> 64);
  result <<= 64;
  return result + static_cast<std::uint64_t>(value);
}

bool reaches(Reach reach, const Fraction& t) {
  if (reach == Reach::kLine) return true;
  if (reach == Reach::kRay) return t >= 0;
  if (reach == Reach::kSegment) return t >= 0 && t <= 1;
  return t > 0 && t < 1;
}

}  // namespace

Integer to_integer(const RayInteger& words) {
  Integer value = 0;
  for (std::size_t k = words.size(); k-- > 0;) value = (value << 64) + words[k];
  if (words.back() >> 63 != 0) value -= Integer(1) << 256;
  return value;
}

std::vector<Ray> rays_of(const SceneFile& view) {
  const std::vector<LatticeVector> points = points_of(view);
  std::vector<Ray> rays;
  constexpr std::size_t kMostRays = 24;
  constexpr Reach kReaches[] = {Reach::kRay, Reach::kSegment, Reach::kBetween,
                                Reach::kLine};
  for (std::size_t k = 0; k < points.size() && rays.size() < kMostRays; ++k) {
    for (const std::size_t step : {1u, 2u, 3u, 7u}) {
      const LatticeVector& from = points[k];
      const LatticeVector& to = points[(k + step) % points.size()];
      const Reach reach = kReaches[(k + step) % 4];
      const auto ray =
          make_ray({from, to - from, reach}, view.scene.grid_bits());
      if (ray) rays.push_back(*ray);
    }
  }
  return rays;
}

std::vector<definition::Facet> facets_of(const Scene& scene) {
  std::vector<definition::Facet> facets;
  for (PolygonId id = 0; id < static_cast<PolygonId>(scene.polygon_count());
       ++id)
    facets.push_back(definition::facet_of(scene, definition::whole(scene, id)));
  return facets;
}

std::vector<ExactHit> hits_by_definition(
    const std::vector<definition::Facet>& facets, const Ray& ray) {
  std::vector<ExactHit> hits;
  const LatticeVector& o = ray->origin;
  const LatticeVector& d = ray->direction;
  const Integer step = 1 << kLatticeBits;
  for (PolygonId id = 0; id < std::ssize(facets); ++id) {
    const definition::Facet& facet = facets[static_cast<std::size_t>(id)];
    const definition::Plane& p = facet.support;
    const auto along = [&p](const LatticeVector& v) -> Integer {
      return p.a * big(v.x) + p.b * big(v.y) + p.c * big(v.z);
    };
    const Integer slope = along(d);
    if (slope == 0) continue;
    const Integer value = along(o) + p.d * step;
    const Fraction t = Fraction(-value) / Fraction(slope);
    if (!reaches(ray->reach, t)) continue;
    // (o + t d) / step, times the slope, in whole numbers.
    const Integer sign = slope < 0 ? -1 : 1;
    const auto at = [&](Int128 from, Int128 by) -> Integer {
      return sign * (big(from) * slope - value * big(by));
    };
    const definition::Point point = {at(o.x, d.x), at(o.y, d.y), at(o.z, d.z),
                                     sign * slope * step};
    if (std::all_of(facet.edges.begin(), facet.edges.end(),
                    [&](const definition::Plane& edge) {
                      return definition::side_of(edge, point) >= 0;
                    }))
      hits.push_back({id, t});
  }
  std::sort(hits.begin(), hits.end(), [](const auto& a, const auto& b) {
    return a.parameter == b.parameter ? a.polygon < b.polygon
                                      : a.parameter < b.parameter;
  });
  return hits;
}

}  // namespace halfspace
