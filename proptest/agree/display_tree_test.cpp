#include "halfspace/fast/display_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "generate/clip_planes.hpp"
#include "generate/random_scenes.hpp"
#include "halfspace/fast/image/lazy_tree.hpp"
#include "halfspace/fast/render.hpp"
#include "halfspace/ref/split.hpp"

/// The display tree is followed from its root with the reference's fragments,
/// which its planes cut anew: what arrives at each node must be what it holds.
/// So every polygon is there, its fragments partition it, and each is exactly
/// on the side of every splitter above it where it should be.
namespace halfspace::agree {
namespace {

using Fragments = std::vector<ref::Fragment>;

/// The plane of a node.
ref::Plane plane_of(const fast::BspTree& tree,
                    const std::vector<ref::Plane>& planes,
                    fast::PlaneId plane) {
  const auto p = static_cast<std::size_t>(plane);
  if (p < planes.size()) return planes[p];
  const fast::FreePlane& free = tree.free_planes.at(p - planes.size());
  ref::Plane result;
  (free.axis == 0   ? result.a
   : free.axis == 1 ? result.b
                    : result.c) = ref::Rational(1);
  result.d = -ref::Rational(free.coordinate);
  return result;
}

/// A float as a fraction.
ref::Rational to_rational(float value) {
  int exponent = 0;
  const float fraction = std::frexp(value, &exponent);
  const auto digits = static_cast<std::int64_t>(std::ldexp(fraction, 24));
  exponent -= 24;
  if (exponent >= 0) return ref::Rational(Int128{digits} << exponent);
  // The least floats are there, too: of boxes that end at 0.
  ref::Rational result(digits);
  for (; exponent < 0; exponent += std::min(-exponent, 100)) {
    result = result / ref::Rational(Int128{1} << std::min(-exponent, 100));
  }
  return result;
}

bool holds(const fast::Box& box, const ref::Point& p) {
  const ref::Rational* at[] = {&p.x, &p.y, &p.z};
  for (std::size_t a = 0; a < 3; ++a) {
    if (*at[a] < to_rational(box.low[a])) return false;
    if (to_rational(box.high[a]) < *at[a]) return false;
  }
  return true;
}

/// Compares what the node holds, in order and by names.
void expect_held(const fast::BspTree& tree, const fast::Node& node,
                 const Fragments& expected,
                 const std::vector<ref::Plane>& planes) {
  std::int32_t f = node.first_fragment;
  for (const ref::Fragment& fragment : expected) {
    ASSERT_NE(f, fast::kNoFragment);
    const fast::TreeFragment& found =
        tree.fragments.at(static_cast<std::size_t>(f));
    fast::Fragment names{found.source, {}, {}};
    for (std::uint32_t k = 0; k < found.corner_count; ++k) {
      const std::int32_t edge = tree.corners.at(found.first_corner + k).edge;
      names.edges.push_back(
          edge >= 0 ? EdgeName{EdgeName::Kind::kSource, edge}
                    : EdgeName{EdgeName::Kind::kSplitter, -1 - edge});
    }
    ASSERT_EQ(fast::name_of(names), ref::name_of(fragment));
    if (node.splitter != fast::kNoPlane) {
      const ref::Plane p = plane_of(tree, planes, node.splitter);
      const ref::Plane& q = planes[static_cast<std::size_t>(found.source)];
      const ref::Rational along = p.a * q.a + p.b * q.b + p.c * q.c;
      ASSERT_EQ(found.flipped != 0, along < ref::Rational(0));
    }
    f = found.next;
  }
  ASSERT_EQ(f, fast::kNoFragment);
}

/// What came up while a tree was followed.
struct Seen {
  std::size_t leaves = 0;
  std::size_t free_planes = 0;
  std::size_t own_planes = 0;
  std::size_t coincident = 0;
  std::size_t cuts = 0;
};

void follow(const Scene& scene, const fast::BspTree& tree, Seen& seen) {
  const auto planes = ref::planes_of(scene);
  std::vector<std::pair<NodeId, Fragments>> ahead;
  Fragments all;
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    all.push_back(ref::whole(scene, static_cast<PolygonId>(p)));
  }
  ASSERT_EQ(tree.boxes.size(), tree.nodes.size());
  ASSERT_EQ(all.empty(), tree.nodes.empty());
  if (!all.empty()) ahead.emplace_back(0, std::move(all));
  std::size_t visited = 0;
  while (!ahead.empty()) {
    const auto [id, list] = std::move(ahead.back());
    ahead.pop_back();
    ASSERT_NE(id, kNoNode) << "fragments without a place";
    ASSERT_FALSE(list.empty()) << "a node without fragments";
    ++visited;
    const fast::Node& node = tree.nodes.at(static_cast<std::size_t>(id));
    for (const ref::Fragment& fragment : list) {
      for (const ref::Point& p : fragment.vertices) {
        ASSERT_TRUE(holds(tree.boxes[static_cast<std::size_t>(id)], p));
      }
    }
    if (node.splitter == fast::kNoPlane) {
      ++seen.leaves;
      ASSERT_EQ(node.positive, kNoNode);
      ASSERT_EQ(node.negative, kNoNode);
      Fragments held = list;
      std::stable_sort(held.begin(), held.end(),
                       [](const auto& p, const auto& q) {
                         return std::min<std::size_t>(p.vertices.size(), 5) <
                                std::min<std::size_t>(q.vertices.size(), 5);
                       });
      expect_held(tree, node, held, planes);
      if (::testing::Test::HasFatalFailure()) return;
      continue;
    }
    const ref::Plane plane = plane_of(tree, planes, node.splitter);
    const bool is_own =
        static_cast<std::size_t>(node.splitter) < scene.polygon_count();
    ++(is_own ? seen.own_planes : seen.free_planes);
    Fragments positive;
    Fragments negative;
    Fragments coincident;
    for (const ref::Fragment& fragment : list) {
      switch (ref::relation(fragment, plane)) {
        case Relation::kPositive:
          positive.push_back(fragment);
          break;
        case Relation::kNegative:
          negative.push_back(fragment);
          break;
        case Relation::kCoincident:
          coincident.push_back(fragment);
          break;
        case Relation::kSpanning: {
          auto parts = ref::split(fragment, plane, node.splitter);
          positive.push_back(std::move(parts.positive));
          negative.push_back(std::move(parts.negative));
          ++seen.cuts;
          break;
        }
      }
    }
    seen.coincident += coincident.size();
    expect_held(tree, node, coincident, planes);
    if (::testing::Test::HasFatalFailure()) return;
    ASSERT_EQ(positive.empty(), node.positive == kNoNode);
    ASSERT_EQ(negative.empty(), node.negative == kNoNode);
    if (!negative.empty()) {
      ahead.emplace_back(node.negative, std::move(negative));
    }
    if (!positive.empty()) {
      ahead.emplace_back(node.positive, std::move(positive));
    }
  }
  ASSERT_EQ(visited, tree.nodes.size());
}

TEST(AgreeDisplayTree, FragmentsPartitionThePolygonsExactly) {
  Seen seen;
  Seen divided;
  for (const Kind kind : kKinds) {
    for (const int bits : kGridBits) {
      for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        SCOPED_TRACE(std::string(name_of(kind)) + ", " + std::to_string(bits) +
                     " bits, seed " + std::to_string(seed));
        Draws draws(seed * 1000 + static_cast<std::uint64_t>(bits));
        const int polygons = seed % 2 == 0 ? 14 : 40;
        const Scene scene = random_scene(kind, bits, polygons, draws);
        fast::DisplayTreeOptions options;
        options.leaf_size = static_cast<std::size_t>(draws.from_to(1, 6));
        options.own_planes = static_cast<std::size_t>(draws.from_to(0, 8));
        options.cut_weight = draws.one_in(2) ? 0.0 : 2.0;
        fast::BspTree tree = fast::build_display_tree(scene, options);
        follow(scene, tree, seen);
        if (HasFatalFailure()) return;
        fast::divide_leaves(tree, scene);
        follow(scene, tree, divided);
        if (HasFatalFailure()) return;
      }
    }
  }
  // Each way of dividing must have come up.
  EXPECT_GT(seen.leaves, 500u);
  EXPECT_GT(seen.free_planes, 500u);
  EXPECT_GT(seen.own_planes, 100u);
  EXPECT_GT(seen.coincident, 100u);
  EXPECT_GT(seen.cuts, 500u);
  EXPECT_EQ(divided.leaves, 0u);
  EXPECT_EQ(divided.free_planes, seen.free_planes);
  EXPECT_GT(divided.cuts, seen.cuts);
}

