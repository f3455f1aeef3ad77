#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <set>
#include <span>
#include <vector>

#include "display_views.hpp"

namespace halfspace {
namespace {

TEST(FaceDisplay, LeadsToTheExactSceneAndCamera) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0.5}, {0, 1, 0}, {0, 0, 3}};
  mesh.add({0, 1, 4});
  mesh.add({0, 1, 2, 3});  // not planar: two triangles
  const Display display = *Display::of(mesh);
  const auto polygons = display.polygons_of_scene();
  EXPECT_EQ(display.scene().polygon_count(), 3u);
  EXPECT_EQ(std::vector<std::int32_t>(polygons.begin(), polygons.end()),
            (std::vector<std::int32_t>{0, 1, 1}));
  const View view = small_view();
  const Result<Camera> camera = display.camera(view);
  ASSERT_TRUE(camera);
  EXPECT_EQ((*camera)->width_px, 64);
  View flat = view;
  flat.eye = flat.target = Point{1, 1, 1};
  EXPECT_EQ(display.camera(flat).error().code, ErrorCode::kBadCamera);
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

/// The mesh without some polygons.
Mesh without(const Mesh& mesh, const std::set<std::int32_t>& gone) {
  Mesh left;
  left.vertices = mesh.vertices;
  for (std::size_t p = 0; p < mesh.polygon_count(); ++p) {
    if (!gone.contains(static_cast<std::int32_t>(p)))
      left.add(mesh.corners_of(p));
  }
  return left;
}

TEST(FaceDisplay, RemovedPolygonsAreGoneAndOthersKeepTheirNumbers) {
  Mesh base = *knot().mesh();
  base.colors.clear();
  std::set<std::int32_t> gone;
  std::vector<std::int32_t> kept;
  std::vector<std::int32_t> list;
  for (std::int32_t p = 0; p < static_cast<std::int32_t>(base.polygon_count());
       ++p) {
    if (p % 3 == 1) gone.insert(p);
    if (p % 3 == 1) list.push_back(p);
    if (p % 3 != 1) kept.push_back(p);
  }
  View view = small_view();
  view.eye = Point{6, -9, 8};
  view.target = Point{0, 0, 0};
  Picture expected = *Display::of(without(base, gone))->render(view);
  for (std::int32_t& polygon : expected.polygons.pixels) {
    if (polygon != kBackground)
      polygon = kept[static_cast<std::size_t>(polygon)];
  }
  for (const bool is_ordered : {false, true}) {
    Display display = *Display::of(base);
    ASSERT_TRUE(display.render(view));
    if (is_ordered) {
      ASSERT_TRUE(display.front_to_back(view, [](const SeenPolygon&) {}));
    }
    ASSERT_TRUE(display.remove(list));
    EXPECT_EQ(display.polygon_count(), base.polygon_count());
    EXPECT_EQ(display.render(view)->polygons, expected.polygons);
    std::size_t shown = 0;
    ASSERT_TRUE(display.back_to_front(view, [&](const SeenPolygon& polygon) {
      EXPECT_FALSE(gone.contains(polygon.polygon));
      ++shown;
    }));
    EXPECT_GE(shown, kept.size() / 2);
    // Some of them come again, with numbers of their own.
    const Mesh again = without(base, {kept.begin(), kept.end()});
    const auto first = static_cast<std::int32_t>(display.polygon_count());
    ASSERT_TRUE(display.insert(again));
    Picture all = *Display::of(base)->render(view);
    for (std::int32_t& polygon : all.polygons.pixels) {
      const auto at = gone.find(polygon);
      if (at != gone.end())
        polygon =
            first + static_cast<std::int32_t>(std::distance(gone.begin(), at));
    }
    EXPECT_EQ(display.render(view)->polygons, all.polygons);
    // All that came goes: the tree is as it was, or made anew.
    std::vector<std::int32_t> came(gone.size());
    std::iota(came.begin(), came.end(), first);
    ASSERT_TRUE(display.remove(came));
    ASSERT_TRUE(display.remove(came));
    EXPECT_EQ(display.render(view)->polygons, expected.polygons);
  }
}

