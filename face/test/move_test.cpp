#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <numeric>
#include <vector>

#include "display_views.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/render.hpp"

namespace halfspace {
namespace {

/// A ball of triangles, and beside it some boxes in one mesh of quadrangles.
Mesh ball_and_boxes() {
  Mesh mesh = *Solid::sphere(1, 48).mesh();
  for (std::int32_t k = 0; k < 8; ++k) {
    const Mesh box =
        *Solid::box({1.5 + k, k * 0.25, -0.5}, {2.0 + k, 0.5 + k * 0.25, 0.5})
             .mesh();
    const auto first = static_cast<std::int32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), box.vertices.begin(),
                         box.vertices.end());
    for (std::size_t p = 0; p < box.polygon_count(); ++p) {
      std::vector<std::int32_t> corners;
      for (const std::int32_t v : box.corners_of(p))
        corners.push_back(first + v);
      mesh.add(corners);
    }
  }
  mesh.origins.clear();
  mesh.colors.clear();
  return mesh;
}

/// Moves vertices of a mesh and of what shows it.
class Moved {
 public:
  explicit Moved(Mesh mesh)
      : mesh_(std::move(mesh)), display_(*Display::of(mesh_)) {}

  Display& display() { return display_; }
  const Mesh& mesh() const { return mesh_; }

  /// Moves the last `count` vertices.
  void by(std::size_t count, const Point& way) {
    std::vector<std::int32_t> vertices(count);
    std::iota(vertices.begin(), vertices.end(),
              static_cast<std::int32_t>(mesh_.vertices.size() - count));
    std::vector<Point> points;
    for (const std::int32_t v : vertices) {
      Point& p = mesh_.vertices[static_cast<std::size_t>(v)];
      p = {p.x + way.x, p.y + way.y, p.z + way.z};
      points.push_back(p);
    }
    ASSERT_TRUE(display_.move_to(vertices, points));
  }

  /// How far a corner of the display is from the mesh's, at most.
  double distance() const {
    const Scene& scene = display_.scene();
    const Unit unit = scene.unit();
    const double step = std::pow(unit.base, unit.exponent);
    double most = 0;
    for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
      const auto face =
          static_cast<std::size_t>(display_.polygons_of_scene()[p]);
      for (const VertexId corner : scene.corners(static_cast<PolygonId>(p))) {
        const GridPoint& at = scene.point(corner);
        double least = std::numeric_limits<double>::infinity();
        for (const std::int32_t v : mesh_.corners_of(face)) {
          const Point& q = mesh_.vertices[static_cast<std::size_t>(v)];
          least = std::min(
              least,
              std::max({std::abs(static_cast<double>(at.x) * step - q.x),
                        std::abs(static_cast<double>(at.y) * step - q.y),
                        std::abs(static_cast<double>(at.z) * step - q.z)}));
        }
        most = std::max(most, least);
      }
    }
    return most;
  }

  /// Pictures, picks and rays are those of a new tree of the same polygons.
  void expect_shown(View view) {
    EXPECT_EQ(display_.polygon_count(), mesh_.polygon_count());
    const Scene& scene = display_.scene();
    const auto tree = fast::build_display_tree(scene);
    const Camera camera = *display_.camera(view);
    const fast::Rendering expected = fast::render(
        scene, tree, camera, {view.cull, Shading::kFlat, view.background});
    const Picture picture = *display_.render(view);
    EXPECT_TRUE(picture.colors == expected.colors);
    const auto polygons = display_.polygons_of_scene();
    for (std::size_t k = 0; k < picture.polygons.pixels.size(); ++k) {
      const PolygonId id = expected.items.pixels[k];
      const std::int32_t polygon =
          id == kBackground ? id : polygons[static_cast<std::size_t>(id)];
      ASSERT_EQ(picture.polygons.pixels[k], polygon);
      if (k % 97 != 0) continue;
      const auto pick =
          *display_.pick(view, static_cast<std::int32_t>(k) % view.width_px,
                         static_cast<std::int32_t>(k) / view.width_px);
      ASSERT_EQ(pick ? pick->polygon : kBackground, polygon);
    }
  }

 private:
  Mesh mesh_;
  Display display_;
};

