#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "camera/edge_function.hpp"
#include "camera/view.hpp"
#include "exact/big_rational.hpp"
#include "halfspace/camera.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::fast {

/// The shares of a triangle's corners in the point that a pixel's centre sees:
/// barycentric coordinates, which sum up to 1.
///
/// With w[k] the image line of the edge opposite corner k, a share is
/// w[k] / (w[0] + w[1] + w[2]), for those are the volumes that the edges span
/// with the eye and the point: quotients of affine functions of the image.
class CornerBlend {
 public:
  /// In doubles; each is off by at most a twelfth of `doubt`, which also has
  /// room for the rounding of a sum of three products with them.
  struct Shares {
    std::array<double, 3> share;
    double doubt = 0;  ///< infinite where doubles tell nothing
  };

  CornerBlend(const Scene& scene, const CameraData& camera, const View& view)
      : scene_(scene), camera_(camera), view_(view) {}

  void start(PolygonId triangle);

  /// Requires: pixel (i, j), in samples, shows the triangle.
  Shares at(std::int32_t i, std::int32_t j) const {
    std::array<double, 3> w;
    for (std::size_t k = 0; k < 3; ++k) w[k] = a_[k] * i + (b_[k] * j + c_[k]);
    const double reciprocal = 1 / (w[0] + w[1] + w[2]);
    const double doubt = error_ * std::abs(reciprocal) + least_doubt_;
    return {{w[0] * reciprocal, w[1] * reciprocal, w[2] * reciprocal},
            doubt < 0.25 ? doubt : kNothingTold};
  }

  /// The sum of the shares times `values`.
  BigRational exact_sum(std::int32_t i, std::int32_t j,
                        const std::array<BigRational, 3>& values) const;

 private:
  static constexpr double kNothingTold =
      std::numeric_limits<double>::infinity();

  const Scene& scene_;
  const CameraData& camera_;
  const View& view_;
  PolygonId triangle_ = 0;
  std::array<double, 3> a_{}, b_{}, c_{};
  double error_ = 0;
  double least_doubt_ = 0;
};

}  // namespace halfspace::fast
