#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "halfspace/ref/oracle/zbuffer.hpp"
#include "peers/peer.hpp"
#include "scenes.hpp"
#include "timing.hpp"
#include "views.hpp"
#include "workloads.hpp"

namespace halfspace::bench {
namespace {

constexpr std::int32_t kSizePx = 120;

/// A picture in floats may differ from the exact one in pixels that an edge
/// nearly touches: at this size one in a hundred is plenty.
constexpr double kShareLeast = 0.99;

std::vector<PolygonId> exact_items(const Scene& scene, const Camera& camera) {
  return ref::zbuffer(scene, camera, {}).items.pixels;
}

TEST(BenchScenes, ASeedNamesAScene) {
  const RandomTriangles recipe = {100, 50, false, 7};
  RandomTriangles other = recipe;
  other.seed = 8;
  EXPECT_EQ(random_triangles(recipe), random_triangles(recipe));
  EXPECT_NE(random_triangles(recipe), random_triangles(other));
  for (const Surface surface : {Surface::kSphere, Surface::kTorus,
                                Surface::kKleinBottle, Surface::kRock}) {
    EXPECT_EQ(surface_mesh(surface, 8, 12, 7), surface_mesh(surface, 8, 12, 7));
  }
  EXPECT_NE(surface_mesh(Surface::kRock, 8, 12, 7),
            surface_mesh(Surface::kRock, 8, 12, 8));
}

TEST(BenchScenes, RandomTrianglesStayNearTheirCentre) {
  const Scene scene = random_triangles({1000, 200, false, 3});
  ASSERT_EQ(scene.polygon_count(), 200u);
  for (PolygonId id = 0; id < 200; ++id) {
    const auto corners = scene.corners(id);
    for (const VertexId corner : corners) {
      const GridPoint& p = scene.point(corner);
      EXPECT_LE(std::abs(p.x - scene.point(corners[0]).x),
                1000 * kStepsPerUnit);
      EXPECT_LE(std::abs(p.z), 1000 * kStepsPerUnit);
    }
  }
}

TEST(BenchScenes, ParallelTrianglesAreParallel) {
  const Scene scene = random_triangles({500, 100, true, 3});
  for (PolygonId id = 0; id < 100; ++id) {
    const auto corners = scene.corners(id);
    EXPECT_EQ(scene.point(corners[0]).z, scene.point(corners[1]).z);
    EXPECT_EQ(scene.point(corners[0]).z, scene.point(corners[2]).z);
  }
}

/// How often each pair of neighbouring vertices is an edge, one way minus the
/// other way.
long open_edges(const Scene& scene) {
  std::vector<std::pair<VertexId, VertexId>> edges;
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    const auto corners = scene.corners(static_cast<PolygonId>(p));
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const VertexId a = corners[k], b = corners[(k + 1) % corners.size()];
      edges.emplace_back(std::min(a, b), std::max(a, b));
    }
  }
  std::sort(edges.begin(), edges.end());
  long open = 0;
  for (std::size_t k = 0; k < edges.size();) {
    const std::size_t start = k;
    while (k < edges.size() && edges[k] == edges[start]) ++k;
    open += k - start == 2 ? 0 : 1;
  }
  return open;
}

TEST(BenchScenes, SurfacesAreClosed) {
  for (const Surface surface : {Surface::kSphere, Surface::kTorus,
                                Surface::kKleinBottle, Surface::kRock}) {
    EXPECT_EQ(open_edges(surface_mesh(surface, 9, 14, 1)), 0);
  }
  EXPECT_EQ(surface_mesh(Surface::kKleinBottle, 15, 15, 1).polygon_count(),
            450u);
  EXPECT_EQ(surface_mesh(Surface::kSphere, 9, 14, 1).polygon_count(),
            2u * 14 * 8);
}

TEST(BenchWorkloads, TheirNamesDiffer) {
  const std::vector<Workload> all = workloads(1);
  std::vector<std::string> names;
  for (const Workload& workload : all) names.push_back(workload.name);
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
  EXPECT_EQ(names.size(), 11u);
}

