#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "display_views.hpp"

namespace halfspace {
namespace {

TEST(FaceDisplay, LazyTreesGiveTheSamePictures) {
  const Mesh ball = *Solid::sphere(1, 64).mesh();
  const Display eager = *Display::of(ball);
  Display lazy = *Display::of(ball);
  View view = small_view();
  const auto expect_same = [&](const Display& one, const Display& other) {
    for (const std::uint8_t alpha : {kOpaque, std::uint8_t{90}}) {
      for (const double x : {9.0, -9.0, 0.5}) {
        view.eye = Point{x, 3, 2};
        view.target = Point{0, 0, 0};
        view.alpha = alpha;
        view.lazy = false;
        const Picture expected = *one.render(view);
        view.lazy = true;
        const Picture picture = *other.render(view);
        EXPECT_TRUE(picture.polygons == expected.polygons);
        EXPECT_TRUE(picture.colors == expected.colors);
      }
    }
    view.alpha = kOpaque;
  };
  expect_same(eager, lazy);
  view.anti_aliasing = AntiAliasing::k4;
  EXPECT_TRUE(lazy.render(view)->colors == eager.render(view)->colors);
  view.anti_aliasing = AntiAliasing::kNone;
  // What has changed is not what was opened; a whole tree is taken when there.
  const std::vector<std::int32_t> some = {5, 6, 7, 900};
  Display less = *Display::of(ball);
  ASSERT_TRUE(less.remove(some));
  ASSERT_TRUE(lazy.remove(some));
  expect_same(less, lazy);
  View whole = view;
  whole.lazy = false;
  for (std::int32_t k = 0; k < 48; k += 5) {
    const auto pick = *lazy.pick(view, k + 8, k);
    const auto expected = *less.pick(whole, k + 8, k);
    ASSERT_EQ(pick.has_value(), expected.has_value());
    if (pick) {
      EXPECT_EQ(pick->polygon, expected->polygon);
    }
  }
  EXPECT_TRUE(lazy.pick(whole, 10, 10));
  expect_same(less, lazy);
}

TEST(FaceDisplay, RaysBuildWhatTheyComeToAndHitTheSame) {
  const Mesh ball = *Solid::sphere(1, 64).mesh();
  const Display eager = *Display::of(ball);
  ASSERT_TRUE(eager.render(small_view()));
  const Display lazy = *Display::of(ball);
  View view = small_view();
  view.lazy = true;
  for (int k = 0; k < 40; ++k) {
    const Point from = {4 * std::cos(k), 4 * std::sin(k), k * 0.1 - 2};
    const Point along = {-from.x, -from.y, 0.25 - from.z};
    const auto first = *lazy.first_hit(from, along);
    const auto expected = *eager.first_hit(from, along);
    ASSERT_TRUE(first && expected);
    EXPECT_EQ(first->polygon, expected->polygon);
    EXPECT_EQ(first->fraction, expected->fraction);
    const Point to = {from.x + 2 * along.x, from.y + 2 * along.y,
                      from.z + 2 * along.z};
    EXPECT_EQ(lazy.all_hits(from, along)->size(),
              eager.all_hits(from, along)->size());
    EXPECT_EQ(lazy.hits_between(from, to)->size(),
              eager.hits_between(from, to)->size());
    EXPECT_EQ(*lazy.see_each_other(from, to), *eager.see_each_other(from, to));
    if (k % 10 == 0) {
      EXPECT_EQ(lazy.render(view)->polygons, eager.render(view)->polygons);
    }
  }
}

TEST(FaceDisplay, FeedsTrianglesInTheOrderOfATraversal) {
  const Solid parts[] = {Solid::box({0, 0, 0}, {2, 2, 2}),
                         Solid::sphere(1.5, 12).translated({2, 2, 2})};
  const Display display = *Display::of(parts);
  const CutDisplay cut = *CutDisplay::of(display);
  const VertexFeed feed = cut.vertex_feed();
  ASSERT_EQ(feed.positions.size(), feed.polygons.size());
  for (const Point& eye : {Point{9, 8, 7}, Point{-4, 9, 1}}) {
    View view;
    view.eye = eye;
    const auto indices = *cut.feed_indices(view);
    ASSERT_EQ(indices.size() % 3, 0u);
    std::size_t next = 0;
    const auto done = display.back_to_front(view, [&](const SeenPolygon& seen) {
      for (std::size_t k = 0; k + 2 < seen.points.size(); ++k, next += 3) {
        ASSERT_LE(next + 3, indices.size());
        EXPECT_EQ(feed.polygons[indices[next]], seen.polygon);
        EXPECT_EQ(feed.positions[indices[next]], seen.points[0]);
        EXPECT_EQ(feed.positions[indices[next + 1]], seen.points[k + 1]);
        EXPECT_EQ(feed.positions[indices[next + 2]], seen.points[k + 2]);
      }
    });
    EXPECT_TRUE(done);
    EXPECT_EQ(next, indices.size());
    const auto front = *cut.feed_indices(view, FeedOrder::kFrontToBack);
    EXPECT_EQ(front.size(), indices.size());
    EXPECT_NE(front, indices);
  }
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

TEST(FaceDisplay, DrawsTheEdgesOfASection) {
  const Display display = *Display::of(Solid::box({0, 0, 0}, {2, 2, 2}));
  View view;
  view.eye = Point{9, -7, 6};
  view.clips = {{{-1, 0, 0}, -1}, {{0, 1, 0}, 1}};
  view.caps = CapStyle{{1, 2, 3}, {}};
  const auto drawing = *display.draw(view);
  // What is left is a box again; nine of its edges are seen, and of those
  // both caps have seven, one of them together.
  int visible = 0;
  int sections = 0;
  for (const DrawnLine& line : drawing.lines) {
    if (line.layers > 0) continue;
    ++visible;
    sections += line.edge_class == EdgeClass::kSection ? 1 : 0;
  }
  EXPECT_EQ(visible, 9);
  EXPECT_EQ(sections, 7);
  EXPECT_EQ(drawing.lines.size(), 12u);
  // Without caps none of them meet.
  view.caps.reset();
  const auto open = *display.draw(view);
  EXPECT_EQ(std::count_if(open.lines.begin(), open.lines.end(),
                          [](const DrawnLine& line) {
                            return line.edge_class == EdgeClass::kSection;
                          }),
            6);
}

/// Twice the area that the loops of a region go round.
double twice_area(const SeenRegion& region) {
  double sum = 0;
  for (const std::vector<Point2>& loop : region.loops) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Point2& p = loop[k];
      const Point2& q = loop[(k + 1) % loop.size()];
      sum += p.x * q.y - p.y * q.x;
    }
  }
  return std::abs(sum);
}

TEST(FaceDisplay, TraversalsCullAndDoNotClip) {
  const Display display = *Display::of(Solid::box({0, 0, 0}, {2, 2, 2}));
  View view;
  view.eye = Point{9, -7, 6};
  view.cull = true;
  std::size_t visited = 0;
  EXPECT_TRUE(
      display.back_to_front(view, [&](const SeenPolygon&) { ++visited; }));
  EXPECT_EQ(visited, 3u);
  view.clips = {{{0, 1, 0}, 1}};
  const auto clipped =
      display.front_to_back(view, [](const SeenPolygon&) { return true; });
  ASSERT_FALSE(clipped.has_value());
  EXPECT_EQ(clipped.error().code, ErrorCode::kOutOfRange);
}

TEST(FaceDisplay, AFigureIsThePictureAsRegions) {
  const std::vector<Solid> solids = {Solid::box({0, 0, 0}, {2, 2, 2}),
                                     Solid::box({3, 0, 0}, {5, 2, 2})};
  const Display display = *Display::of(solids);
  View view;
  view.eye = Point{9, -7, 6};
  const Figure by_polygon = *display.figure(view, FigureKey::kPolygon);
  EXPECT_EQ(by_polygon.regions.size(), 7u);
  const Figure by_solid = *display.figure(view, FigureKey::kSolid);
  ASSERT_EQ(by_solid.regions.size(), 3u);
  double all = 0;
  for (const SeenRegion& region : by_solid.regions) all += twice_area(region);
  EXPECT_NEAR(all, 2.0 * view.width_px * view.height_px, 1e-6);
  // A region has the colour that the picture has where it is.
  const Picture picture = *display.render(view);
  std::set<std::pair<std::int32_t, Rgb>> drawn, seen;
  for (const SeenRegion& region : by_polygon.regions)
    drawn.emplace(region.polygon, region.color);
  for (std::size_t k = 0; k < picture.polygons.pixels.size(); ++k)
    seen.emplace(picture.polygons.pixels[k], picture.colors.pixels[k]);
  EXPECT_EQ(drawn, seen);
  Figure lined = by_solid;
  lined.lines = display.draw(view)->lines;
  EXPECT_TRUE(lined.save("figure.svg").has_value());
  EXPECT_EQ(lined.save("figure.bmp").error().code, ErrorCode::kUnknownFormat);
}

TEST(FaceDisplay, AFigureHasClipPlanesAndCaps) {
  const Display display = *Display::of(Solid::box({0, 0, 0}, {2, 2, 2}));
  View view;
  view.eye = Point{9, -7, 6};
  view.clips = {{{0, 1, 0}, 1}};
  view.caps = CapStyle{{1, 2, 3}, std::nullopt};
  const Figure capped = *display.figure(view);
  const auto is_cap = [](const SeenRegion& region) {
    return region.polygon == 6 && region.color == Rgb{1, 2, 3};
  };
  EXPECT_EQ(std::count_if(capped.regions.begin(), capped.regions.end(), is_cap),
            1);
  view.caps->hatch = Rgb{4, 5, 6};
  EXPECT_GT(display.figure(view)->regions.size(), 20u);
}

}  // namespace
}  // namespace halfspace
