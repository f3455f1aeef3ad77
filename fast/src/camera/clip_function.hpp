#pragma once

#include "camera/edge_function.hpp"
#include "halfspace/clip.hpp"
#include "halfspace/fast/types.hpp"

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
