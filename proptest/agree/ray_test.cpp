#include "halfspace/fast/ray.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <thread>
#include <vector>

#include "generate/random_scenes.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/image/lazy_tree.hpp"
#include "halfspace/ref/ray.hpp"
#include "halfspace/ref/render.hpp"

/// Rays of both libraries through the same scenes (S8).
namespace halfspace::agree {
namespace {

ref::Rational to_rational(const RayInteger& words) {
  const bool negative = words.back() >> 63 != 0;
  ref::Rational value = negative ? -1 : 0;
  for (std::size_t k = words.size(); k-- > 0;) {
    value = value * ref::Rational(Int128{1} << 64) +
            ref::Rational(static_cast<Int128>(words[k]));
  }
  return value;
}

void expect_same(const RayHit& found, const ref::Hit& expected) {
  ASSERT_EQ(found.polygon, expected.polygon);
  ASSERT_TRUE(to_rational(found.numerator) ==
              expected.parameter * to_rational(found.denominator));
}

/// A corner, a point of the grid or, one time in three, of the lattice.
LatticeVector random_point(const Scene& scene, Draws& draws) {
  constexpr Int128 kStep = Int128{1} << kLatticeBits;
  const auto& vertices = scene.data().vertices;
  const auto& p = vertices[static_cast<std::size_t>(
      draws.from_to(0, std::ssize(vertices) - 1))];
  LatticeVector at = {kStep * p.x, kStep * p.y, kStep * p.z};
  if (draws.one_in(2)) return at;
  const std::int64_t far = draws.one_in(3) ? 3 : std::int64_t{1} << 20;
  at.x += draws.from_to(-far, far);
  at.y += draws.from_to(-far, far);
  at.z += draws.from_to(-far, far);
  return at;
}

void compare(const Scene& scene, const fast::BspTree& tree, const Ray& ray,
             fast::FilterStats& stats, std::size_t& hits) {
  const auto expected = ref::all_hits(scene, ray);
  const auto found = fast::all_hits(scene, tree, ray);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k)
    expect_same(found[k], expected[k]);
  hits += found.size();
  const auto first = fast::first_hit(scene, tree, ray, stats);
  ASSERT_EQ(first.has_value(), !expected.empty());
  if (first) expect_same(*first, expected.front());
  if (ray->reach == Reach::kBetween) {
    ASSERT_EQ(fast::see_each_other(scene, tree, ray), expected.empty());
  }
}

TEST(AgreeRay, RaysHitTheSameInTheSameOrder) {
  fast::FilterStats stats;
  std::size_t hits = 0;
  for (const Kind kind : kKinds) {
    for (const int bits : kGridBits) {
      for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        SCOPED_TRACE(std::string(name_of(kind)) + ", " + std::to_string(bits) +
                     " bits, seed " + std::to_string(seed));
        Draws draws(seed);
        const Scene scene = random_scene(kind, bits, 60, draws);
        fast::DisplayTreeOptions options;
        options.leaf_size = static_cast<std::size_t>(draws.from_to(1, 9));
        options.threads = 1;
        const auto display = fast::build_display_tree(scene, options);
        const auto plain = fast::build(scene, {});
        for (int k = 0; k < 40; ++k) {
          const LatticeVector p = random_point(scene, draws);
          const LatticeVector q = random_point(scene, draws);
          const auto ray = make_ray({p,
                                     {q.x - p.x, q.y - p.y, q.z - p.z},
                                     static_cast<Reach>(draws.from_to(0, 3))},
                                    bits);
          if (!ray) continue;
          compare(scene, display, *ray, stats, hits);
          compare(scene, plain, *ray, stats, hits);
          if (HasFatalFailure()) return;
        }
      }
    }
  }
  EXPECT_GT(hits, 5000u);
  EXPECT_GT(stats.filtered, 1000u);
  EXPECT_GT(stats.exact, 1000u);
}

