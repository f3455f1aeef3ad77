#pragma once

#include "camera/edge_function.hpp"
#include "halfspace/clip.hpp"
#include "halfspace/fast/types.hpp"
#include "halfspace/moving.hpp"

namespace halfspace::fast {

/// A clip plane, projected exactly (S10.2).
///
/// Bits: as a polygon's plane (see ProjectedPlane): a normal of 2n + 1 bits
/// against lattice vectors of n + 13, twice, three times: 3n + 17; an offset of
/// 3n + 3 and 9 bits of scale less than that; samples as there.
template <int kBits>
ProjectedPlane<kBits> projected(const ClipPlane& clip, const CameraData& camera,
                                int samples = 1) {
  constexpr std::size_t kWords = ProjectedPlane<kBits>::kWords;
  const auto along = [&](const LatticeVector& v) {
    return multiply<kWords>(clip.a, v.x) + multiply<kWords>(clip.b, v.y) +
           multiply<kWords>(clip.c, v.z);
  };
  const auto offset = multiply<kWords>(clip.d, Int128{1} << kLatticeBits);
  const auto at_s0 = along(camera.s0) + offset;
  return {camera.perspective ? along(camera.eye) + offset : along(camera.eye),
          along(camera.sx), along(camera.sy),
          multiply<kWords>(at_s0, Int128{2 * samples})};
}

/// A clip plane in the frame of an object (S12.3): its function at the object's
/// points, times 2^shift.
///
/// Bits: a normal of 109, a map's entries of 62, three times: 173; with the
/// offset of 118 and the plane's, 126 and 62 of the shift, 229; at a point 231.
struct MovedClip {
  Wide<4> a, b, c, d;

  MovedClip(const ClipPlane& clip, const ObjectMap& map)
      : d(multiply<4>(clip.d, Int128{1} << map.shift) +
          along(clip, map.t[0], map.t[1], map.t[2])) {
    const auto column = [&](std::size_t k) {
      return along(clip, Int128{map.m[k]}, Int128{map.m[3 + k]},
                   Int128{map.m[6 + k]});
    };
    a = column(0), b = column(1), c = column(2);
  }

  int sign_at(const GridPoint& p) const {
    return sign(multiply<4>(a, Int128{p.x}) + multiply<4>(b, Int128{p.y}) +
                multiply<4>(c, Int128{p.z}) + d);
  }

 private:
  static Wide<4> along(const ClipPlane& clip, const Int128& x, const Int128& y,
                       const Int128& z) {
    return multiply<4>(clip.a, x) + multiply<4>(clip.b, y) +
           multiply<4>(clip.c, z);
  }
};

inline Plane rounded(const MovedClip& clip) {
  return {to_double(clip.a), to_double(clip.b), to_double(clip.c),
          to_double(clip.d)};
}

/// The sign of a clip plane at a point of the grid.
///
/// Bits: 3n + 3 and two more: 3 words hold them.
inline int sign_at(const ClipPlane& clip, const GridPoint& p) {
  return sign(multiply<3>(clip.a, Int128{p.x}) +
              multiply<3>(clip.b, Int128{p.y}) +
              multiply<3>(clip.c, Int128{p.z}) + Wide<3>(clip.d));
}

inline Plane rounded(const ClipPlane& clip) {
  return {to_double(clip.a), to_double(clip.b), to_double(clip.c),
          to_double(clip.d)};
}

/// Whether a function is 0 everywhere.
template <std::size_t kWords>
bool is_zero(const EdgeFunction<kWords>& f) {
  return sign(f.a) == 0 && sign(f.b) == 0 && sign(f.c) == 0;
}

}  // namespace halfspace::fast