TEST(BenchViews, EveryViewSeesTheScene) {
  const Scene scene = random_triangles({500, 60, false, 5});
  for (std::size_t k = 0; k < kViews.size(); ++k) {
    EXPECT_EQ(view_named(kViewNames[k]), kViews[k]);
    for (const Camera& camera :
         {universe_camera(kViews[k], 32), scene_camera(scene, kViews[k], 32)}) {
      const auto items = exact_items(scene, camera);
      const auto seen = std::count_if(items.begin(), items.end(),
                                      [](PolygonId id) { return id >= 0; });
      EXPECT_GT(seen, 32 * 32 / 16) << kViewNames[k];
      EXPECT_LT(seen, 32 * 32) << kViewNames[k];
    }
  }
  EXPECT_FALSE(view_named("nowhere").has_value());
}

TEST(BenchScenes, FloatsOnEveryGridShowTheSameScene) {
  const Scene scene = random_triangles({500, 60, false, 5});
  const auto items = exact_items(scene, universe_camera(View::kAskew, kSizePx));
  for (const int bits : kGridBits) {
    const Scene floats = in_floats(scene, bits);
    EXPECT_EQ(floats.grid_bits(), bits);
    ASSERT_EQ(floats.polygon_count(), scene.polygon_count());
    EXPECT_EQ(floats.data().corner_colors, scene.data().corner_colors);
    std::size_t finer = 0;
    for (const GridPoint& p : floats.data().vertices) {
      const double value =
          std::ldexp(static_cast<double>(p.x), floats.unit().exponent);
      finer += value != static_cast<float>(value) ? 1 : 0;
    }
    // Only what is next to zero is finer than the finest grid.
    if (bits == 54) {
      EXPECT_EQ(finer, 0u);
    }
    const Camera camera = universe_camera(floats, View::kAskew, kSizePx);
    EXPECT_GT(share_equal(exact_items(floats, camera), items), kShareLeast);
  }
}

TEST(BenchPeers, TheZBufferDrawsTheExactImage) {
  const Scene scene = random_triangles({500, 60, false, 5});
  for (const View view : kViews) {
    const Camera camera = universe_camera(view, kSizePx);
    const Soup soup = make_soup(scene, camera);
    const auto peer = make_z_buffer(soup, order_of(soup, Order::kInput));
    EXPECT_GT(share_equal(items_of(*peer), exact_items(scene, camera)),
              kShareLeast);
  }
}

TEST(BenchPeers, TheSpanPainterDrawsTheExactImageOfParallelTriangles) {
  const Scene scene = random_triangles({500, 60, true, 5});
  const Camera camera = universe_camera(View::kFront, kSizePx);
  const Soup soup = make_soup(scene, camera);
  const auto exact = exact_items(scene, camera);
  const auto good =
      make_span_painter(soup, order_of(soup, Order::kBackToFront));
  EXPECT_GT(share_equal(items_of(*good), exact), kShareLeast);
  const auto bad = make_span_painter(soup, order_of(soup, Order::kFrontToBack));
  EXPECT_LT(share_equal(items_of(*bad), exact), kShareLeast);
}

TEST(BenchPeers, SmoothPicturesHaveTheCornersColours) {
  const Scene scene = surface_mesh(Surface::kSphere, 20, 30, 1);
  const Camera camera = scene_camera(scene, View::kFront, kSizePx);
  const Soup soup = make_soup(scene, camera);
  const auto painter =
      make_span_painter(soup, order_of(soup, Order::kBackToFront));
  const auto z_buffer = make_z_buffer(soup, order_of(soup, Order::kInput));
  painter->draw(Look::kSmooth);
  z_buffer->draw(Look::kSmooth);
  const std::vector<Pixel> a = painter->pixels(), b = z_buffer->pixels();
  std::size_t close = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    int apart = 0;
    for (const int shift : {0, 8, 16}) {
      apart = std::max(apart, std::abs(static_cast<int>(a[k] >> shift & 255) -
                                       static_cast<int>(b[k] >> shift & 255)));
    }
    close += apart <= 2 ? 1u : 0u;
  }
  EXPECT_GT(close * 100, a.size() * 98);
  EXPECT_LT(overdraw_of(soup), 2);
  EXPECT_GT(overdraw_of(soup), 0.5);
}

TEST(BenchTiming, TimeIsSpentAndCounted) {
  const Timing timing = processor_time(
      [] {
        const double until = process_ms() + 5;
        while (process_ms() < until) {
        }
      },
      {3, 1000});
  EXPECT_EQ(timing.count, 3);
  EXPECT_GE(timing.least, 5);
  EXPECT_LE(timing.least, timing.median);
  EXPECT_LE(timing.median, timing.greatest);
}

}  // namespace
}  // namespace halfspace::bench
