#include <algorithm>
#include <optional>
#include <vector>

#include "adapters/both.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/ray.hpp"
#include "halfspace/io/ray.hpp"
#include "halfspace/ref/ray.hpp"
#include "laws/law.hpp"
#include "laws/rays.hpp"

/// Laws of rays (S8).
namespace halfspace {
namespace {

using definition::Fraction;
using definition::Integer;

constexpr int kRayViews = 250;

/// The rays of one scene by the reference.
class RefRays {
 public:
  explicit RefRays(const Scene& scene, const BuildOptions& = {})
      : scene_(scene) {}

  std::vector<ExactHit> all(const Ray& ray) const {
    std::vector<ExactHit> hits;
    for (const ref::Hit& hit : ref::all_hits(scene_, ray))
      hits.push_back(exact(hit));
    return hits;
  }
  std::optional<ExactHit> first(const Ray& ray) const {
    const auto hits = ref::all_hits(scene_, ray);
    return hits.empty() ? std::nullopt : std::optional(exact(hits.front()));
  }
  std::vector<double> distances(const Ray& ray) const {
    std::vector<double> result;
    for (const ref::Hit& hit : ref::all_hits(scene_, ray))
      result.push_back(ref::distance_of(hit, ray));
    return result;
  }
  PolygonId pick(const SceneFile& view, std::int32_t i, std::int32_t j) const {
    return ref::pick(scene_, *view.camera, view.options, i, j);
  }
  bool see(const Ray& between) const {
    return ref::see_each_other(scene_, between);
  }

 private:
  static ExactHit exact(const ref::Hit& hit) {
    const auto big = hit.parameter.big();
    return {hit.polygon, Fraction(Integer(numerator(big).str()),
                                  Integer(denominator(big).str()))};
  }

  const Scene& scene_;
};

/// The same by the fast library: all hits through the papers' tree, the others
/// through one with leaves, boxes and free planes.
class FastRays {
 public:
  explicit FastRays(const Scene& scene, const BuildOptions& build = {})
      : scene_(scene),
        papers_tree_(fast::build(scene, build)),
        display_tree_(fast::build_display_tree(scene, display_options())) {}

  std::vector<ExactHit> all(const Ray& ray) const {
    std::vector<ExactHit> hits;
    for (const RayHit& hit : fast::all_hits(scene_, papers_tree_, ray))
      hits.push_back(exact(hit));
    return hits;
  }
  std::optional<ExactHit> first(const Ray& ray) const {
    const auto hit = fast::first_hit(scene_, display_tree_, ray);
    return hit ? std::optional(exact(*hit)) : std::nullopt;
  }
  std::vector<double> distances(const Ray& ray) const {
    std::vector<double> result;
    for (const RayHit& hit : fast::all_hits(scene_, display_tree_, ray))
      result.push_back(io::distance_of(hit, ray, Unit{2, 0}));
    return result;
  }
  PolygonId pick(const SceneFile& view, std::int32_t i, std::int32_t j) const {
    return fast::pick(scene_, display_tree_, *view.camera, view.options, i, j);
  }
  bool see(const Ray& between) const {
    return fast::see_each_other(scene_, display_tree_, between);
  }

 private:
  static ExactHit exact(const RayHit& hit) {
    HALFSPACE_LAW(to_integer(hit.denominator) > 0);
    return {hit.polygon,
            Fraction(to_integer(hit.numerator), to_integer(hit.denominator))};
  }
  static fast::DisplayTreeOptions display_options() {
    fast::DisplayTreeOptions options;
    options.leaf_size = 2;
    options.threads = 1;
    return options;
  }

