#pragma once

#include <cstdint>
#include <optional>

#include "halfspace/int128.hpp"
#include "halfspace/result.hpp"

namespace halfspace {

/// The camera's lattice is finer than the grid by this factor (S4.1).
constexpr int kLatticeBits = 8;

/// The camera's range is wider than the grid's by this factor (S4.1).
constexpr int kCameraRangeBits = 6;

/// The near distance is a multiple of 2^-16 of the ray parameter (S4.3).
constexpr int kNearBits = 16;

/// Images have at most this many columns and rows (S4.1).
constexpr std::int32_t kMaxImageSize = 65536;

/// A point or vector of the camera's lattice. Units: 2^-8 grid steps.
struct LatticeVector {
  Int128 x = 0;
  Int128 y = 0;
  Int128 z = 0;
  friend bool operator==(const LatticeVector&, const LatticeVector&) = default;
};

/// The data of a camera, not yet checked (S4.1).
///
/// The image point (x, y) is the point `s0 + x sx + y sy` of space; x grows to
/// the right and y downwards; pixel (i, j) is [i, i+1) x [j, j+1).
struct CameraData {
  /// The eye if `perspective`; else the direction towards the viewer.
  LatticeVector eye;
  bool perspective = true;  ///< the homogeneous coordinate w of the eye, 1 or 0
  LatticeVector s0;
  LatticeVector sx;
  LatticeVector sy;
  /// In perspective the ray is `eye + t (s - eye)` for t > 0, else it is
  /// `s - t eye` for every t. Points with `t <= near / 2^16` are not seen.
  /// Nothing means 0 in perspective, and no limit otherwise.
  std::optional<std::int64_t> near;
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  friend bool operator==(const CameraData&, const CameraData&) = default;
};

/// A valid camera for scenes of one grid (S4.1): only make_camera() makes one.
class Camera {
 public:
  const CameraData& data() const { return data_; }
  const CameraData* operator->() const { return &data_; }
  friend bool operator==(const Camera&, const Camera&) = default;

 private:
  friend Result<Camera> make_camera(const CameraData& data, int grid_bits);
  CameraData data_;
};

/// The camera that `data` describes, if it is valid for scenes of `grid_bits`.
///
/// Errors: kOutOfRange (a component beyond 2^(grid_bits + 13) in size; a size
///         not from 1 to 65,536; a near distance beyond 2^32 in size, or
///         negative in perspective); kBadCamera (the vectors sx, sy and
///         s0 - eye, or eye where it is a direction, are linearly dependent).
Result<Camera> make_camera(const CameraData& data, int grid_bits);

}  // namespace halfspace
