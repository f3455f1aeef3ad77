#include "raster/depth_line.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "noisy.hpp"
#include "raster/skew_view.hpp"

namespace halfspace::fast {
namespace {

/// Where its vertices are moved by their errors, a fragment is as near as that
/// says.
TEST(DepthLine, HoldsWhereVerticesAreMovedByTheirErrors) {
  CameraData camera = skew_camera(300);
  for (const bool perspective : {true, false}) {
    camera.perspective = perspective;
    const View view = make_view(*make_camera(camera, 26), 26);
    Random random;
    std::size_t told = 0;
    double largest = 0;
    for (int round = 0; round < 20'000; ++round) {
      std::vector<Vertex> vertices(3);
      for (Vertex& v : vertices) {
        v = {random.from_to(-90, 90), random.from_to(-90, 90),
             random.from_to(-90, 90), random.from_to(0, 0x1p-12)};
      }
      const DepthDifference depth = depth_of(vertices, view, 256);
      if (!(depth.error < (perspective ? 0.1 : 10))) continue;
      const int ways = static_cast<int>(random.from_to(0, 512));
      const double one = random.from_to(0, 1);
      const double two = random.from_to(0, 1 - one);
      const std::array<double, 3> weights = {one, two, 1 - one - two};
      Vertex p;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vertex v = moved(vertices[k], ways >> (3 * k));
        p.x += weights[k] * v.x;
        p.y += weights[k] * v.y;
        p.z += weights[k] * v.z;
      }
      const double t = view.t.at(p.x, p.y, p.z);
      const double over = perspective ? t : 1;
      const double i = view.x.at(p.x, p.y, p.z) / over - 0.5;
      const double j = view.y.at(p.x, p.y, p.z) / over - 0.5;
      if (std::abs(i) > 256 || std::abs(j) > 256) continue;
      ++told;
      const double found = depth.a * i + (depth.b * j + depth.c);
      const double off = std::abs(found - (perspective ? 1 / t : -t));
      ASSERT_LE(off, depth.error);
      largest = std::max(largest, off / depth.error);
    }
    EXPECT_GT(told, 5000u);
    EXPECT_GT(largest, 0.01);
  }
}

}  // namespace
}  // namespace halfspace::fast
