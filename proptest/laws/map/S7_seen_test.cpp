#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "adapters/both.hpp"
#include "adapters/scenes.hpp"
#include "definition/definition.hpp"
#include "halfspace/fast/image/seen_areas.hpp"
#include "halfspace/panorama.hpp"
#include "halfspace/ref/seen_areas.hpp"
#include "laws/law.hpp"

/// Laws of seen areas (S7.7).
namespace halfspace {
namespace {

using definition::Fraction;
using definition::Integer;

constexpr int kSeenViews = 150;

/// What an implementation says is seen of each key: the exact area as text,
/// the double next to it, the solid angle.
struct SeenNumbers {
  std::string area;
  double nearest = 0;
  double solid_angle = 0;
};
using SeenByKey = std::map<std::int32_t, SeenNumbers>;

struct RefSeen {
  static SeenByKey of(const Scene& scene, const Camera& camera,
                      const MapOptions& options) {
    SeenByKey seen;
    for (const ref::SeenArea& area :
         ref::seen_areas(ref::visible_map(scene, camera, options), camera)) {
      const auto big = area.area_px.big();
      const Fraction exact(Integer(numerator(big).str()),
                           Integer(denominator(big).str()));
      seen[area.key] = {exact.str(), exact.convert_to<double>(),
                        area.solid_angle};
    }
    return seen;
  }
};

struct FastSeen {
  static SeenByKey of(const Scene& scene, const Camera& camera,
                      const MapOptions& options) {
    const auto map =
        fast::visible_map(scene, fast::build(scene, {}), camera, options);
    HALFSPACE_LAW(map.has_value());
    SeenByKey seen;
    for (const fast::SeenArea& area : fast::seen_areas(*map, camera)) {
      seen[area.key] = {fast::exact_seen_area(*map, area.key), area.area_px,
                        area.solid_angle};
    }
    return seen;
  }
};

template <class Impl>
class S7Seen : public ::testing::Test {};
using SeenImplementations = ::testing::Types<RefSeen, FastSeen>;
TYPED_TEST_SUITE(S7Seen, SeenImplementations);

/// Few enough polygons that all lines may meet all.
Scene few_of(const Scene& scene) {
  std::vector<PolygonId> ids = ids_of(scene);
  if (ids.size() > 3) ids.resize(3);
  return chosen(scene, ids);
}

/// The eye of a view, or where an eye at infinity has its image.
LatticeVector eye_of(const SceneFile& view) {
  const CameraData& camera = view.camera->data();
  return camera.perspective ? camera.eye : camera.s0;
}

std::array<Camera, 6> cameras_of(const SceneFile& view) {
  const auto cameras = panorama(eye_of(view), view.scene.grid_bits());
  HALFSPACE_LAW(cameras.has_value());
  return *cameras;
}

template <class Impl>
std::map<std::int32_t, double> seen_all_round(const SceneFile& view,
                                              const Scene& scene,
                                              const MapOptions& options) {
  std::map<std::int32_t, double> angles;
  for (const Camera& camera : cameras_of(view)) {
    for (const auto& [key, seen] : Impl::of(scene, camera, options)) {
      HALFSPACE_LAW(seen.solid_angle > 0);
      angles[key] += seen.solid_angle;
    }
  }
  return angles;
}

bool are_close(double angle, double expected) {
  return std::abs(angle - expected) < 1e-13;
}

TYPED_TEST(S7Seen, L8AreasAreThoseOfTheMapAndAllDirectionsAreSeenOnce) {
  std::size_t with_several = 0;
  law::for_all_views(
      [&](const SceneFile& view) {
        const Scene scene = few_of(view.scene);
        const MapOptions own{view.options.cull, {}};
        const MapOptions one{view.options.cull,
                             std::vector<std::int32_t>(scene.polygon_count())};
        // In the view itself: the doubles next to the exact areas.
        Fraction sum = 0;
        double angles = 0;
        for (const auto& [key, seen] :
             TypeParam::of(scene, *view.camera, own)) {
          const Fraction area(seen.area);
          HALFSPACE_LAW(area > 0);
          HALFSPACE_LAW(seen.nearest == area.convert_to<double>());
          HALFSPACE_LAW((*view.camera)->perspective == (seen.solid_angle > 0));
          sum += area;
          if (key != kBackgroundKey) angles += seen.solid_angle;
        }
        const CameraData& camera = view.camera->data();
        HALFSPACE_LAW(sum == Fraction(camera.width_px) * camera.height_px);
        const SeenByKey together = TypeParam::of(scene, *view.camera, one);
        const auto all = together.find(0);
        HALFSPACE_LAW(are_close(
            angles, all == together.end() ? 0 : all->second.solid_angle));
        // In the panorama.
        double round = 0;
        const auto seen = seen_all_round<TypeParam>(view, scene, own);
        for (const auto& [key, angle] : seen) round += angle;
        HALFSPACE_LAW(are_close(round, 4 * std::numbers::pi));
        if (seen.size() > 2) ++with_several;
      },
      kSeenViews);
  EXPECT_GT(with_several, 20u);
}

using Real = boost::multiprecision::cpp_bin_float_50;
using Along = std::array<Integer, 3>;

Integer dot(const Along& u, const Along& v) {
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

/// The solid angle of a convex polygon: of the triangles from its first corner.
/// An eye in its plane sees nothing of it.
double solid_angle_of(const Scene& scene, PolygonId id,
                      const LatticeVector& eye) {
  std::vector<Along> rays;
  for (const VertexId corner : scene.corners(id)) {
    const GridPoint& p = scene.point(corner);
    const auto along = [](std::int64_t at, Int128 from) {
      return Integer(to_string(Int128{at} * (1 << kLatticeBits) - from));
    };
    rays.push_back({along(p.x, eye.x), along(p.y, eye.y), along(p.z, eye.z)});
  }
  Real sum = 0;
  for (std::size_t k = 2; k < rays.size(); ++k) {
    const Along& a = rays[0];
    const Along& b = rays[k - 1];
    const Along& c = rays[k];
    const Integer volume = a[0] * (b[1] * c[2] - b[2] * c[1]) +
                           a[1] * (b[2] * c[0] - b[0] * c[2]) +
                           a[2] * (b[0] * c[1] - b[1] * c[0]);
    if (volume == 0) continue;
    const auto length = [](const Along& v) -> Real {
      return sqrt(Real(dot(v, v)));
    };
    const Real cosine =
        length(a) * length(b) * length(c) + Real(dot(a, b)) * length(c) +
        Real(dot(b, c)) * length(a) + Real(dot(c, a)) * length(b);
    sum += 2 * atan2(Real(volume), cosine);
  }
  return abs(sum).convert_to<double>();
}

TYPED_TEST(S7Seen, L9APolygonAloneHasTheSolidAngleOfItsCorners) {
  std::size_t seen_ones = 0;
  law::for_all_views(
      [&](const SceneFile& view) {
        if (view.scene.polygon_count() == 0) return;
        const Scene scene = chosen(view.scene, {0});
        const double expected = solid_angle_of(scene, 0, eye_of(view));
        const auto seen = seen_all_round<TypeParam>(view, scene, {});
        const auto found = seen.find(0);
        const double angle = found == seen.end() ? 0 : found->second;
        HALFSPACE_LAW(are_close(angle, expected));
        if (angle > 0) ++seen_ones;
      },
      kSeenViews);
  EXPECT_GT(seen_ones, 50u);
}

}  // namespace
}  // namespace halfspace
