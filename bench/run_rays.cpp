#include <embree3/rtcore.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/ray.hpp"
#include "papers/table.hpp"
#include "random_rays.hpp"
#include "timing.hpp"
#include "workloads.hpp"

/// First hits of rays in all directions, one by one, in one thread: ours
/// through the display tree, exactly, and Embree's in single precision.
namespace halfspace::bench {
namespace {

/// The scene's polygons, cut into fans, in Embree's tree.
class EmbreeScene {
 public:
  EmbreeScene(const Scene& scene, const Extent& extent) : extent_(extent) {
    device_ = rtcNewDevice("threads=1");
    scene_ = rtcNewScene(device_);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
    std::vector<std::array<unsigned, 3>> triangles;
    for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
      const auto corners = scene.corners(static_cast<PolygonId>(p));
      for (std::size_t k = 2; k < corners.size(); ++k) {
        triangles.push_back({static_cast<unsigned>(corners[0]),
                             static_cast<unsigned>(corners[k - 1]),
                             static_cast<unsigned>(corners[k])});
        sources_.push_back(static_cast<PolygonId>(p));
      }
    }
    const auto& points = scene.data().vertices;
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* const vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
        3 * sizeof(float), points.size()));
    for (std::size_t v = 0; v < points.size(); ++v) {
      const std::array<std::int64_t, 3> at = {points[v].x, points[v].y,
                                              points[v].z};
      for (std::size_t k = 0; k < 3; ++k)
        vertices[3 * v + k] = scaled(static_cast<double>(at[k]), k);
    }
    auto* const indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
        3 * sizeof(unsigned), triangles.size()));
    for (std::size_t t = 0; t < triangles.size(); ++t)
      std::copy(triangles[t].begin(), triangles[t].end(), indices + 3 * t);
    rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
    rtcInitIntersectContext(&context_);
  }
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;
  ~EmbreeScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  PolygonId first_hit(const Ray& ray) {
    RTCRayHit hit{};
    const auto& [from, along, reach] = ray.data();
    hit.ray.org_x = scaled(static_cast<double>(from.x) / 256, 0);
    hit.ray.org_y = scaled(static_cast<double>(from.y) / 256, 1);
    hit.ray.org_z = scaled(static_cast<double>(from.z) / 256, 2);
    hit.ray.dir_x = length(along.x);
    hit.ray.dir_y = length(along.y);
    hit.ray.dir_z = length(along.z);
    hit.ray.tfar = std::numeric_limits<float>::infinity();
    hit.ray.mask = ~0u;
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &context_, &hit);
    return hit.hit.geomID == RTC_INVALID_GEOMETRY_ID ? kBackground
                                                     : sources_[hit.hit.primID];
  }

 private:
  float scaled(double at, std::size_t axis) const {
    return static_cast<float>((at - extent_.middle[axis]) / extent_.radius);
  }
  float length(Int128 lattice) const {
    return static_cast<float>(static_cast<double>(lattice) / 256 /
                              extent_.radius);
  }

  Extent extent_;
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
  RTCIntersectContext context_{};
  std::vector<PolygonId> sources_;
};

/// Rays a second, in thousands.
std::string rate(std::size_t rays, double ms) {
  return digits(static_cast<double>(rays) / ms, 3);
}

int run(const std::vector<std::string>& only, std::size_t count,
        std::uint64_t seed) {
  Table table;
  table.head = {"workload",      "polygons", "hit",
                "ours, k/s",     "all hits", "Embree, k/s",
                "Embree / ours", "the same", "exact"};
  for (const Workload& workload : workloads(seed)) {
    const bool is_wanted =
        only.empty() || std::any_of(only.begin(), only.end(), [&](auto& part) {
          return (workload.name + " ").find(part + " ") != std::string::npos;
        });
    if (!is_wanted) continue;
    const Result<Scene> scene = workload.scene();
    if (!scene) {
      std::fprintf(stderr, "run_rays: %s\n", scene.error().message.c_str());
      return 2;
    }
    const Extent extent = extent_of(*scene);
    const std::vector<Ray> rays = random_rays(*scene, extent, count, seed);
    fast::DisplayTreeOptions options;
    options.leaf_size = 4;
    options.threads = 1;
    const fast::BspTree tree = fast::build_display_tree(*scene, options);
    std::vector<PolygonId> hits(count), peers(count);
    std::size_t all = 0;
    fast::FilterStats stats;
    const Repeats repeats{5, 3000};
    const double ours =
        processor_time(
            [&] {
              stats = {};
              for (std::size_t r = 0; r < count; ++r) {
                const auto hit = fast::first_hit(*scene, tree, rays[r], stats);
                hits[r] = hit ? hit->polygon : kBackground;
              }
            },
            repeats)
            .least;
    const double every = processor_time(
                             [&] {
                               all = 0;
                               for (const Ray& ray : rays)
                                 all +=
                                     fast::all_hits(*scene, tree, ray).size();
                             },
                             repeats)
                             .least;
    EmbreeScene embree(*scene, extent);
    const double theirs = processor_time(
                              [&] {
                                for (std::size_t r = 0; r < count; ++r)
                                  peers[r] = embree.first_hit(rays[r]);
                              },
                              repeats)
                              .least;
    std::size_t hit = 0;
    std::size_t same = 0;
    for (std::size_t r = 0; r < count; ++r) {
      hit += hits[r] != kBackground ? 1u : 0u;
      same += hits[r] == peers[r] ? 1u : 0u;
    }
    const auto share = [count](std::size_t part) {
      return digits(
                 100 * static_cast<double>(part) / static_cast<double>(count),
                 4) +
             " %";
    };
    table.rows.push_back({workload.name, std::to_string(scene->polygon_count()),
                          share(hit), rate(count, ours), rate(count, every),
                          rate(count, theirs), digits(ours / theirs, 3),
                          share(same), std::to_string(stats.exact)});
  }
  std::printf("%s", to_markdown(table).c_str());
  return 0;
}

}  // namespace
}  // namespace halfspace::bench

int main(int argc, char** argv) {
  CLI::App app("Rays a second, ours and Embree's");
  std::vector<std::string> only;
  std::size_t count = 200'000;
  std::uint64_t seed = 1;
  app.add_option("--only", only, "Workloads, by parts of their names");
  app.add_option("--rays", count, "How many rays");
  app.add_option("--seed", seed, "Of the scenes and the rays");
  CLI11_PARSE(app, argc, argv);
  return halfspace::bench::run(only, count, seed);
}