TEST(FaceDisplay, OnlyPolygonsThatAreThereAreRemoved) {
  Display display = *Display::of(knot());
  const auto count = static_cast<std::int32_t>(display.polygon_count());
  for (const std::int32_t wrong : {-1, count}) {
    const std::vector<std::int32_t> one = {wrong};
    EXPECT_EQ(display.remove(one).error().code, ErrorCode::kBadIndex);
  }
  std::vector<std::int32_t> all(static_cast<std::size_t>(count));
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(display.remove(all).error().code, ErrorCode::kEmpty);
  EXPECT_TRUE(display.render(small_view()));
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
  // Each of 2 x 2 samples sees the cap, too, and so do exact areas.
  view.anti_aliasing = AntiAliasing::k2;
  EXPECT_EQ(display.render(view)->polygons.at(64, 64), count);
  EXPECT_EQ(display.render(view)->colors.at(32, 32), (Rgb{1, 2, 3}));
  view.anti_aliasing = AntiAliasing::kExactArea;
  EXPECT_EQ(display.render(view)->colors.at(32, 32), (Rgb{1, 2, 3}));
  view.anti_aliasing = AntiAliasing::kNone;
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

TEST(FaceDisplay, CapsAreToldApartBySolids) {
  // Seen from above: one box, both, and the other, from left to right.
  const std::vector<Solid> solids = {Solid::box({0, 0, 0}, {4, 2, 2}),
                                     Solid::box({2, 0, 0}, {6, 2, 2})};
  const Display display = *Display::of(solids);
  View view;
  view.orthographic = true;
  view.ortho_height = 6;
  view.eye = Point{3, 1, 9};
  view.target = Point{3, 1, 0};
  view.up = Point{0, 1, 0};
  view.width_px = view.height_px = 60;
  view.clips = {{{0, 0, -1}, -1}};
  view.caps = CapStyle{{1, 2, 3}, {}};
  const auto count = static_cast<std::int32_t>(display.polygon_count());
  const Picture alike = *display.render(view);
  view.caps_by_solid = true;
  const Picture apart = *display.render(view);
  const std::int32_t kMiddle = 30;
  for (const std::int32_t x : {10, 30, 50})
    EXPECT_EQ(alike.polygons.at(x, kMiddle), count);
  EXPECT_EQ(apart.polygons.at(10, kMiddle), count);
  EXPECT_EQ(apart.polygons.at(30, kMiddle), count + 32);
  EXPECT_EQ(apart.polygons.at(50, kMiddle), count + 16);
  EXPECT_EQ(apart.colors.at(30, kMiddle), (Rgb{1, 2, 3}));
  EXPECT_NE(apart.colors.at(10, kMiddle), apart.colors.at(50, kMiddle));
  EXPECT_EQ((*display.pick(view, 50, kMiddle))->polygon, count + 16);
  // Exact areas and regions, too.
  const Figure figure = *display.figure(view, FigureKey::kPolygon);
  std::vector<std::int32_t> caps;
  for (const SeenRegion& region : figure.regions) {
    if (region.polygon >= count) caps.push_back(region.polygon - count);
  }
  std::sort(caps.begin(), caps.end());
  EXPECT_EQ(caps, (std::vector<std::int32_t>{0, 16, 32}));
  view.anti_aliasing = AntiAliasing::kExactArea;
  EXPECT_EQ(display.render(view)->colors.at(30, kMiddle), (Rgb{1, 2, 3}));
}

TEST(FaceDisplay, BackFacesAreMarked) {
  const Display display = *Display::of(Solid::box({0, 0, 0}, {2, 2, 2}));
  View view = small_view();
  view.eye = Point{1, -9, 2};
  view.target = Point{1, 1, 1};
  view.clips = {{{0, 1, 0}, 1}};  // the inner sides are seen
  const Picture plain = *display.render(view);
  view.back_color = Rgb{200, 0, 100};
  const Picture marked = *display.render(view);
  EXPECT_EQ(marked.polygons.pixels, plain.polygons.pixels);
  std::size_t changed = 0;
  for (std::size_t k = 0; k < plain.colors.pixels.size(); ++k) {
    const Rgb seen = marked.colors.pixels[k], before = plain.colors.pixels[k];
    if (seen == before) continue;
    ++changed;
    const int light = std::max({before.r, before.g, before.b});
    EXPECT_EQ(int{seen.r}, (200 * (255 + light) + 255) / 510);
    EXPECT_EQ(int{seen.g}, 0);
    EXPECT_EQ(int{seen.b}, (100 * (255 + light) + 255) / 510);
  }
  EXPECT_GT(changed, 100u);
  // All is seen from before where nothing is cut, and caps are no back faces.
  view.caps = CapStyle{{1, 2, 3}, {}};
  View whole = view;
  whole.back_color.reset();
  EXPECT_EQ(display.render(view)->colors.pixels,
            display.render(whole)->colors.pixels);
  view.anti_aliasing = AntiAliasing::kExactArea;
  EXPECT_EQ(display.render(view).error().code, ErrorCode::kOutOfRange);
  view.anti_aliasing = AntiAliasing::kNone;
  EXPECT_EQ(display.figure(view).error().code, ErrorCode::kOutOfRange);
  view.clips.clear();
  view.caps.reset();
  EXPECT_EQ(display.scan(view, [](const SeenPolygon&, const PixelSpan&) {})
                .error()
                .code,
            ErrorCode::kOutOfRange);
}

TEST(FaceDisplay, SamplesAreLookedAtAsPixelsAre) {
  const Display display = *Display::of(Solid::box({0, 0, 0}, {2, 2, 2}));
  View view = small_view();
  view.eye = Point{1, -9, 2};
  view.target = Point{1, 1, 1};
  view.clips = {{{0, 1, 0}, 1}};
  for (const std::uint8_t alpha : {kOpaque, std::uint8_t{90}}) {
    for (const bool is_marked : {false, true}) {
      for (const bool is_lazy : {false, true}) {
        view.alpha = alpha;
        view.lazy = is_lazy;
        view.back_color.reset();
        if (is_marked) view.back_color = Rgb{200, 0, 100};
        view.anti_aliasing = AntiAliasing::kNone;
        const Picture one = *display.render(view);
        view.anti_aliasing = AntiAliasing::k4;
        const Picture many = *display.render(view);
        EXPECT_EQ(many.polygons.width_px, 4 * view.width_px);
        // Where all samples and the pixels around see one polygon, it is that
        // of one sample.
        std::size_t same = 0;
        for (std::size_t k = 0; k < one.colors.pixels.size(); ++k)
          same += one.colors.pixels[k] == many.colors.pixels[k];
        EXPECT_GT(same, one.colors.pixels.size() * 3 / 4);
        EXPECT_LT(same, one.colors.pixels.size());
      }
    }
  }
}

TEST(FaceDisplay, PolygonsMayBeTransparent) {
  const Rgb red = {200, 40, 0};
  Mesh box = *Solid::box({0, 0, 0}, {2, 2, 2}).mesh();
  box.colors.assign(box.polygon_count(), red);
  const Display display = *Display::of(box);
  View view = small_view();
  view.eye = Point{1, -9, 1};
  view.target = Point{1, 1, 1};
  view.background = {10, 20, 250};
  const Picture opaque = *display.render(view);
  view.alpha = 100;
  const Picture glass = *display.render(view);
  EXPECT_EQ(glass.polygons.pixels, opaque.polygons.pixels);
  // Two sides lie one behind the other, or four behind each other.
  const auto over = [](Rgb front, Rgb behind) {
    const auto channel = [](int c, int v) {
      return static_cast<std::uint8_t>((2 * (100 * c + 155 * v) + 255) / 510);
    };
    return Rgb{channel(front.r, behind.r), channel(front.g, behind.g),
               channel(front.b, behind.b)};
  };
  const Rgb twice = over(red, over(red, view.background));
  const auto& pixels = glass.colors.pixels;
  EXPECT_GT(std::count(pixels.begin(), pixels.end(), twice), 100);
  // A figure has the same colours, in regions.
  const Figure figure = *display.figure(view);
  EXPECT_TRUE(std::any_of(figure.regions.begin(), figure.regions.end(),
                          [&](const SeenRegion& r) {
                            return r.polygon == kComposed && r.color == twice;
                          }));
  EXPECT_EQ(std::count_if(figure.regions.begin(), figure.regions.end(),
                          [&](const SeenRegion& r) {
                            return r.polygon == kBackground &&
                                   r.color == view.background;
                          }),
            1);
  EXPECT_TRUE(figure.save("glass.svg").has_value());
  // Nothing is seen of what hides nothing.
  view.alpha = 0;
  const Picture none = *display.render(view);
  EXPECT_EQ(std::count(none.colors.pixels.begin(), none.colors.pixels.end(),
                       view.background),
            static_cast<std::ptrdiff_t>(none.colors.pixels.size()));
  // What has no transparency says so.
  view.anti_aliasing = AntiAliasing::kExactArea;
  EXPECT_EQ(display.render(view).error().code, ErrorCode::kOutOfRange);
  view.anti_aliasing = AntiAliasing::kNone;
  view.clips = {{{0, 1, 0}, 1}};
  view.alpha = 100;
  view.clips = {{{0, 1, 0}, 1}};
  view.caps = CapStyle{{1, 2, 3}, {}};
  // The cap, and the side behind it.
  const Rgb cut = over(view.caps->color, over(red, view.background));
  const Picture section = *display.render(view);
  EXPECT_GT(std::count(section.colors.pixels.begin(),
                       section.colors.pixels.end(), cut),
            100);
  EXPECT_GT(
      std::count(section.polygons.pixels.begin(), section.polygons.pixels.end(),
                 static_cast<PolygonId>(display.polygon_count())),
      100);
  const Figure drawn = *display.figure(view);
  EXPECT_TRUE(std::any_of(drawn.regions.begin(), drawn.regions.end(),
                          [&](const SeenRegion& r) { return r.color == cut; }));
}

TEST(FaceDisplay, SeenAreasAreThoseOfTheImage) {
  // A face of a cube that fills a quarter of the image, and half of it hidden.
  View view;
  view.orthographic = true;
  view.ortho_height = 4;
  view.eye = Point{1, 1, 9};
  view.target = Point{1, 1, 0};
  view.width_px = view.height_px = 64;
  const Solid cube = Solid::box({0, 0, 0}, {2, 2, 2});
  const auto seen_of = [&](std::span<const Solid> solids) {
    const Display display = *Display::of(solids);
    const Picture picture = *display.render(view);
    const CutDisplay cut = *CutDisplay::of(display);
    const auto areas = *cut.seen_areas(view);
    std::vector<double> sizes;
    for (const SeenArea& area : areas) {
      EXPECT_EQ(area.solid_angle, 0);
      // Borders are between pixels, so pixels count exactly.
      EXPECT_EQ(area.area_px,
                std::count(picture.polygons.pixels.begin(),
                           picture.polygons.pixels.end(), area.polygon));
      sizes.push_back(area.area_px);
    }
    std::sort(sizes.begin(), sizes.end());
    return sizes;
  };
  EXPECT_EQ(seen_of({{cube}}), (std::vector<double>{1024, 3072}));
  const Solid lid = Solid::box({1, 0, 3}, {2, 2, 4});
  EXPECT_EQ(seen_of({{cube, lid}}), (std::vector<double>{512, 512, 3072}));
  view.clips = {{{0, 0, 1}, 1}};
  const Display display = *Display::of(cube);
  EXPECT_EQ(CutDisplay::of(display)->seen_areas(view).error().code,
            ErrorCode::kOutOfRange);
}

}  // namespace
}  // namespace halfspace
