#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "adapters/both.hpp"
#include "halfspace/fast/image/lazy_tree.hpp"
#include "halfspace/ref/oracle/zbuffer.hpp"
#include "halfspace/ref/ray.hpp"
#include "laws/frames/clipped_views.hpp"
#include "laws/frames/lazy_trees.hpp"
#include "laws/law.hpp"
#include "laws/rays.hpp"

/// The law of rays through lazy trees (S8, S3.12).
namespace halfspace {
namespace {

using definition::Fraction;
using definition::Integer;

constexpr int kLazyRayViews = 300;

/// The reference asks every polygon of the scene that is there.
class RefAsked {
 public:
  static constexpr std::size_t kKinds = 1;  ///< it has no tree
  RefAsked(const Scene& scene, const LazyKind&) : scene_(&scene) {}

  void move_to(const Scene& scene, const std::vector<PolygonId>&) {
    scene_ = &scene;
  }
  std::vector<ExactHit> all(const Ray& ray) const {
    std::vector<ExactHit> hits;
    for (const ref::Hit& hit : ref::all_hits(*scene_, ray)) {
      const auto big = hit.parameter.big();
      hits.push_back({hit.polygon, Fraction(Integer(numerator(big).str()),
                                            Integer(denominator(big).str()))});
    }
    return hits;
  }
  std::optional<ExactHit> first(const Ray& ray) const {
    const auto hits = all(ray);
    return hits.empty() ? std::nullopt : std::optional(hits.front());
  }
  bool see(const Ray& between) const {
    return ref::see_each_other(*scene_, between);
  }
  PolygonId pick(const Camera& camera, const ImageOptions& options,
                 std::int32_t i, std::int32_t j) const {
    return ref::pick(*scene_, camera, options, i, j);
  }
  ItemImage show(const Camera& camera, const ImageOptions& options) const {
    return ref::render(*scene_, ref::build(*scene_, {}), camera, options).items;
  }
  std::size_t built() const { return 0; }

 private:
  const Scene* scene_;
};

class FastAsked {
 public:
  static constexpr std::size_t kKinds = std::size(kLazyKinds);
  FastAsked(const Scene& scene, const LazyKind& kind)
      : tree_(open_lazy(scene, kind)) {
    how_.threads = kind.threads;
    how_.simd = kind.simd;
  }

  void move_to(const Scene& scene, const std::vector<PolygonId>& changed) {
    tree_.move_to(scene, changed);
  }
  std::vector<ExactHit> all(const Ray& ray) const {
    std::vector<ExactHit> hits;
    for (const RayHit& hit : fast::all_hits(tree_, ray))
      hits.push_back(exact(hit));
    return hits;
  }
  std::optional<ExactHit> first(const Ray& ray) const {
    const auto hit = fast::first_hit(tree_, ray);
    return hit ? std::optional(exact(*hit)) : std::nullopt;
  }
  bool see(const Ray& between) const {
    return fast::see_each_other(tree_, between);
  }
  PolygonId pick(const Camera& camera, const ImageOptions& options,
                 std::int32_t i, std::int32_t j) const {
    return fast::pick(tree_, camera, options, i, j);
  }
  ItemImage show(const Camera& camera, const ImageOptions& options) const {
    return fast::render(tree_, camera, options, how_).items;
  }
  std::size_t built() const { return tree_.stats().cells_built; }

 private:
  static ExactHit exact(const RayHit& hit) {
    return {hit.polygon,
            Fraction(to_integer(hit.numerator), to_integer(hit.denominator))};
  }