TEST(AgreeRay, PicksAreTheItemImage) {
  for (const Kind kind : kKinds) {
    for (const int bits : kGridBits) {
      SCOPED_TRACE(std::string(name_of(kind)) + ", " + std::to_string(bits) +
                   " bits");
      Draws draws(7);
      const Scene scene = random_scene(kind, bits, 40, draws);
      const Camera camera = random_camera(kind, scene, 24, 16, draws);
      const auto tree = fast::build_display_tree(scene);
      for (const bool cull : {false, true}) {
        const ImageOptions options{cull, Shading::kFlat, {}};
        const auto image =
            ref::render(scene, ref::build(scene, {}), camera, options);
        for (std::int32_t j = 0; j < 16; ++j) {
          for (std::int32_t i = 0; i < 24; ++i)
            ASSERT_EQ(fast::pick(scene, tree, camera, options, i, j),
                      image.items.at(i, j));
        }
      }
    }
  }
}

/// The same hits, by parameters that were computed in the same way.
bool is_same(const RayHit& one, const RayHit& other) {
  return one.polygon == other.polygon && one.numerator == other.numerator &&
         one.denominator == other.denominator;
}

/// Whether a lazy tree says of a ray what a whole one says.
bool agree_on(const fast::LazyTree& lazy, const fast::BspTree& whole,
              const Ray& ray) {
  const Scene& scene = lazy.scene();
  const auto all = fast::all_hits(lazy, ray);
  const auto expected = fast::all_hits(scene, whole, ray);
  const auto first = fast::first_hit(lazy, ray);
  return std::equal(all.begin(), all.end(), expected.begin(), expected.end(),
                    is_same) &&
         first.has_value() == !expected.empty() &&
         (!first || is_same(*first, expected.front())) &&
         fast::see_each_other(lazy, ray) == expected.empty();
}

/// Rays between points of the scene.
std::vector<Ray> rays_between(const Scene& scene, Draws& draws, int count) {
  std::vector<Ray> rays;
  for (int k = 0; k < count; ++k) {
    const LatticeVector p = random_point(scene, draws);
    const LatticeVector q = random_point(scene, draws);
    const auto ray =
        make_ray({p, {q.x - p.x, q.y - p.y, q.z - p.z}, Reach::kBetween},
                 scene.grid_bits());
    if (ray) rays.push_back(*ray);
  }
  return rays;
}

TEST(AgreeRay, ThreadsAskOneLazyTree) {
  std::size_t partly = 0;
  for (const Kind kind : kKinds) {
    SCOPED_TRACE(name_of(kind));
    Draws draws(11);
    const Scene scene = random_scene(kind, 26, 90, draws);
    const Camera camera = random_camera(kind, scene, 40, 30, draws);
    const auto whole = fast::build_display_tree(scene);
    const ItemImage image = fast::render(scene, whole, camera, {}).items;
    const std::vector<Ray> rays = rays_between(scene, draws, 60);
    fast::LazyTreeOptions options;
    options.tree.leaf_size = 4;
    options.cell_size = 3;
    options.most_listed = 6;
    options.most_in_cell = 20;
    const fast::LazyTree lazy(scene, options);
    // Each thread begins somewhere else.
    constexpr std::size_t kThreads = 4;
    std::vector<int> wrong(kThreads);
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < kThreads; ++t) {
      threads.emplace_back([&, t] {
        for (std::size_t k = 0; k < rays.size(); ++k) {
          const Ray& ray = rays[(k + t * rays.size() / 4) % rays.size()];
          wrong[t] += agree_on(lazy, whole, ray) ? 0 : 1;
          if (k % 20 == 5 * t)
            wrong[t] += fast::render(lazy, camera, {}).items == image ? 0 : 1;
          const auto i = static_cast<std::int32_t>(k % 40);
          const auto j = static_cast<std::int32_t>((k + 7 * t) % 30);
          wrong[t] +=
              fast::pick(lazy, camera, {}, i, j) == image.at(i, j) ? 0 : 1;
        }
      });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(wrong, std::vector<int>(kThreads));
    partly += lazy.stats().cells > 1 ? 1u : 0u;
  }
  EXPECT_GT(partly, 3u);
}

}  // namespace
}  // namespace halfspace::agree
