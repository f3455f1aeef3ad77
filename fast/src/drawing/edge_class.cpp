#include "drawing/edge_class.hpp"

#include <algorithm>
#include <cmath>

#include "drawing/short_product.hpp"

namespace halfspace::fast {
namespace {

/// The sign of u.v / (|u| |v|) - k 2^-30 for two normals, times `turn` of 1 or
/// -1 for u.v.
///
/// Bits: a dot product of normals has 4n + 4, its square 8n + 8, and with the
/// square of 2^30 8n + 68: 500.
int exact_cosine_sign(const Scene& scene, PolygonId p, PolygonId q, int turn,
                      std::int32_t k) {
  return with_grid(scene.grid_bits(), [&](auto bits) {
    const auto normal = [&](PolygonId polygon) {
      return exact_plane<bits()>(plane_corners(scene, polygon)).normal;
    };
    const auto dot = [](const auto& u, const auto& v) {
      return multiply<4>(Int128{u.x}, Int128{v.x}) +
             multiply<4>(Int128{u.y}, Int128{v.y}) +
             multiply<4>(Int128{u.z}, Int128{v.z});
    };
    const auto u = normal(p);
    const auto v = normal(q);
    const Wide<4> uv = multiply<4>(dot(u, v), Int128{turn});
    const auto squared = short_product<10>(uv, uv);
    const auto sizes = short_product<10>(dot(u, u), dot(v, v));
    const int left = sign(uv);
    const int right = (k > 0) - (k < 0);
    if (left != right) return left > right ? 1 : -1;
    const auto unit = Int128{1} << (2 * kCosineBits);
    return left * sign(short_product<10>(squared, Wide<2>(unit)) -
                       short_product<10>(sizes, Wide<2>(Int128{k} * k)));
  });
}

/// Whether two polygons' planes turn by more than the crease angle.
bool is_crease(const EdgeSide& f, const EdgeSide& g, const Sight& sight,
               std::int32_t k) {
  const int turn = f.direction * g.direction < 0 ? 1 : -1;
  const Plane& u = sight.filter_plane(f.polygon).plane;
  const Plane& v = sight.filter_plane(g.polygon).plane;
  const double uv = turn * (u.a * v.a + u.b * v.b + u.c * v.c);
  const double size = std::sqrt((u.a * u.a + u.b * u.b + u.c * u.c) *
                                (v.a * v.a + v.b * v.b + v.c * v.c));
  // Each factor is off by 2u of itself, sums and products by 5u: with the root
  // 16u of the product of the lengths.
  const double value =
      uv - size * std::ldexp(double{static_cast<double>(k)}, -kCosineBits);
  if (const int known = filtered_sign({value, 32 * kRounding * size}))
    return known < 0;
  return exact_cosine_sign(sight.scene(), f.polygon, g.polygon, turn, k) < 0;
}

/// Whether all polygons are in one plane, some on either side of the edge.
bool is_seam(std::span<const EdgeSide> sides, const PlaneTable& planes) {
  const auto at = [](PolygonId p) { return static_cast<std::size_t>(p); };
  const std::int32_t plane = planes.plane_of[at(sides[0].polygon)];
  bool left = false;
  bool right = false;
  for (const EdgeSide& side : sides) {
    if (planes.plane_of[at(side.polygon)] != plane) return false;
    const bool same = planes.same_orientation[at(side.polygon)];
    (side.direction * (same ? 1 : -1) > 0 ? left : right) = true;
  }
  return left && right;
}

}  // namespace

std::optional<EdgeClass> class_of(std::span<const EdgeSide> sides,
                                  const Sight& sight, const Hiding& hiding,
                                  const PlaneTable& planes,
                                  const DrawingOptions& options) {
  if (is_seam(sides, planes)) return std::nullopt;
  const auto is_cut = [&](const EdgeSide& side) {
    return !options.cuts.empty() &&
           options.cuts[static_cast<std::size_t>(side.polygon)];
  };
  if (std::any_of(sides.begin(), sides.end(), is_cut))
    return EdgeClass::kSection;
  if (sides.size() == 1) return EdgeClass::kBorder;
  bool left = false;
  bool right = false;
  for (const EdgeSide& side : sides) {
    const int seen = hiding.eye_sign(side.polygon) * side.direction;
    left |= seen > 0;
    right |= seen < 0;
  }
  if (!(left && right)) return EdgeClass::kSilhouette;
  if (sides.size() > 2 ||
      is_crease(sides[0], sides[1], sight, options.crease_cosine))
    return EdgeClass::kCrease;
  return std::nullopt;
}

}  // namespace halfspace::fast