  fast::LazyTree tree_;
  fast::RenderOptions how_;
};

/// A scene, and what is to be found in it.
struct Expected {
  const Scene& scene;
  std::vector<Ray> rays;
  std::vector<std::vector<ExactHit>> hits;  ///< of each of them
  Image image;
};

Expected expected_of(const Scene& scene, const SceneFile& view,
                     const ImageOptions& options, std::uint64_t seed) {
  SceneFile now = view;
  now.scene = scene;
  std::vector<Ray> rays = rays_of(now);
  // Some, for each of which all questions are asked in all kinds of trees.
  constexpr std::size_t kMost = 8;
  for (std::size_t k = 0; k < std::min(kMost, rays.size()); ++k)
    std::swap(rays[k], rays[k + mix(seed + k) % (rays.size() - k)]);
  if (rays.size() > kMost)
    rays.erase(rays.begin() + static_cast<std::ptrdiff_t>(kMost), rays.end());
  const auto facets = facets_of(scene);
  std::vector<std::vector<ExactHit>> hits;
  for (const Ray& ray : rays) hits.push_back(hits_by_definition(facets, ray));
  return {scene, std::move(rays), std::move(hits),
          oracle::zbuffer(scene, *view.camera, options)};
}

/// Asks one question.
template <class Asked>
void expect_answer(const Asked& asked, const Expected& expected,
                   const Camera& camera, const ImageOptions& options,
                   std::uint64_t question) {
  const std::uint64_t which = mix(question);
  if (which % 5 == 0) {
    if (which / 5 % 4 == 0) {
      HALFSPACE_LAW(asked.show(camera, options) == expected.image.items);
      return;
    }
    const auto i = static_cast<std::int32_t>(
        mix(which) % static_cast<std::uint64_t>(camera->width_px));
    const auto j = static_cast<std::int32_t>(
        mix(which + 1) % static_cast<std::uint64_t>(camera->height_px));
    HALFSPACE_LAW(asked.pick(camera, options, i, j) ==
                  expected.image.items.at(i, j));
    return;
  }
  if (expected.rays.empty()) return;
  const std::size_t r = which / 5 % expected.rays.size();
  const Ray& ray = expected.rays[r];
  const std::vector<ExactHit>& hits = expected.hits[r];
  if (ray->reach == Reach::kBetween)
    HALFSPACE_LAW(asked.see(ray) == hits.empty());
  if (which % 5 == 1) {
    HALFSPACE_LAW(asked.all(ray) == hits);
    return;
  }
  const auto first = asked.first(ray);
  HALFSPACE_LAW(first.has_value() == !hits.empty());
  if (first) HALFSPACE_LAW(*first == hits.front());
}

template <class Asked>
class S8Lazy : public ::testing::Test {};
using LazyRayImplementations = ::testing::Types<RefAsked, FastAsked>;
TYPED_TEST_SUITE(S8Lazy, LazyRayImplementations);

TYPED_TEST(S8Lazy, L8RaysThroughALazyTreeHitWhatTheyHitThroughAny) {
  std::size_t moves = 0;
  std::size_t hits = 0;
  std::size_t fewer = 0;
  law::for_all_views(
      [&](const SceneFile& original) {
        if (original.scene.polygon_count() == 0) return;
        const std::uint64_t seed = seed_of(original);
        const SceneFile view = seed % 3 == 0 ? clipped(original) : original;
        ImageOptions options = view.options;
        options.caps = std::nullopt;
        std::vector<Scene> scenes = {*apart(view.scene)};
        std::vector<std::vector<PolygonId>> changed = {{}};
        if (auto next = moved(scenes.front(), seed)) {
          scenes.push_back(std::move(next->first));
          changed.push_back(std::move(next->second));
          ++moves;
        }
        std::vector<Expected> expected;
        for (std::size_t k = 0; k < scenes.size(); ++k)
          expected.push_back(expected_of(scenes[k], view, options, seed + k));
        for (std::size_t n = 0; n < TypeParam::kKinds; ++n) {
          const LazyKind& kind = kLazyKinds[n];
          TypeParam asked(scenes.front(), kind);
          for (std::size_t k = 0; k < scenes.size(); ++k) {
            if (k > 0) asked.move_to(scenes[k], changed[k]);
            for (std::uint64_t q = 0; q < 16; ++q) {
              const std::uint64_t question =
                  mix(seed + 100 * k + kind.leaf_size) + q;
              expect_answer(asked, expected[k], *view.camera, options,
                            question);
              // Asked again, nothing more is built.
              const std::size_t built = asked.built();
              expect_answer(asked, expected[k], *view.camera, options,
                            question);
              HALFSPACE_LAW(asked.built() == built);
            }
          }
        }
        // A ray goes as far as its first hit, and builds no more.
        for (const Ray& ray : expected.front().rays) {
          const TypeParam one(scenes.front(), kLazyKinds[0]);
          const TypeParam all(scenes.front(), kLazyKinds[0]);
          (void)one.first(ray);
          hits += all.all(ray).size();
          HALFSPACE_LAW(one.built() <= all.built());
          fewer += one.built() < all.built() ? 1u : 0u;
        }
      },
      kLazyRayViews);
  EXPECT_GT(moves, 150u);
  EXPECT_GT(hits, 1000u);
  if constexpr (std::is_same_v<TypeParam, FastAsked>) {
    EXPECT_GT(fewer, 200u) << "rays that build less for their first hit";
  }
}

}  // namespace
}  // namespace halfspace
