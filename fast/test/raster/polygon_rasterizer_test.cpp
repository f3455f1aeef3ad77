#include "raster/polygon_rasterizer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "noisy.hpp"
#include "raster/skew_view.hpp"
#include "raster/tile_buffer.hpp"
#include "scenes.hpp"

namespace halfspace::fast {
namespace {

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
    const ClipSet clips(image_.clips, false, 26);
    const Frame frame = {reader, camera_.data(), image_, view_, kernel_, clips};
    bool asked = false;
    PolygonRasterizer<26>(frame, buffer.view())
        .draw_any(tree_.fragments[0], [&](const TreeFragment&) {
          asked = true;
          return 1;
        });
    return asked;
  }
  const View& view() const { return view_; }

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

TEST(PolygonRasterizer, OfOutlines) {
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

/// Triangles so thin that their vertices' errors turn them over.
TEST(PolygonRasterizer, OutlinesTurnForSureOrTheEyeIsAsked) {
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
