#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "noisy.hpp"

/// The filters' bounds against running errors: what every rounding and every
/// error of an operand can add, worked out once more, operation by operation,
/// for numbers as large as the grids and cameras allow.
namespace halfspace::fast {
namespace {

TEST(FilterBounds, OfAPlanesValueAtAPoint) {
  Random random;
  for (const int bits : {26, 40, 54}) {
    Share share;
    for (int round = 0; round < 20000; ++round) {
      const Plane p = plane_through(random, bits);
      const Vertex v = to_vertex(random.point(bits));
      const Bounded found =
          value_at(filter_plane(p), v, rounding_of_values(bits));
      const Noisy again =
          value_of(p, {exactly(v.x), exactly(v.y), exactly(v.z)}, false);
      ASSERT_EQ(found.value, again.value);
      share.add(again.error, found.error);
    }
    share.expect_tight();
  }
}

/// A vertex that is off by more than rounding.
TEST(FilterBounds, OfAPlanesValueAtACut) {
  Random random;
  Share share;
  for (int round = 0; round < 20000; ++round) {
    const Plane p = plane_through(random, 26);
    Vertex v = to_vertex(random.point(26));
    v.error = random.from_to(0, 1e-3);
    const Bounded found = value_at(filter_plane(p), v, rounding_of_values(26));
    const Noisy again = value_of(
        p, {Noisy{v.x, v.error}, {v.y, v.error}, {v.z, v.error}}, false);
    share.add(again.error, found.error);
  }
  share.expect_tight();
}

TEST(FilterBounds, TheSignIsKnownBeyondTheBoundOnly) {
  EXPECT_EQ(filtered_sign({1.0, 0.99}), 1);
  EXPECT_EQ(filtered_sign({-1.0, 0.99}), -1);
  EXPECT_EQ(filtered_sign({1.0, 1.0}), 0);
  EXPECT_EQ(filtered_sign({-1.0, 1.0}), 0);
  EXPECT_EQ(filtered_sign({0.0, 0.0}), 0);
}

/// Where the values at the ends of an edge are what their bounds allow, the
/// meet is within its own.
TEST(FilterBounds, OfAMeetWithAnEdge) {
  Random random;
  Share share;
  for (int round = 0; round < 20000; ++round) {
    const Vertex p = to_vertex(random.point(26));
    const Vertex q = to_vertex(random.point(26));
    const Bounded hp = {random.from_to(1, 10), random.from_to(0, 0.5)};
    const Bounded hq = {-random.from_to(1, 10), random.from_to(0, 0.5)};
    const Vertex found = meet(p, hp, q, hq, rounding_of_values(26));
    for (int way = 0; way < 4; ++way) {
      const double a = hp.value + ((way & 1) != 0 ? hp.error : -hp.error);
      const double b = hq.value + ((way & 2) != 0 ? hq.error : -hq.error);
      const double t = a / (a - b);
      const double off = std::max({std::abs(p.x + t * (q.x - p.x) - found.x),
                                   std::abs(p.y + t * (q.y - p.y) - found.y),
                                   std::abs(p.z + t * (q.z - p.z) - found.z)});
      share.add(off, found.error);
    }
  }
  share.expect_tight();
}

/// Where the values at the ends are right, rounding is left.
TEST(FilterBounds, OfRoundingInAMeetWithAnEdge) {
  Random random;
  Share share;
  for (int round = 0; round < 20000; ++round) {
    const Vertex p = to_vertex(random.point(26));
    const Vertex q = to_vertex(random.point(26));
    const double hp = random.from_to(0.1, 10);
    const double hq = -random.from_to(0.1, 10);
    const Vertex found = meet(p, {hp, 0}, q, {hq, 0}, rounding_of_values(26));
    const Noisy t = exactly(hp) / (exactly(hp) - exactly(hq));
    const auto along = [&t](double from, double to) {
      return (exactly(from) + t * (exactly(to) - exactly(from))).error;
    };
    share.add(std::max({along(p.x, q.x), along(p.y, q.y), along(p.z, q.z)}),
              found.error);
  }
  share.expect_tight();
}

/// The same for the meet of two planes with a third.
TEST(FilterBounds, OfAMeetOfThreePlanes) {
  Random random;
  Share share;
  for (int round = 0; round < 4000; ++round) {
    std::array<Vertex, 3> p;
    std::array<Bounded, 3> f;
    std::array<Bounded, 3> g;
    double extent = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = to_vertex(random.point(26));
      f[k] = {random.from_to(-10, 10), random.from_to(0, 0.01)};
      g[k] = {random.from_to(-10, 10), random.from_to(0, 0.01)};
      extent = std::max({extent, std::abs(p[k].x - p[0].x),
                         std::abs(p[k].y - p[0].y), std::abs(p[k].z - p[0].z)});
    }
    const Vertex found = meet(p, f, g, extent, rounding_of_values(26));
    const auto w = [](const auto& a, const auto& b, std::size_t i) {
      const std::size_t j = (i + 1) % 3;
      const std::size_t k = (i + 2) % 3;
      return a[j] * b[k] - a[k] * b[j];
    };
    for (int way = 0; way < 64; ++way) {
      std::array<double, 3> a;
      std::array<double, 3> b;
      for (std::size_t k = 0; k < 3; ++k) {
        a[k] = f[k].value + (((way >> k) & 1) != 0 ? 1 : -1) * f[k].error;
        b[k] = g[k].value + (((way >> (k + 3)) & 1) != 0 ? 1 : -1) * g[k].error;
      }
      const double total = w(a, b, 0) + w(a, b, 1) + w(a, b, 2);
      const double s = w(a, b, 1) / total;
      const double t = w(a, b, 2) / total;
      // The true meet is in the polygon: others are not promised anything.
      if (!(s >= 0 && t >= 0 && s + t <= 1)) continue;
      const auto at = [&](double u, double v, double x) {
        return u + s * (v - u) + t * (x - u);
      };
      const double off =
          std::max({std::abs(at(p[0].x, p[1].x, p[2].x) - found.x),
                    std::abs(at(p[0].y, p[1].y, p[2].y) - found.y),
                    std::abs(at(p[0].z, p[1].z, p[2].z) - found.z)});
      share.add(off, found.error);
    }
  }
  share.expect_tight();
}

}  // namespace
}  // namespace halfspace::fast
