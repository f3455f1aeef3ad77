#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "camera/edge_function.hpp"
#include "camera/moved_camera.hpp"
#include "camera/view.hpp"
#include "exact/big_rational.hpp"
#include "halfspace/camera.hpp"
#include "halfspace/scene.hpp"
#include "raster/kernel/tile_kernel.hpp"

namespace halfspace::fast {

/// Whether the polygon has corner colours that differ: then it is a triangle.
bool has_gradient(const Scene& scene, PolygonId polygon);
bool has_gradient(std::span<const Rgb> colors);

/// The colours of a triangle whose corners' differ (S5.4).
///
/// With w[k] the image line of the edge opposite corner k, the point seen has
/// the weights w[k] / (w[0] + w[1] + w[2]), for they are the volumes that the
/// edges span with the eye and the point. So a channel is a quotient of two
/// affine functions of the image: here in doubles with a bound, and exactly
/// where that touches a rounding step.
class GouraudShader {
 public:
  GouraudShader(const Scene& scene, const CameraData& camera, const View& view,
                const MovedCamera* moved = nullptr)
      : scene_(scene), camera_(camera), view_(view), moved_(moved) {}

  /// The triangle that is meant from now on; the eye is on side `eye_sign`.
  void start(PolygonId polygon, int eye_sign) {
    polygon_ = polygon;
    eye_sign_ = eye_sign;
    ready_ = false;
    exact_ready_ = false;
    has_corners_ = false;
  }
  /// The same where its corners, which are exact, are known.
  void start(PolygonId polygon, int eye_sign,
             const std::array<Vertex, 3>& corners) {
    start(polygon, eye_sign);
    corners_ = corners;
    has_corners_ = true;
  }

  /// Its colours in doubles.
  const Gradient& gradient() {
    if (!ready_) prepare();
    return gradient_;
  }

  /// Writes the colours of the pixels `bits` of line `j`, from column `x` on,
  /// to `colors`, where column x is at byte `at`. Returns how many channels
  /// were decided exactly.
  int shade(std::int32_t x, std::int32_t j, std::uint32_t bits,
            std::uint8_t* colors, std::int64_t at);

  /// The channel at the centre of pixel (i, j), not rounded: within 2^-42, for
  /// either integer is off by 2^-52 of itself as a double, and the quotient, at
  /// most 256, by 3 2^-52.
  double close_value(std::size_t channel, std::int32_t i, std::int32_t j);
  /// The same exactly.
  BigRational exact_value(std::size_t channel, std::int32_t i, std::int32_t j);
  /// At an image point, in twice its coordinates.
  BigRational exact_value_at(std::size_t channel, const BigRational& twice_x,
                             const BigRational& twice_y);

 private:
  void prepare();
  void read_corners();
  void prepare_exact();
  std::uint8_t moved_channel(std::size_t channel, std::int32_t i,
                             std::int32_t j, std::int32_t guess) const;
  std::uint8_t exact_channel(std::size_t channel, std::int32_t i,
                             std::int32_t j, std::int32_t guess);

  const Scene& scene_;
  const CameraData& camera_;
  const View& view_;
  const MovedCamera* moved_;  ///< in the frame of an object, or null
  PolygonId polygon_ = 0;
  int eye_sign_ = 0;
  bool ready_ = false;
  bool exact_ready_ = false;
  bool has_corners_ = false;
  std::array<Vertex, 3> corners_;
  std::array<EdgeFunction<4>, 3> exact_sums_;
  EdgeFunction<4> exact_total_;
  Gradient gradient_;
};

}  // namespace halfspace::fast
