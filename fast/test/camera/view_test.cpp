#include "camera/view.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "noisy.hpp"
#include "raster/depth_line.hpp"
#include "raster/polygon_rasterizer.hpp"
#include "raster/tile_buffer.hpp"
#include "scenes.hpp"

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

/// What a kernel was given last.
struct Given {
  std::array<double, 3> x{};
  std::array<double, 3> y{};
  double error = 0;
  std::int32_t turn = 0;
};
Given given;

std::int64_t take(TileView&, const Outline& outline, const PixelSource&) {
  std::copy_n(outline.x, 3, given.x.begin());
  std::copy_n(outline.y, 3, given.y.begin());
  given.error = outline.error;
  given.turn = outline.turn;
  return 0;
}

/// Draws one fragment, whose vertices are anywhere, by a kernel that only looks
/// at its outline.
class Fixture {
 public:
  explicit Fixture(const CameraData& camera)
      : scene_(one_triangle()),
        camera_(*make_camera(camera, 26)),
        view_(make_view(camera_, 26)) {
    tree_.corners = {{0, 3}, {1, 4}, {2, 5}};
    tree_.fragments = {{0, 0, 3, 0, kNoFragment}};
    kernel_.draw = &take;
  }

  /// Whether the eye's side was asked for.
  bool draw(const std::vector<Vertex>& vertices) {
    given = {};
    tree_.cut_vertices = vertices;
    Rendering result;
    TileBuffer buffer({0, 0, 8, 8}, {0, 8}, result, false);
    const TreeReader reader(scene_, tree_);
    const Frame frame = {reader, camera_.data(), image_, view_, kernel_};
    bool asked = false;
    PolygonRasterizer<26>(frame, buffer.view())
        .draw_any(tree_.fragments[0], [&](const TreeFragment&) {
          asked = true;
          return 1;
        });
    return asked;
  }
  const View& view() const { return view_; }

  /// The depth of the fragment with these vertices.
  DepthDifference depth(const std::vector<Vertex>& vertices) const {
    return depth_of(vertices, view_, 256);
  }

 private:
  static Scene one_triangle() {
    SceneData data;
    add_polygon(data, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    return made(std::move(data));
  }

  Scene scene_;
  Camera camera_;
  View view_;
  ImageOptions image_;
  BspTree tree_;
  TileKernel kernel_ = kPortableKernel;
};

/// An image plane that is not square, so far from the eye.
CameraData skew_camera(int steps) {
  CameraData camera;
  camera.eye = {0, 0, -steps * 256};
  camera.s0 = {-4 * 256, -4 * 256, 0};
  camera.sx = {200, 60, 30};
  camera.sy = {-50, 230, 10};
  camera.width_px = camera.height_px = 8;
  return camera;
}

/// The same vertex, moved to a corner of the cube around it: way 0 to 7.
Vertex moved(Vertex v, int way) {
  v.x += (way & 1) != 0 ? v.error : -v.error;
  v.y += (way & 2) != 0 ? v.error : -v.error;
  v.z += (way & 4) != 0 ? v.error : -v.error;
  return v;
}

TEST(ViewBounds, OfOutlines) {
  CameraData camera = skew_camera(100);
  for (const bool perspective : {true, false}) {
    camera.perspective = perspective;
    Fixture fixture(camera);
    const View& view = fixture.view();
    Random random;
    Share share;
    for (int round = 0; round < 5000; ++round) {
      std::vector<Vertex> vertices(3);
      for (Vertex& v : vertices) {
        v = {random.from_to(-90, 90), random.from_to(-90, 90),
             random.from_to(-90, 90), random.from_to(0, 0x1p-14)};
      }
      fixture.draw(vertices);
      if (given.error == 0) continue;  // line by line
      for (std::size_t k = 0; k < 3; ++k) {
        for (int way = 0; way < 8; ++way) {
          const Vertex v = moved(vertices[k], way);
          const double t = perspective ? view.t.at(v.x, v.y, v.z) : 1;
          share.add(std::abs(view.x.at(v.x, v.y, v.z) / t - given.x[k]),
                    given.error);
          share.add(std::abs(view.y.at(v.x, v.y, v.z) / t - given.y[k]),
                    given.error);
        }
      }
    }
    share.expect_tight();
  }
}

/// Where its vertices are moved by their errors, a fragment is as near as that
/// says.
TEST(ViewBounds, OfDepths) {
  CameraData camera = skew_camera(300);
  for (const bool perspective : {true, false}) {
    camera.perspective = perspective;
    Fixture fixture(camera);
    const View& view = fixture.view();
    Random random;
    std::size_t told = 0;
    double largest = 0;
    for (int round = 0; round < 20'000; ++round) {
      std::vector<Vertex> vertices(3);
      for (Vertex& v : vertices) {
        v = {random.from_to(-90, 90), random.from_to(-90, 90),
             random.from_to(-90, 90), random.from_to(0, 0x1p-12)};
      }
      const DepthDifference depth = fixture.depth(vertices);
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

/// Triangles so thin that their vertices' errors turn them over.
TEST(ViewBounds, OutlinesTurnForSureOrTheEyeIsAsked) {
  CameraData camera;
  camera.perspective = false;
  camera.eye = {0, 0, 256};
  camera.sx = {256, 0, 0};
  camera.sy = {0, 256, 0};
  camera.width_px = camera.height_px = 8;
  Fixture fixture(camera);
  Random random;
  std::size_t told = 0;
  for (int round = 0; round < 20000; ++round) {
    const double error = random.from_to(0x1p-14, 0x1p-12);
    std::vector<Vertex> p(3);
    for (Vertex& v : p) {
      v = {random.from_to(-90, 90), random.from_to(-90, 90), 0, error};
    }
    // The third moves to the line through the others, nearly.
    const double t = random.from_to(-0.5, 1.5);
    p[2].x = p[0].x + t * (p[1].x - p[0].x) + random.from_to(-24, 24) * error;
    p[2].y = p[0].y + t * (p[1].y - p[0].y) + random.from_to(-24, 24) * error;
    if (fixture.draw(p)) continue;
    ++told;
    for (int way = 0; way < 64; ++way) {
      const Vertex a = moved(p[0], way & 3);
      const Vertex b = moved(p[1], (way >> 2) & 3);
      const Vertex c = moved(p[2], way >> 4);
      const double turn = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
      ASSERT_EQ(turn > 0, given.turn > 0);
    }
  }
  EXPECT_GT(told, 1000u);
}

}  // namespace
}  // namespace halfspace::fast