/// Lists so long that they are divided into jobs, whose trees are put together.
TEST(AgreeDisplayTree, PiecesOfALargeSceneFitTogether) {
  Draws draws(5);
  SceneData data;
  const int count = 20000;
  for (int t = 0; t < count; ++t) {
    const std::int64_t at[3] = {draws.from_to(-9999, 9999),
                                draws.from_to(-9999, 9999),
                                draws.from_to(-9999, 9999)};
    for (int k = 0; k < 3; ++k) {
      data.corners.push_back(static_cast<VertexId>(data.vertices.size()));
      // The first two corners differ in x, the third is off their line in y.
      data.vertices.push_back({at[0] + (k == 1 ? 400 : draws.from_to(0, 300)),
                               at[1] + (k == 2 ? 500 : draws.from_to(0, 9)),
                               at[2] + draws.from_to(0, 400)});
    }
    data.first_corner.push_back(
        static_cast<std::uint32_t>(data.corners.size()));
    data.colors.push_back({});
  }
  const Result<Scene> scene = make_scene(std::move(data));
  ASSERT_TRUE(scene.has_value());
  fast::DisplayTreeOptions options;
  options.threads = 2;
  Seen seen;
  follow(*scene, fast::build_display_tree(*scene, options), seen);
  EXPECT_GT(seen.cuts, 1000u);
}

