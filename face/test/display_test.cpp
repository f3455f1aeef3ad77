#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "halfspace/halfspace.hpp"

namespace halfspace {
namespace {

Solid knot() {
  return Solid::torus(3, 1, 16, 8) + Solid::box({-1, -1, -2}, {1, 1, 3});
}

View small_view() {
  View view;
  view.width_px = 64;
  view.height_px = 48;
  return view;
}

TEST(FaceDisplay, AScanLineRendererGetsThePicture) {
  const Display display = *Display::of(knot());
  const View view = small_view();
  const Picture picture = *display.render(view);
  ItemImage items(64, 48, kBackground);
  DynamicScreen screen(64, 48);
  ASSERT_TRUE(display.front_to_back(view, [&](const SeenPolygon& polygon) {
    for (const PixelSpan& lit : screen.light(polygon.spans())) {
      for (std::int32_t x = lit.first; x <= lit.last; ++x) {
        items.at(x, lit.line) = polygon.polygon;
        EXPECT_EQ(picture.colors.at(x, lit.line), polygon.color);
      }
    }
    return !screen.is_full();
  }));
  EXPECT_EQ(items, picture.polygons);
}

TEST(FaceDisplay, APainterGetsThePicture) {
  const Display display = *Display::of(knot());
  const View view = small_view();
  ItemImage items(64, 48, kBackground);
  ASSERT_TRUE(display.back_to_front(view, [&](const SeenPolygon& polygon) {
    for (const PixelSpan& span : polygon.spans()) {
      for (std::int32_t x = span.first; x <= span.last; ++x)
        items.at(x, span.line) = polygon.polygon;
    }
    return true;
  }));
  EXPECT_EQ(items, display.render(view)->polygons);
}

TEST(FaceDisplay, ProjectedCornersAreWhereTheSpansAre) {
  const Display display = *Display::of(knot());
  std::size_t seen = 0;
  ASSERT_TRUE(
      display.front_to_back(small_view(), [&](const SeenPolygon& polygon) {
        for (const PixelSpan& span : polygon.spans()) {
          double low = 1e9, high = -1e9;
          for (const Point2& p : polygon.projected) {
            low = std::min(low, p.x);
            high = std::max(high, p.x);
          }
          EXPECT_LE(low, span.first + 0.5 + 1e-6);
          EXPECT_GE(high, span.last + 0.5 - 1e-6);
          ++seen;
        }
        return true;
      }));
  EXPECT_GT(seen, 100u);
}

TEST(FaceDisplay, PicksNameTheSolid) {
  const std::vector<Solid> solids = {
      Solid::box({0, 0, 0}, {1, 1, 1}), Solid(),
      Solid::box({0, 0, 0}, {1, 1, 1}).translated({3, 0, 0})};
  const Display display = *Display::of(solids);
  View view = small_view();
  view.eye = Point{0.5, -10, 0.5};
  view.target = Point{0.5, 0, 0.5};
  EXPECT_EQ((*display.pick(view, 32, 24))->solid, 0);
  view.eye = Point{3.5, -10, 0.5};
  view.target = Point{3.5, 0, 0.5};
  EXPECT_EQ((*display.pick(view, 32, 24))->solid, 2);
  EXPECT_FALSE(display.pick(view, 0, 0)->has_value());
  EXPECT_FALSE(display.pick(view, -1, 99)->has_value());
}

TEST(FaceDisplay, InsertedPolygonsAreSeenAsIfTheyHadBeenThere) {
  const Mesh base = *knot().mesh();
  Mesh roof;
  roof.vertices = {{-4, -4, 1.5}, {4, -4, 0.5}, {0, 4, 2}};
  roof.add({0, 1, 2});
  roof.colors = {{200, 20, 20}};
  Mesh all = base;
  all.origins.clear();
  all.vertices.insert(all.vertices.end(), roof.vertices.begin(),
                      roof.vertices.end());
  const auto first = static_cast<std::int32_t>(base.vertices.size());
  all.add({first, first + 1, first + 2});
  const Display together = *Display::of(all);
  for (const bool is_ordered : {false, true}) {
    Display display = *Display::of(base);
    if (is_ordered) {
      ASSERT_TRUE(
          display.front_to_back({}, [](const SeenPolygon&) { return false; }));
    }
    ASSERT_TRUE(display.insert(roof));
    View view = small_view();
    view.eye = Point{6, -9, 8};
    EXPECT_EQ(display.render(view)->polygons, together.render(view)->polygons);
    EXPECT_EQ(display.polygon_count(), base.polygon_count() + 1);
  }
}

TEST(FaceDisplay, BadViewsAndMeshesAreErrors) {
  const Display display = *Display::of(knot());
  View view = small_view();
  view.width_px = 0;
  EXPECT_EQ(display.render(view).error().code, ErrorCode::kOutOfRange);
  view = small_view();
  view.fov_deg = 180;
  EXPECT_EQ(display.render(view).error().code, ErrorCode::kBadCamera);
  EXPECT_EQ(Display::of(Mesh{}).error().code, ErrorCode::kEmpty);
  EXPECT_EQ(Display::of(Solid()).error().code, ErrorCode::kEmpty);
  EXPECT_EQ(Display::of_file("no.off").error().code, ErrorCode::kUnreadable);
}

TEST(FaceDisplay, RaysHitWhatIsThere) {
  const std::vector<Solid> solids = {Solid::box({0, 0, 0}, {1, 1, 1}),
                                     Solid::box({2, 0, 0}, {4, 1, 1})};
  const Display display = *Display::of(solids);
  const auto first = *display.first_hit({-1, 0.25, 0.5}, {2, 0, 0});
  ASSERT_TRUE(first.has_value());
  EXPECT_EQ(first->solid, 0);
  EXPECT_EQ(first->fraction, "1/2");
  EXPECT_EQ(first->parameter, 0.5);
  EXPECT_EQ(first->distance, 1);
  EXPECT_EQ(first->point.x, 0);
  EXPECT_EQ(first->point.y, 0.25);
  EXPECT_EQ(display.all_hits({-1, 0.25, 0.5}, {2, 0, 0})->size(), 4u);
  EXPECT_EQ(display.hits_between({0.5, 0.25, 0.5}, {3, 0.25, 0.5})->size(), 2u);
  EXPECT_TRUE(*display.see_each_other({1, 0.5, 0.5}, {2, 0.5, 0.5}));
  EXPECT_FALSE(*display.see_each_other({1, 0.5, 0.5}, {3, 0.5, 0.5}));
  EXPECT_FALSE(display.first_hit({9, 9, 9}, {1, 0, 0})->has_value());
  EXPECT_EQ(display.first_hit({9, 9, 9}, {0, 0, 0}).error().code,
            ErrorCode::kBadRay);
  EXPECT_EQ(display.first_hit({0, 0, 1e300}, {0, 0, 1}).error().code,
            ErrorCode::kOutOfRange);
  EXPECT_EQ(display.see_each_other({0, 0, 0}, {0, 0, 0}).error().code,
            ErrorCode::kBadRay);
}

TEST(FaceDisplay, PicksTellWhere) {
  const Display display = *Display::of(Solid::box({0, 0, 0}, {2, 2, 2}));
  View view;
  view.eye = Point{9, 1, 1};
  view.target = Point{1, 1, 1};
  view.width_px = 65;
  view.height_px = 65;
  const auto pick = *display.pick(view, 32, 32);
  ASSERT_TRUE(pick.has_value());
  EXPECT_EQ(pick->point.x, 2);
  EXPECT_NEAR(pick->point.y, 1, 1e-6);
  EXPECT_NEAR(pick->distance, 7, 1e-6);
}

TEST(FaceDisplay, ClipPlanesCutAndCapsFill) {
  const Display display = *Display::of(Solid::box({0, 0, 0}, {2, 2, 2}));
  View view;
  view.eye = Point{1, -9, 1};
  view.target = Point{1, 1, 1};
  view.width_px = 65;
  view.height_px = 65;
  view.clips = {{{0, 1, 0}, 1}};
  const auto count = static_cast<std::int32_t>(display.polygon_count());
  EXPECT_LT(display.render(view)->polygons.at(32, 32), count);
  view.caps = CapStyle{{1, 2, 3}, {}};
  const Picture picture = *display.render(view);
  EXPECT_EQ(picture.polygons.at(32, 32), count);
  EXPECT_EQ(picture.colors.at(32, 32), (Rgb{1, 2, 3}));
  EXPECT_EQ((*display.pick(view, 32, 32))->solid, -1);
  for (int k = 0; k < 8; ++k) view.clips.push_back({{1, 0, 0}, -1.0 - k});
  EXPECT_EQ(display.render(view).error().code, ErrorCode::kOutOfRange);
  view.clips = {{{0, 0, 0}, 1}};
  EXPECT_EQ(display.render(view).error().code, ErrorCode::kZeroArea);
  Mesh open;
  open.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  open.add({0, 1, 2});
  view.clips = {{{1, 0, 0}, 0.5}};
  EXPECT_EQ(Display::of(open)->render(view).error().code, ErrorCode::kOpen);
}

TEST(FaceDisplay, DrawsVisibleAndHiddenEdges) {
  const Display display = *Display::of(Solid::box({0, 0, 0}, {2, 2, 2}));
  View view;
  view.eye = Point{9, -7, 6};
  const auto drawing = *display.draw(view);
  ASSERT_EQ(drawing.lines.size(), 12u);
  int hidden = 0;
  int outlines = 0;
  for (const DrawnLine& line : drawing.lines) {
    hidden += line.layers > 0 ? 1 : 0;
    outlines += line.edge_class == EdgeClass::kSilhouette ? 1 : 0;
  }
  EXPECT_EQ(hidden, 3);
  EXPECT_EQ(outlines, 6);
  EXPECT_TRUE(drawing.save("drawn.svg", true).has_value());
  EXPECT_EQ(drawing.save("drawn.bmp").error().code, ErrorCode::kUnknownFormat);
  EXPECT_EQ(display.draw(view, 181).error().code, ErrorCode::kOutOfRange);
}

}  // namespace
}  // namespace halfspace
