#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "generate/random_scenes.hpp"
#include "halfspace/fast/build.hpp"
#include "halfspace/fast/split.hpp"
#include "halfspace/fast/splitter.hpp"
#include "halfspace/fast/traverse.hpp"
#include "halfspace/ref/build.hpp"
#include "halfspace/ref/split.hpp"
#include "halfspace/ref/splitter.hpp"
#include "halfspace/ref/traverse.hpp"

namespace halfspace::agree {
namespace {

constexpr RootRule kRules[] = {
    RootRule::kFirst, RootRule::kRandom, RootRule::kFewestCuts,
    RootRule::kH1,    RootRule::kH2,     RootRule::kH3,
    RootRule::kH4,    RootRule::kH5,     RootRule::kH6};

std::string label(Kind kind, int bits, std::uint64_t seed) {
  return std::string(name_of(kind)) + ", " + std::to_string(bits) +
         " bits, seed " + std::to_string(seed);
}

/// Runs `body(scene, draws)` on scenes of every kind and grid.
template <class Body>
void for_scenes(int polygons, std::uint64_t seeds, Body&& body) {
  for (const Kind kind : kKinds) {
    for (const int bits : kGridBits) {
      for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        SCOPED_TRACE(label(kind, bits, seed));
        Draws draws(seed * 1000 + static_cast<std::uint64_t>(bits));
        const Scene scene = random_scene(kind, bits, polygons, draws);
        body(scene, draws);
        if (::testing::Test::HasFailure()) return;
      }
    }
  }
}

TEST(AgreeTree, EveryRuleGivesTheReferencesTree) {
  fast::FilterStats stats;
  for_scenes(14, 6, [&](const Scene& scene, Draws& draws) {
    for (const RootRule rule : kRules) {
      BuildOptions options;
      options.rule = rule;
      options.candidates = static_cast<std::uint32_t>(draws.from_to(1, 8));
      options.seed = draws.next();
      options.cut_weight = static_cast<std::uint32_t>(draws.from_to(1, 100));
      const ref::BspTree expected = ref::build(scene, options);
      const fast::BspTree tree = fast::build(scene, options, stats);
      ASSERT_EQ(fast::name_of(tree), ref::name_of(expected))
          << "rule " << static_cast<int>(rule);
      ASSERT_EQ(fast::stats(tree), ref::stats(expected));
    }
  });
  // The scenes are made to hurt: each way of deciding must have come up.
  EXPECT_GT(stats.filtered, 10000u);
  EXPECT_GT(stats.exact, 1000u);
  EXPECT_GT(stats.zero, 500u);
  EXPECT_GT(stats.exact - stats.zero, 100u);
}

TEST(AgreeTree, ManyCandidatesAreDrawnAlike) {
  Draws draws(7);
  const Scene scene = random_scene(Kind::kSmall, 26, 45, draws);
  for (const std::uint32_t candidates : {31u, 32u, 33u, 40u, 1000u}) {
    BuildOptions options;
    options.candidates = candidates;
    options.seed = candidates;
    EXPECT_EQ(fast::name_of(fast::build(scene, options)),
              ref::name_of(ref::build(scene, options)))
        << candidates;
  }
}

TEST(AgreeTree, InsertionGivesTheReferencesTree) {
  fast::FilterStats stats;
  for_scenes(12, 6, [&](const Scene& scene, Draws&) {
    ref::BspTree expected;
    fast::BspTree tree;
    const auto planes = ref::planes_of(scene);
    const auto count = static_cast<PolygonId>(scene.polygon_count());
    // Odd ids first, so that lists must be kept in order.
    for (const PolygonId start : {1, 0}) {
      for (PolygonId p = start; p < count; p += 2) {
        ref::insert(expected, ref::whole(scene, p),
                    planes[static_cast<std::size_t>(p)]);
        fast::insert(tree, scene, p, stats);
      }
    }
    ASSERT_EQ(fast::name_of(tree), ref::name_of(expected));
  });
  EXPECT_GT(stats.exact, 100u);
}

TEST(AgreeTree, InsertionIntoABuiltTreeGivesTheReferences) {
  Draws draws(3);
  const Scene scene = random_scene(Kind::kFaces, 26, 20, draws);
  SceneData head = scene.data();
  const std::size_t kept = 12;
  head.first_corner.resize(kept + 1);
  head.corners.resize(head.first_corner.back());
  head.colors.resize(kept);
  const Scene first = *make_scene(head);
  ref::BspTree expected = ref::build(first, {});
  fast::BspTree tree = fast::build(first, {});
  for (std::size_t p = kept; p < scene.polygon_count(); ++p) {
    const auto id = static_cast<PolygonId>(p);
    ref::insert(expected, ref::whole(scene, id), ref::planes_of(scene)[p]);
    fast::insert(tree, scene, id);
  }
  EXPECT_EQ(fast::name_of(tree), ref::name_of(expected));
}

TEST(AgreeTree, PlanesAreTheReferences) {
  Draws draws(5);
  for (const Kind kind : kKinds) {
    const Scene scene = random_scene(kind, 26, 20, draws);
    const auto expected = ref::planes_of(scene);
    const auto planes = fast::planes_of(scene);
    ASSERT_EQ(planes.size(), expected.size());
    for (std::size_t p = 0; p < planes.size(); ++p) {
      // Normals of this grid are exact as doubles, offsets are rounded.
      EXPECT_EQ(planes[p].a, nearest_double(expected[p].a));
      EXPECT_EQ(planes[p].b, nearest_double(expected[p].b));
      EXPECT_EQ(planes[p].c, nearest_double(expected[p].c));
      EXPECT_DOUBLE_EQ(planes[p].d, nearest_double(expected[p].d));
    }
  }
}

TEST(AgreeTree, SidesOfTheEyeAreTheReferences) {
  std::size_t sides[3] = {0, 0, 0};
  for_scenes(12, 2, [&](const Scene& scene, Draws& draws) {
    const auto planes = ref::planes_of(scene);
    const auto count = static_cast<PolygonId>(scene.polygon_count());
    for (const Kind kind : kKinds) {
      const Camera camera = random_camera(kind, scene, 8, 6, draws);
      for (PolygonId p = 0; p < count; ++p) {
        fast::FilterStats stats;
        const Side side = fast::side_of_eye(scene, p, camera, stats);
        ASSERT_EQ(side, ref::side_of_eye(planes[static_cast<std::size_t>(p)],
                                         camera));
        // There is no filter.
        const fast::FilterStats one = {0, 1, side == Side::kOn ? 1u : 0u};
        ASSERT_EQ(stats, one);
        ++sides[static_cast<int>(side) + 1];
      }
    }
  });
  for (const std::size_t count : sides) EXPECT_GT(count, 100u);
}

/// Both orders, up to the fragment at which the display wants no more.
TEST(AgreeTree, AWalkStopsWhereTheDisplayDoes) {
  std::size_t stopped = 0;
  const auto compare = [&](const Scene& scene, const Camera& camera) {
    const ref::BspTree expected = ref::build(scene, {});
    const fast::BspTree tree = fast::build(scene, {});
    for (std::size_t most = 1; most < 9; ++most) {
      std::vector<PolygonId> of_ref[2], of_fast[2];
      const auto show = [&](std::vector<PolygonId>& shown) {
        return [&shown, most](const auto&, const auto& fragment) {
          shown.push_back(fragment.source);
          return shown.size() < most;
        };
      };
      ref::front_to_back(expected, camera, show(of_ref[0]));
      fast::front_to_back(tree, scene, camera, show(of_fast[0]));
      ref::back_to_front(expected, camera, show(of_ref[1]));
      fast::back_to_front(tree, scene, camera, show(of_fast[1]));
      EXPECT_EQ(of_fast[0], of_ref[0]);
      EXPECT_EQ(of_fast[1], of_ref[1]);
      EXPECT_LE(of_ref[1].size(), most);
      if (of_ref[1].size() == most) ++stopped;
    }
  };
  for_scenes(12, 2, [&](const Scene& scene, Draws& draws) {
    compare(scene, random_camera(Kind::kFaces, scene, 8, 6, draws));
  });
  EXPECT_GT(stopped, 100u);
  Draws draws(9);
  const Scene some = random_scene(Kind::kSmall, 26, 4, draws);
  compare(Scene(), random_camera(Kind::kSmall, some, 8, 6, draws));
}

/// Cuts polygons again and again, and compares all answers on the way.
TEST(AgreeTree, SplitRelationAndRootOfFragments) {
  fast::FilterStats stats;
  int spanning = 0;
  for_scenes(8, 8, [&](const Scene& scene, Draws& draws) {
    const auto planes = ref::planes_of(scene);
    const auto count = static_cast<PolygonId>(scene.polygon_count());
    std::vector<ref::Fragment> expected;
    std::vector<fast::Fragment> fragments;
    for (PolygonId p = 0; p < count; ++p) {
      ref::Fragment f = ref::whole(scene, p);
      fast::Fragment g = fast::whole(scene, p);
      for (PolygonId s = 0; s < count; ++s) {
        const ref::Plane& plane = planes[static_cast<std::size_t>(s)];
        const Relation relation = ref::relation(f, plane);
        fast::FilterStats counted;
        ASSERT_EQ(fast::relation(scene, g, s, counted), relation);
        // Each vertex counts once, and is exactly on the plane or is not.
        ASSERT_EQ(counted.filtered + counted.exact, f.vertices.size());
        ASSERT_EQ(std::count_if(f.vertices.begin(), f.vertices.end(),
                                [&](const ref::Point& v) {
                                  return ref::side_of(plane, v) == Side::kOn;
                                }),
                  counted.zero);
        if (relation != Relation::kSpanning) continue;
        ++spanning;
        const auto parts = ref::split(f, plane, s);
        const auto found = fast::split(scene, g, s, stats);
        ASSERT_EQ(found.positive.edges, parts.positive.edges);
        ASSERT_EQ(found.negative.edges, parts.negative.edges);
        const bool up = draws.one_in(2);
        f = up ? parts.positive : parts.negative;
        g = up ? found.positive : found.negative;
        ASSERT_EQ(g.vertices.size(), f.vertices.size());
      }
      ASSERT_EQ(fast::name_of(g), ref::name_of(f));
      expected.push_back(f);
      fragments.push_back(g);
    }
    if (fragments.empty()) return;
    for (const RootRule rule : kRules) {
      BuildOptions options;
      options.rule = rule;
      options.candidates = 3;
      ASSERT_EQ(fast::choose_root(scene, fragments, options, 5, stats),
                ref::choose_root(planes, expected, options, 5));
    }
  });
  EXPECT_GT(spanning, 100);
}

/// A vertex must be within its error of where it is.
TEST(AgreeTree, VerticesAreWithinTheirErrors) {
  int checked = 0;
  for_scenes(10, 6, [&](const Scene& scene, Draws& draws) {
    fast::FilterStats stats;
    const auto planes = ref::planes_of(scene);
    const auto count = static_cast<PolygonId>(scene.polygon_count());
    for (PolygonId p = 0; p < count; ++p) {
      ref::Fragment f = ref::whole(scene, p);
      fast::Fragment g = fast::whole(scene, p);
      for (PolygonId s = 0; s < count; ++s) {
        const ref::Plane& plane = planes[static_cast<std::size_t>(s)];
        if (ref::relation(f, plane) != Relation::kSpanning) continue;
        const bool up = draws.one_in(2);
        const auto parts = ref::split(f, plane, s);
        const auto found = fast::split(scene, g, s, stats);
        f = up ? parts.positive : parts.negative;
        g = up ? found.positive : found.negative;
      }
      for (std::size_t k = 0; k < f.vertices.size(); ++k) {
        // Everything times 2^40, rounded: far finer than any error bound.
        const auto scaled = [](double v) {
          return ref::Rational(static_cast<Int128>(std::ldexp(v, 40)));
        };
        const auto near = [&](const ref::Rational& a, double b) {
          const ref::Rational off =
              a * ref::Rational(Int128{1} << 40) - scaled(b);
          const ref::Rational limit =
              scaled(g.vertices[k].error) + ref::Rational(1);
          return off <= limit && -off <= limit;
        };
        ASSERT_TRUE(near(f.vertices[k].x, g.vertices[k].x));
        ASSERT_TRUE(near(f.vertices[k].y, g.vertices[k].y));
        ASSERT_TRUE(near(f.vertices[k].z, g.vertices[k].z));
        ++checked;
      }
    }
  });
  EXPECT_GT(checked, 1000);
}

}  // namespace
}  // namespace halfspace::agree
