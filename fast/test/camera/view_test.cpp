#include "camera/view.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "noisy.hpp"

/// The bounds of what a camera makes of planes and points, against running
/// errors, for cameras as far out as they may be.
namespace halfspace::fast {
namespace {

LatticeVector lattice(Random& random, int bits, std::int64_t scale) {
  const GridPoint p = random.point(bits);
  return {Int128{p.x} * scale, Int128{p.y} * scale, Int128{p.z} * scale};
}

Camera random_camera(Random& random, int bits) {
  while (true) {
    CameraData data;
    data.perspective = random.from_to(0, 1) < 0.5;
    data.eye = lattice(random, bits, 1 << 13);
    data.s0 = lattice(random, bits, 1 << 13);
    data.sx = lattice(random, bits, 1 << 4);
    data.sy = lattice(random, bits, 1 << 4);
    data.width_px = 500;
    data.height_px = 500;
    const Result<Camera> camera = make_camera(data, bits);
    if (camera) return *camera;
  }
}

std::array<Noisy, 3> in_steps(const LatticeVector& v, double scale) {
  const auto one = [scale](Int128 x) {
    return exactly(scale) * converted(static_cast<double>(x));
  };
  return {one(v.x), one(v.y), one(v.z)};
}

/// A plane as the camera sees it, worked out again.
struct SeenAgain {
  Noisy eye;
  Noisy a, b, c;
  Noisy at(double i, double j) const {
    return a * exactly(i) + b * exactly(j) + c;
  }
};

SeenAgain see_again(const Plane& p, const CameraData& camera) {
  constexpr double kStep = 1.0 / (1 << kLatticeBits);
  const auto right = in_steps(camera.sx, kStep);
  const auto down = in_steps(camera.sy, kStep);
  std::array<Noisy, 3> start = in_steps(camera.s0, kStep);
  for (std::size_t a = 0; a < 3; ++a) {
    start[a] = start[a] + (right[a] + down[a]) * exactly(0.5);
  }
  const auto eye = in_steps(camera.eye, camera.perspective ? kStep : 1);
  return {value_of(p, eye, !camera.perspective), value_of(p, right, true),
          value_of(p, down, true), value_of(p, start, false)};
}

TEST(ViewBounds, OfPlanesSeen) {
  Random random;
  for (const int bits : {26, 40, 54}) {
    Share eye;
    Share line;
    Share order;
    for (int round = 0; round < 3000; ++round) {
      const Camera camera = random_camera(random, bits);
      const View view = make_view(camera, bits);
      const Plane p = plane_through(random, bits);
      const Plane q = plane_through(random, bits);
      const ApproximateProjection found = project_approximately(p, view);
      const ApproximateProjection other = project_approximately(q, view);
      const SeenAgain p_again = see_again(p, camera.data());
      const SeenAgain q_again = see_again(q, camera.data());
      eye.add(p_again.eye.error, found.eye.error);
      const DepthDifference both = depth_difference(found, other);
      for (const double i : {0.0, 499.0}) {
        for (const double j : {0.0, 499.0}) {
          const Noisy p_at = p_again.at(i, j);
          const Noisy q_at = q_again.at(i, j);
          line.add(p_at.error, found.error);
          order.add((p_again.eye * q_at - q_again.eye * p_at).error,
                    both.error);
        }
      }
    }
    eye.expect_tight();
    line.expect_tight();
    order.expect_tight();
  }
}

/// The three camera coordinates, from rounded determinants.
TEST(ViewBounds, OfPoints) {
  Random random;
  Share across;
  Share depth;
  for (const int bits : {26, 40, 54}) {
    for (int round = 0; round < 3000; ++round) {
      const View view = make_view(random_camera(random, bits), bits);
      const GridPoint p = random.point(bits);
      const auto at = [&p](const Affine3& f) {
        // Each coefficient is a quotient of two rounded numbers.
        const auto known = [](double v) {
          return Noisy{v, 3 * kRounding * std::abs(v)};
        };
        const auto one = [](std::int64_t x) {
          return exactly(static_cast<double>(x));
        };
        return known(f.a) * one(p.x) + known(f.b) * one(p.y) +
               known(f.c) * one(p.z) + known(f.d);
      };
      across.add(std::max(at(view.x).error, at(view.y).error), view.xy_error);
      depth.add(at(view.t).error, view.t_error);
    }
  }
  across.expect_tight();
  depth.expect_tight();
}

}  // namespace
}  // namespace halfspace::fast