View moved_view(bool lazy) {
  View view = small_view();
  view.eye = Point{6, -16, 5};
  view.target = Point{4, 0, 0};
  view.lazy = lazy;
  return view;
}

TEST(FaceDisplay, MovedPolygonsAreSeenWhereTheyAre) {
  for (const bool lazy : {true, false}) {
    Moved moved(ball_and_boxes());
    moved.expect_shown(moved_view(lazy));
    // A box, then two, then all of it, to and fro.
    for (const auto& [count, way] :
         {std::pair<std::size_t, Point>{8, {0.5, 0.25, 0}},
          {8, {-3, 0, 0.125}},
          {16, {-5, 0.5, 0.0625}},
          {moved.mesh().vertices.size(), {0, 0.5, 0}},
          {8, {2, 0, 0}}}) {
      moved.by(count, way);
      EXPECT_LT(moved.distance(), 1e-5);
      moved.expect_shown(moved_view(lazy));
    }
    // Rays go where the polygons are, and so do caps and drawings.
    const Point& p = moved.mesh().vertices.back();
    const auto hit =
        *moved.display().first_hit({p.x - 0.25, p.y - 0.25, 90}, {0, 0, -1});
    ASSERT_TRUE(hit.has_value());
    EXPECT_GE(hit->polygon,
              static_cast<std::int32_t>(moved.mesh().polygon_count()) - 6);
    View cut = moved_view(lazy);
    cut.clips = {{{0, 1, 0}, 0.6}};
    cut.caps = CapStyle{{1, 2, 3}, {}};
    EXPECT_TRUE(moved.display().render(cut));
    EXPECT_EQ(moved.display().draw(cut)->lines.size(),
              Display::of(moved.mesh())->draw(cut)->lines.size());
  }
}

TEST(FaceDisplay, AMovedDisplayKeepsItsGridWhileThatHoldsIt) {
  Moved moved(ball_and_boxes());
  const View view = moved_view(true);
  moved.expect_shown(view);
  moved.by(8, {0.1, 0.2, 0.3});
  const Unit unit = moved.display().scene().unit();
  const int bits = moved.display().scene().grid_bits();
  for (int k = 0; k < 3; ++k) {
    moved.by(8, {std::sin(k), 1.0 / 3, std::cos(k)});
    EXPECT_EQ(moved.display().scene().unit(), unit);
    EXPECT_EQ(moved.display().scene().grid_bits(), bits);
    EXPECT_LT(moved.distance(), 1e-5);
    moved.expect_shown(view);
  }
  // Far away there is none of its points.
  for (const double away : {1e6, -1e8}) {
    moved.by(8, {away, 0, 0});
    EXPECT_LT(moved.distance(), 1e-6);
    moved.expect_shown(view);
  }
  const std::vector<std::int32_t> one = {0};
  const std::vector<Point> astray = {{1e30, 0, 0}};
  EXPECT_EQ(moved.display().move_to(one, astray).error().code,
            ErrorCode::kOutOfRange);
  moved.expect_shown(view);
}