  const Scene& scene_;
  fast::BspTree papers_tree_;
  fast::BspTree display_tree_;
};

template <class Impl>
class S8Rays : public ::testing::Test {};
using RayImplementations = ::testing::Types<RefRays, FastRays>;
TYPED_TEST_SUITE(S8Rays, RayImplementations);

TYPED_TEST(S8Rays, L1HitsAreThePolygonsThatHoldTheirPoint) {
  std::size_t hits = 0;
  law::for_all_views(
      [&](const SceneFile& view) {
        const TypeParam rays(view.scene);
        const auto facets = facets_of(view.scene);
        for (const Ray& ray : rays_of(view)) {
          const auto found = rays.all(ray);
          HALFSPACE_LAW(found == hits_by_definition(facets, ray));
          hits += found.size();
        }
      },
      kRayViews);
  EXPECT_GT(hits, 1000u);
}

TYPED_TEST(S8Rays, L2HitsAreSortedAndTheFirstIsTheFirst) {
  law::for_all_views(
      [](const SceneFile& view) {
        const TypeParam rays(view.scene);
        for (const Ray& ray : rays_of(view)) {
          const auto hits = rays.all(ray);
          for (std::size_t k = 1; k < hits.size(); ++k) {
            const ExactHit& a = hits[k - 1];
            const ExactHit& b = hits[k];
            HALFSPACE_LAW(
                a.parameter < b.parameter ||
                (a.parameter == b.parameter && a.polygon < b.polygon));
          }
          const auto first = rays.first(ray);
          HALFSPACE_LAW(first.has_value() == !hits.empty());
          if (first) HALFSPACE_LAW(*first == hits.front());
        }
      },
      kRayViews);
}

TYPED_TEST(S8Rays, L3HitsDoNotDependOnTheTree) {
  law::for_all_views(
      [](const SceneFile& view) {
        BuildOptions other;
        other.rule = RootRule::kH4;
        const TypeParam rays(view.scene);
        const TypeParam others(view.scene, other);
        for (const Ray& ray : rays_of(view)) {
          const auto hits = rays.all(ray);
          HALFSPACE_LAW(hits == others.all(ray));
        }
      },
      kRayViews);
}

TYPED_TEST(S8Rays, L4ThePickIsTheItemImage) {
  law::for_all_views(
      [](const SceneFile& view) {
        const TypeParam rays(view.scene);
        const Image image =
            oracle::zbuffer(view.scene, *view.camera, view.options);
        for (std::int32_t j = 0; j < image.items.height_px; ++j) {
          for (std::int32_t i = 0; i < image.items.width_px; ++i)
            HALFSPACE_LAW(rays.pick(view, i, j) == image.items.at(i, j));
        }
      },
      kRayViews);
}

/// Whether `root` is the double nearest to the root of `square`, ties to even.
bool is_nearest_root(double root, const Fraction& square) {
  if (square == 0) return root == 0;
  const auto middle = [&](double other) -> Fraction {
    return (Fraction(root) + Fraction(other)) / 2;
  };
  int exponent = 0;
  const bool is_even =
      static_cast<std::int64_t>(std::ldexp(std::frexp(root, &exponent), 53)) %
          2 ==
      0;
  const Fraction low = middle(std::nextafter(root, 0.0));
  const Fraction high = middle(std::nextafter(root, 1e300));
  return is_even ? low * low <= square && square <= high * high
                 : low * low < square && square < high * high;
}

TYPED_TEST(S8Rays, L5DistancesAreTheNearestDoubles) {
  law::for_all_views(
      [](const SceneFile& view) {
        const TypeParam rays(view.scene);
        const auto facets = facets_of(view.scene);
        for (const Ray& ray : rays_of(view)) {
          const auto hits = hits_by_definition(facets, ray);
          const auto distances = rays.distances(ray);
          HALFSPACE_LAW(hits.size() == distances.size());
          const auto square = [](Int128 value) {
            const Fraction step =
                Fraction(static_cast<double>(value >> 40)) * Fraction(0x1p40) +
                Fraction(static_cast<double>(value & ((Int128{1} << 40) - 1)));
            return Fraction(step * step);
          };
          const Fraction length =
              (square(ray->direction.x) + square(ray->direction.y) +
               square(ray->direction.z)) /
              65536;
          for (std::size_t k = 0; k < hits.size(); ++k) {
            const Fraction& t = hits[k].parameter;
            HALFSPACE_LAW(is_nearest_root(distances[k], t * t * length));
          }
        }
      },
      kRayViews);
}

/// The ray from the other end.
Ray backwards(const Ray& ray, int grid_bits) {
  const LatticeVector& o = ray->origin;
  const LatticeVector& d = ray->direction;
  return *make_ray(
      {{o.x + d.x, o.y + d.y, o.z + d.z}, {-d.x, -d.y, -d.z}, ray->reach},
      grid_bits);
}

TYPED_TEST(S8Rays, L6PointsSeeEachOtherUnlessSomethingIsBetween) {
  std::size_t seeing = 0;
  std::size_t hidden = 0;
  law::for_all_views(
      [&](const SceneFile& view) {
        const TypeParam rays(view.scene);
        const auto facets = facets_of(view.scene);
        for (const Ray& ray : rays_of(view)) {
          const Ray between =
              *make_ray({ray->origin, ray->direction, Reach::kBetween},
                        view.scene.grid_bits());
          const bool see = rays.see(between);
          HALFSPACE_LAW(see == hits_by_definition(facets, between).empty());
          HALFSPACE_LAW(see ==
                        rays.see(backwards(between, view.scene.grid_bits())));
          ++(see ? seeing : hidden);
        }
      },
      kRayViews);
  EXPECT_GT(seeing, 200u);
  EXPECT_GT(hidden, 200u);
}

TYPED_TEST(S8Rays, L7ASegmentBackwardsHasTheSameHits) {
  law::for_all_views(
      [](const SceneFile& view) {
        const TypeParam rays(view.scene);
        for (const Ray& ray : rays_of(view)) {
          const Ray segment =
              *make_ray({ray->origin, ray->direction, Reach::kSegment},
                        view.scene.grid_bits());
          auto hits = rays.all(backwards(segment, view.scene.grid_bits()));
          for (ExactHit& hit : hits) hit.parameter = 1 - hit.parameter;
          std::sort(hits.begin(), hits.end(), [](const auto& a, const auto& b) {
            return a.parameter == b.parameter ? a.polygon < b.polygon
                                              : a.parameter < b.parameter;
          });
          HALFSPACE_LAW(hits == rays.all(segment));
        }
      },
      kRayViews);
}

}  // namespace
}  // namespace halfspace
