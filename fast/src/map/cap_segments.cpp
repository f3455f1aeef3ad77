#include "map/cap_segments.hpp"

#include <cmath>

#include "raster/clip_set.hpp"

namespace halfspace::fast {
namespace {

BigInteger big(Int128 value) {
  return to_big_integer(
      std::array<std::uint64_t, 2>{static_cast<std::uint64_t>(value),
                                   static_cast<std::uint64_t>(value >> 64)});
}

std::array<BigInteger, 3> coordinates(const GridPoint& p) {
  return {big(p.x), big(p.y), big(p.z)};
}

std::array<BigInteger, 3> coordinates(const LatticeVector& p) {
  return {big(p.x), big(p.y), big(p.z)};
}

/// Whether p <= q: by their doubles if these are apart by more than they can be
/// off, else exactly.
bool at_most(double near_p, const BigRational& p, double near_q,
             const BigRational& q) {
  const double doubt = 0x1p-40 * (std::abs(near_p) + std::abs(near_q));
  if (near_p < near_q - doubt) return true;
  if (near_p > near_q + doubt) return false;
  return p <= q;
}

}  // namespace

CapSegments::CapSegments(const TreeReader& reader, const CameraData& camera,
                         const ClipPlane& clip)
    : scene_(reader.scene()), camera_(camera), clip_(clip) {
  const std::array<Int128, 3> normal = {clip.a, clip.b, clip.c};
  const auto size = [&](std::size_t a) {
    return normal[a] < 0 ? -normal[a] : normal[a];
  };
  std::size_t across = 0;
  for (const std::size_t a : {1u, 2u}) {
    if (size(a) > size(across)) across = a;
  }
  u_ = (across + 1) % 3;
  v_ = (across + 2) % 3;
  turn_ = normal[across] > 0 ? 1 : -1;
  for (const PolygonId polygon : crossing_polygons(reader, clip)) add(polygon);
}

void CapSegments::add(PolygonId polygon) {
  // A corner on the plane is on the side that is removed.
  const auto corners = scene_.corners(polygon);
  const auto point = [&](std::size_t k) -> const GridPoint& {
    return scene_.point(corners[k % corners.size()]);
  };
  CapSegment segment;
  segment.polygon = polygon;
  int count = 0;
  bool is_kept = sign_at(clip_, point(0)) > 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const bool next_is_kept = sign_at(clip_, point(k + 1)) > 0;
    if (is_kept != next_is_kept) {
      (is_kept ? segment.to : segment.from) =
          point_between(point(k), point(k + 1));
      ++count;
    }
    is_kept = next_is_kept;
  }
  if (count == 2) segments_.push_back(std::move(segment));
}

CapPoint CapSegments::point_between(const GridPoint& p,
                                    const GridPoint& q) const {
  const auto from = coordinates(p);
  const auto to = coordinates(q);
  const auto value = [&](const std::array<BigInteger, 3>& at) -> BigInteger {
    return big(clip_.a) * at[0] + big(clip_.b) * at[1] + big(clip_.c) * at[2] +
           big(clip_.d);
  };
  const BigInteger at_p = value(from);
  const BigInteger at_q = value(to);
  std::array<BigRational, 3> exact;
  CapPoint result;
  for (std::size_t a = 0; a < 3; ++a) {
    exact[a] = quotient_of(at_p * to[a] - at_q * from[a], at_p - at_q);
    result.near[a] = exact[a].convert_to<double>();
  }
  result.u = exact[u_];
  result.v = exact[v_];
  result.near_u = result.near[u_];
  result.near_v = result.near[v_];
  return result;
}

CapPoint CapSegments::seen_at(const BigRational& x,
                              const BigRational& y) const {
  // s = s0 + (x sx + y sy) / 2, in 2^8 to a grid step.
  const auto s0 = coordinates(camera_.s0);
  const auto sx = coordinates(camera_.sx);
  const auto sy = coordinates(camera_.sy);
  const auto eye = coordinates(camera_.eye);
  const BigInteger step = BigInteger(1) << kLatticeBits;
  std::array<BigRational, 3> s;
  for (std::size_t a = 0; a < 3; ++a)
    s[a] = s0[a] + (x * sx[a] + y * sy[a]) / 2;
  const auto along = [&](const auto& v) -> BigRational {
    return big(clip_.a) * BigRational(v[0]) + big(clip_.b) * BigRational(v[1]) +
           big(clip_.c) * BigRational(v[2]);
  };
  const BigRational at_s = along(s) + BigRational(step * big(clip_.d));
  const BigRational at_eye =
      camera_.perspective
          ? BigRational(along(eye) + BigRational(step * big(clip_.d)))
          : along(eye);
  const auto coordinate = [&](std::size_t a) -> BigRational {
    const BigRational e = eye[a];
    const BigRational at =
        camera_.perspective
            ? BigRational(e + at_eye / (at_eye - at_s) * (s[a] - e))
            : BigRational(s[a] - at_s / at_eye * e);
    return at / step;
  };
  CapPoint point;
  point.u = coordinate(u_);
  point.v = coordinate(v_);
  point.near_u = point.u.convert_to<double>();
  point.near_v = point.v.convert_to<double>();
  return point;
}

/// Of a closed curve with the solid on the left it is the number of segments on
/// the right that go up, less those that go down.
void CapSegments::add_at(const BigRational& x, const BigRational& y,
                         CapWindings& windings) const {
  const CapPoint p = seen_at(x, y);
  for (const CapSegment& segment : segments_) {
    const CapPoint& f = segment.from;
    const CapPoint& g = segment.to;
    const bool f_below = at_most(f.near_v, f.v, p.near_v, p.v);
    const bool g_below = at_most(g.near_v, g.v, p.near_v, p.v);
    if (f_below == g_below) continue;
    const double doubt = 0x1p-40 * (std::abs(f.near_u) + std::abs(g.near_u) +
                                    std::abs(p.near_u));
    bool is_right = false;
    if (std::min(f.near_u, g.near_u) > p.near_u + doubt) {
      is_right = true;
    } else if (!(std::max(f.near_u, g.near_u) < p.near_u - doubt)) {
      const BigRational at =
          (g.u - f.u) * (p.v - f.v) - (p.u - f.u) * (g.v - f.v);
      is_right = f_below ? at > 0 : at < 0;
    }
    if (is_right) windings.add(segment.polygon, f_below ? -turn_ : turn_);
  }
}

}  // namespace halfspace::fast
