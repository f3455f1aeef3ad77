#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "exact/exact_plane.hpp"
#include "halfspace/camera.hpp"

namespace halfspace::fast {

/// An affine function of the image, exactly: at the centre of pixel (i, j) it
/// is a (2i + 1) + b (2j + 1) + c. An edge function (PIN88) in homogeneous
/// coordinates (OG97).
///
/// Bits: those of the widest, a splitter's edge. A plane's value at the eye has
/// 3n + 17 and its slopes and offset here 3n + 18, so their products 6n + 36;
/// times 2i + 1 < 2^17, three times: 6n + 55, or 211, 295 and 379.
template <std::size_t kWords>
struct EdgeFunction {
  Wide<kWords> a;
  Wide<kWords> b;
  Wide<kWords> c;

  Wide<kWords> at_centre(std::int64_t i, std::int64_t j) const {
    return multiply<kWords>(a, Int128{2 * i + 1}) +
           multiply<kWords>(b, Int128{2 * j + 1}) + c;
  }
  /// The sign at the sample of pixel (i, j): at the centre, else of the slope
  /// to the right, else of that down (S4.4).
  int sign_at_sample(std::int64_t i, std::int64_t j) const {
    const int centre = sign(at_centre(i, j));
    if (centre != 0) return centre;
    const int right = sign(a);
    return right != 0 ? right : sign(b);
  }
  friend EdgeFunction operator-(const EdgeFunction& l) {
    return {-l.a, -l.b, -l.c};
  }
};

/// A plane projected by the camera: its value at the eye, times 2^8, and its
/// values at the points of the image as a function of pixel coordinates, times
/// 2^9 and `samples`: coordinates of samples, so many a pixel (S5.7).
///
/// Bits: a normal has 2n + 1; a difference of lattice vectors n + 14, twice
/// that n + 15; three products: 3n + 18, which is 96, 138 and 180. Samples add
/// 3 to the offset alone, which pixel coordinates do not multiply: products
/// there stay below those of the slopes with a pixel's 17 bits.
template <int kBits>
struct ProjectedPlane {
  static constexpr std::size_t kWords = kBits == 26 ? 2 : 3;
  Wide<kWords> eye;
  Wide<kWords> a;
  Wide<kWords> b;
  Wide<kWords> c;
};

template <int kBits>
ProjectedPlane<kBits> projected(const ExactPlane<kBits>& plane,
                                const CameraData& camera, int samples = 1) {
  constexpr std::size_t kWords = ProjectedPlane<kBits>::kWords;
  const auto along = [&](const LatticeVector& v) {
    return multiply<kWords>(Int128{plane.normal.x}, v.x) +
           multiply<kWords>(Int128{plane.normal.y}, v.y) +
           multiply<kWords>(Int128{plane.normal.z}, v.z);
  };
  constexpr Int128 kStep = Int128{1} << kLatticeBits;
  const GridPoint& p = plane.origin;
  const auto above = [&](const LatticeVector& v) {
    return along({v.x - kStep * p.x, v.y - kStep * p.y, v.z - kStep * p.z});
  };
  const Wide<kWords> offset =
      multiply<kWords>(above(camera.s0), Int128{2 * samples});
  return {camera.perspective ? above(camera.eye) : along(camera.eye),
          along(camera.sx), along(camera.sy), offset};
}

/// P(e) Q(s) - Q(e) P(s): 0 on the image of the line in which the planes meet
/// (S4.5); its sign is their order along the ray (S5.3).
template <int kBits>
EdgeFunction<Grid<kBits>::kWords> meet_function(
    const ProjectedPlane<kBits>& p, const ProjectedPlane<kBits>& q) {
  constexpr std::size_t kWords = Grid<kBits>::kWords;
  const auto part = [&](const auto& p_part, const auto& q_part) {
    return multiply<kWords>(p.eye, q_part) - multiply<kWords>(q.eye, p_part);
  };
  return {part(p.a, q.a), part(p.b, q.b), part(p.c, q.c)};
}

/// The edge function of the line from `p` to `q`: positive on the inner side of
/// an edge of a polygon that is seen from its positive side.
///
/// In perspective det[p - e, q - e, s - e] is -h(e) for the third corner of a
/// triangle in place of s; else det[q - p, s - p, e] is n.e.
/// Bits: p - e has n + 14, a cross product 2n + 30, its product with
/// 2 (s0 - e), n + 15, three times 3n + 47, so 209 at most; 226 at a pixel.
inline EdgeFunction<4> edge_function(const GridPoint& p, const GridPoint& q,
                                     const CameraData& camera,
                                     int samples = 1) {
  constexpr Int128 kStep = Int128{1} << kLatticeBits;
  const auto lattice = [](const GridPoint& g) {
    return LatticeVector{kStep * g.x, kStep * g.y, kStep * g.z};
  };
  const auto minus = [](const LatticeVector& u, const LatticeVector& v) {
    return LatticeVector{u.x - v.x, u.y - v.y, u.z - v.z};
  };
  const LatticeVector from = lattice(p);
  const LatticeVector to = lattice(q);
  // Either order makes a normal m for which m.(s - origin) has the sign.
  const LatticeVector u =
      camera.perspective ? minus(to, camera.eye) : camera.eye;
  const LatticeVector v =
      camera.perspective ? minus(from, camera.eye) : minus(to, from);
  const LatticeVector& origin = camera.perspective ? camera.eye : from;
  const Wide<3> x = multiply<3>(u.y, v.z) - multiply<3>(u.z, v.y);
  const Wide<3> y = multiply<3>(u.z, v.x) - multiply<3>(u.x, v.z);
  const Wide<3> z = multiply<3>(u.x, v.y) - multiply<3>(u.y, v.x);
  const auto along = [&](const LatticeVector& w) {
    return multiply<4>(x, w.x) + multiply<4>(y, w.y) + multiply<4>(z, w.z);
  };
  const Wide<4> offset = along(minus(camera.s0, origin));
  return {along(camera.sx), along(camera.sy),
          multiply<4>(offset, Int128{2 * samples})};
}

/// Positive where a polygon's plane is beyond the near distance (S4.3), if the
/// eye is on its positive side.
///
/// In perspective (2^16 - k) P(e) + k P(s), else 2^16 P(s) - k n.e, where the
/// seen plane has P(s) doubled. Bits: 3n + 18 and 33 of k and 18 of a pixel:
/// 231 at most.
template <int kBits>
EdgeFunction<4> near_function(const ProjectedPlane<kBits>& p, std::int64_t near,
                              bool perspective, int samples = 1) {
  const Int128 unit = Int128{1} << kNearBits;
  const auto times = [](const auto& value, Int128 factor) {
    return multiply<4>(Wide<4>(value), factor);
  };
  if (perspective) {
    return {times(p.a, near), times(p.b, near),
            times(p.c, near) + times(p.eye, 2 * samples * (unit - near))};
  }
  return {times(p.a, unit), times(p.b, unit),
          times(p.c, unit) - times(p.eye, Int128{2 * samples} * near)};
}

/// Pixels of an image line, from `first` up to but not including `end`.
struct PixelRange {
  std::int32_t first = 0;
  std::int32_t end = 0;
};

/// The part of `range` in image line `j` on which the function is positive.
///
/// A guess in doubles, corrected by exact comparisons.
template <std::size_t kWords>
PixelRange clipped(PixelRange range, const EdgeFunction<kWords>& edge,
                   std::int64_t j) {
  if (range.first >= range.end) return range;
  const Wide<kWords> c = multiply<kWords>(edge.b, Int128{2 * j + 1}) + edge.c;
  const int slope = sign(edge.a);
  if (slope == 0) {
    const int all = sign(c) != 0 ? sign(c) : sign(edge.b);
    return all > 0 ? range : PixelRange{0, 0};
  }
  // The least i with size (2i + 1) >= level: there it begins or ends, since
  // on the line itself the slope to the right decides.
  const Wide<kWords> size = slope > 0 ? edge.a : -edge.a;
  const Wide<kWords> level = slope > 0 ? -c : c;
  const auto reaches = [&](std::int64_t i) {
    return !(multiply<kWords>(size, Int128{2 * i + 1}) - level).is_negative();
  };
  const double guess = std::ceil((to_double(level) / to_double(size) - 1) / 2);
  auto i = static_cast<std::int32_t>(
      std::clamp(guess, double{static_cast<double>(range.first)},
                 double{static_cast<double>(range.end)}));
  while (i > range.first && reaches(i - 1)) --i;
  while (i < range.end && !reaches(i)) ++i;
  return slope > 0 ? PixelRange{i, range.end} : PixelRange{range.first, i};
}

}  // namespace halfspace::fast
