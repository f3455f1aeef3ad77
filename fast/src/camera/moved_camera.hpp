#pragma once

#include <cstdint>
#include <optional>

#include "camera/edge_function.hpp"
#include "camera/view.hpp"
#include "exact/exact_plane.hpp"
#include "halfspace/camera.hpp"
#include "halfspace/moving.hpp"

namespace halfspace::fast {

/// Stands for the bits of a grid where the camera is moved into an object's
/// frame: the grid is any, the camera's numbers are wider.
constexpr int kMovedGrid = 0;

template <>
struct Grid<kMovedGrid> {
  static constexpr std::size_t kWords = 14;
  using Normal = Int128;
  using Value = Wide<3>;
};
template <>
struct ProjectedPlane<kMovedGrid> {
  static constexpr std::size_t kWords = 6;
  Wide<kWords> eye;
  Wide<kWords> a;
  Wide<kWords> b;
  Wide<kWords> c;
};

/// The camera in the frame of an object (S12.3): its points are eye / w and
/// s0 / w, its vectors sx / w, sy / w and, without perspective, eye / w, in
/// grid steps of the object. A map and its inverse keep ray parameters, and the
/// sides of planes that the eye is on.
///
/// The inverse is that of Cramer's rule: adj(M) (2^shift v - 2^8 t) / det M.
/// Bits, as exponents: adj(M) 2 * 62 + 1 = 125; the bracket 130; three products
/// 257. The determinant 62 + 125 + 2 = 189, and 2^8 of it 197. So 5 words hold
/// both.
struct MovedCamera {
  using Int = Wide<5>;
  Vector3<Int> eye;
  Vector3<Int> s0;
  Vector3<Int> sx;
  Vector3<Int> sy;
  Int w;  ///< above 0
  bool perspective = true;
  std::optional<std::int64_t> near;
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  CameraData in_world;
  ObjectMap to_world;
};

MovedCamera moved_camera(const CameraData& camera, const ObjectMap& to_world);

/// The camera type of decisions on a grid.
template <int kBits>
struct ExactCameraOf {
  using Type = CameraData;
};
template <>
struct ExactCameraOf<kMovedGrid> {
  using Type = MovedCamera;
};
template <int kBits>
using ExactCamera = typename ExactCameraOf<kBits>::Type;

/// A plane at the eye times w, and at the image's points times 2 w and
/// `samples`.
///
/// Bits: a normal has 109; above a point of the plane, 258; three products 369;
/// samples add 4 to the offset: 374 of 384.
ProjectedPlane<kMovedGrid> projected(const ExactPlane<kMovedGrid>& plane,
                                     const MovedCamera& camera,
                                     int samples = 1);

/// As edge_function() of a camera that is not moved, times a power of w.
///
/// Bits: p - e has 259, a cross product 519, its product with s0 - e three
/// times 780, and 4 of samples: 784; at a pixel 803 of 896. The product of two
/// projected planes has 739, and 373 + 369 + 1 in its offset: 760 at a pixel.
EdgeFunction<14> edge_function(const GridPoint& p, const GridPoint& q,
                               const MovedCamera& camera, int samples = 1);

/// As near_function(). Bits: 373 + 34.
EdgeFunction<14> near_function(const ProjectedPlane<kMovedGrid>& p,
                               std::int64_t near, bool perspective,
                               int samples);

/// As meet_function(), with a plane of the world, which keeps its values at the
/// eye and the image's points. Bits: 374 and 196, twice.
EdgeFunction<14> meet_function(const ProjectedPlane<kMovedGrid>& p,
                               const ProjectedPlane<54>& q);

/// As make_view(), in the object's frame.
View make_view(const MovedCamera& camera, int grid_bits, int samples = 1);

}  // namespace halfspace::fast