TEST(FaceDisplay, WhatMovesMayBeInsertedAndBeLeftByOthers) {
  Moved moved(ball_and_boxes());
  Display& display = moved.display();
  const auto count = static_cast<std::int32_t>(display.polygon_count());
  moved.by(8, {0, 1, 0});
  const std::vector<std::int32_t> some = {0, 7, count - 1};
  ASSERT_TRUE(display.remove(some));
  moved.by(8, {0, 1, 0});
  const Picture picture = *display.render(moved_view(true));
  for (const std::int32_t polygon : some) {
    EXPECT_EQ(std::count(picture.polygons.pixels.begin(),
                         picture.polygons.pixels.end(), polygon),
              0);
  }
  Mesh roof;
  roof.vertices = {{-1, -1, 2}, {9, -1, 2}, {4, 4, 2}};
  roof.add({0, 1, 2});
  ASSERT_TRUE(display.insert(roof));
  const std::vector<std::int32_t> vertex = {
      static_cast<std::int32_t>(moved.mesh().vertices.size()) + 2};
  const std::vector<Point> up = {{4, 4, 3}};
  ASSERT_TRUE(display.move_to(vertex, up));
  const auto hit = *display.first_hit({4, 1.5, 9}, {0, 0, -1});
  ASSERT_TRUE(hit.has_value());
  EXPECT_EQ(hit->polygon, count);
  EXPECT_EQ(hit->point.z, 2.5);
}

TEST(FaceDisplay, AMoveThatIsWrongChangesNothing) {
  Display display = *Display::of(Solid::box({0, 0, 0}, {2, 2, 2}));
  const Picture before = *display.render(small_view());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto code = [&](std::vector<std::int32_t> vertices,
                        std::vector<Point> points) {
    return display.move_to(vertices, points).error().code;
  };
  EXPECT_EQ(code({8}, {{0, 0, 0}}), ErrorCode::kBadIndex);
  EXPECT_EQ(code({-1}, {{0, 0, 0}}), ErrorCode::kBadIndex);
  EXPECT_EQ(code({0}, {{0, nan, 0}}), ErrorCode::kNotFinite);
  EXPECT_EQ(code({0, 1}, {{0, 0, 0}}), ErrorCode::kOutOfRange);
  EXPECT_EQ(code({0, 1, 2, 3, 4, 5, 6, 7}, std::vector<Point>(8)),
            ErrorCode::kEmpty);
  EXPECT_TRUE(display.move_to({}, {}));
  EXPECT_EQ(display.render(small_view())->polygons, before.polygons);
  // A corner away: three faces are cut in two, and keep their numbers.
  const std::vector<std::int32_t> one = {7};
  const std::vector<Point> out = {{3, 3, 3}};
  ASSERT_TRUE(display.move_to(one, out));
  EXPECT_EQ(display.polygon_count(), 6u);
  EXPECT_EQ(display.scene().polygon_count(), 9u);
}

TEST(FaceDisplay, PolygonsOfAFileKeepTheirColorsWhenOthersComeOrMove) {
  std::ofstream("two.mtl") << "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n";
  std::ofstream("two.obj")
      << "mtllib two.mtl\nv 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 2 2 1\n"
         "usemtl red\nf 1 2 5\nf 2 3 5\nusemtl blue\nf 3 4 5\nf 4 1 5\n";
  Mesh more;
  more.vertices = {{5, 0, 0}, {6, 0, 0}, {5, 1, 0}};
  more.add({0, 1, 2});
  more.colors = {{0, 255, 0}};
  Display display = *Display::of_file("two.obj");
  const auto colors = [&] {
    std::vector<Rgb> all;
    for (std::size_t p = 0; p < display.scene().polygon_count(); ++p)
      all.push_back(display.scene().color(static_cast<PolygonId>(p)));
    return all;
  };
  const Rgb red = colors()[0];
  const Rgb blue = colors()[3];
  EXPECT_NE(red, blue);
  const std::vector<std::int32_t> first = {0};
  ASSERT_TRUE(display.remove(first));
  ASSERT_TRUE(display.insert(more));
  const std::vector<Rgb> expected = {red, blue, blue, {0, 255, 0}};
  EXPECT_EQ(colors(), expected);
  const std::vector<std::int32_t> top = {4};
  for (const double z : {2.0, 3.0}) {
    const std::vector<Point> up = {{2, 2, z}};
    ASSERT_TRUE(display.move_to(top, up));
    EXPECT_EQ(colors(), expected);
  }
}

}  // namespace
}  // namespace halfspace