/// The same images as the eager tree's, whatever was displayed before.
TEST(AgreeDisplayTree, LazyTreesGiveTheImagesOfEagerOnes) {
  std::size_t partly = 0;
  std::size_t cut = 0;
  std::size_t again = 0;
  for (const Kind kind : kKinds) {
    for (const int bits : kGridBits) {
      for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        SCOPED_TRACE(std::string(name_of(kind)) + ", " + std::to_string(bits) +
                     " bits, seed " + std::to_string(seed));
        Draws draws(seed * 1000 + static_cast<std::uint64_t>(bits));
        const Scene scene = random_scene(
            kind, bits, static_cast<int>(draws.from_to(1, 90)), draws, true);
        fast::LazyTreeOptions options;
        options.tree.leaf_size = static_cast<std::size_t>(draws.from_to(1, 20));
        options.cell_size = static_cast<std::size_t>(draws.from_to(1, 9));
        options.most_listed = 4;
        options.most_in_cell = static_cast<std::size_t>(draws.from_to(1, 40));
        const fast::BspTree eager = fast::build_display_tree(scene);
        options.tree.threads = 1;
        const fast::LazyTree one(scene, options);
        options.tree.threads = 3;
        const fast::LazyTree three(scene, options);
        const fast::LazyTreeStats opened = one.stats();
        ASSERT_TRUE(opened == three.stats());
        ASSERT_EQ(opened.polygons_built, 0u);
        for (int view = 0; view < 5; ++view) {
          const Camera camera = random_camera(kind, scene, 61, 43, draws);
          ImageOptions image;
          image.cull = draws.one_in(3);
          image.shading = draws.one_in(2) ? Shading::kGouraud : Shading::kFlat;
          image.clips = draws.one_in(3)
                            ? generate::clip_planes(scene, draws.next(), 2)
                            : std::vector<ClipPlane>();
          fast::RenderOptions how;
          const auto expected = fast::render(scene, eager, camera, image, how);
          const auto expect_same = [&](const fast::Rendering& made) {
            ASSERT_TRUE(made.items == expected.items);
            ASSERT_TRUE(made.colors == expected.colors);
            ASSERT_EQ(made.pixels_painted, expected.pixels_painted);
          };
          expect_same(fast::render(one, camera, image, how));
          how.threads = 3;
          how.simd = fast::SimdLevel::kPortable;
          expect_same(fast::render(three, camera, image, how));
          if (HasFatalFailure()) return;
          partly += one.stats().cells_built < one.stats().cells ? 1u : 0u;
        }
        const fast::LazyTreeStats built = one.stats();
        cut += built.fragments > built.polygons_built ? 1u : 0u;
        again += built.cells > opened.cells ? 1u : 0u;
      }
    }
  }
  EXPECT_GT(partly, 70u);
  EXPECT_GT(cut, 50u);
  EXPECT_GT(again, 10u) << "cells that were divided again";
}

}  // namespace
}  // namespace halfspace::agree
