#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <vector>

#include "peers/peer.hpp"
#include "timing.hpp"

namespace halfspace::bench {
namespace {

/// Rays of one call of a stream; one tile of it.
constexpr std::int32_t kStreamWidth = 16;
constexpr std::int32_t kStreamHeight = 8;

/// The hits of a packet, lane by lane.
struct Hits {
  const unsigned* triangles;
  const float* u;
  const float* v;
};

class Embree final : public Peer {
 public:
  Embree(const Soup& soup, RayPackets packets, double& build_ms)
      : soup_(soup), packets_(packets) {
    frame_.resize(static_cast<std::size_t>(soup.width_px) *
                  static_cast<std::size_t>(soup.height_px));
    const double start = process_ms();
    device_ = rtcNewDevice("threads=1");
    scene_ = rtcNewScene(device_);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    const std::size_t count = soup.triangles.size();
    auto* const vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
        3 * sizeof(float), 3 * count));
    auto* const indices = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0,
                                RTC_FORMAT_UINT3, 3 * sizeof(unsigned), count));
    for (std::size_t k = 0; k < count; ++k) {
      std::memcpy(vertices + 9 * k, soup.triangles[k].corners.data(),
                  9 * sizeof(float));
      for (std::size_t c = 0; c < 3; ++c) {
        indices[3 * k + c] = static_cast<unsigned>(3 * k + c);
      }
    }
    rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
    build_ms = process_ms() - start;
  }

  ~Embree() override {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  void draw(Look look) override {
    switch (packets_) {
      case RayPackets::k8:
        draw_packets<RTCRayHit8, 8, 4, 2>(look);
        break;
      case RayPackets::k16:
        draw_packets<RTCRayHit16, 16, 4, 4>(look);
        break;
      case RayPackets::kStream:
        draw_streams(look);
        break;
    }
  }

  std::vector<Pixel> pixels() override { return frame_; }

 private:
  static void intersect(const int* valid, RTCScene scene,
                        RTCIntersectContext* context, RTCRayHit8* rays) {
    rtcIntersect8(valid, scene, context, rays);
  }
  static void intersect(const int* valid, RTCScene scene,
                        RTCIntersectContext* context, RTCRayHit16* rays) {
    rtcIntersect16(valid, scene, context, rays);
  }

  /// From the eye towards a pixel's centre.
  std::array<float, 3> direction(std::int32_t i, std::int32_t j) const {
    const float x = static_cast<float>(i) + 0.5f;
    const float y = static_cast<float>(j) + 0.5f;
    std::array<float, 3> d{};
    for (std::size_t k = 0; k < 3; ++k) {
      d[k] = static_cast<float>(soup_.corner[k]) +
             x * static_cast<float>(soup_.right[k]) +
             y * static_cast<float>(soup_.down[k]);
    }
    return d;
  }

  template <class Rays, std::size_t kCount, int kWidth, int kHeight>
  void draw_packets(Look look) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (std::int32_t y = 0; y < soup_.height_px; y += kHeight) {
      for (std::int32_t x = 0; x < soup_.width_px; x += kWidth) {
        alignas(64) Rays rays;
        alignas(64) int valid[kCount];
        for (int k = 0; k < kWidth * kHeight; ++k) {
          const std::int32_t i = x + k % kWidth, j = y + k / kWidth;
          valid[k] = i < soup_.width_px && j < soup_.height_px ? -1 : 0;
          set_ray(rays, k, direction(i, j));
        }
        intersect(valid, scene_, &context, &rays);
        const Hits hits = {rays.hit.primID, rays.hit.u, rays.hit.v};
        for (int k = 0; k < kWidth * kHeight; ++k) {
          if (valid[k] != 0) {
            put(look, x + k % kWidth, y + k / kWidth, hits, k);
          }
        }
      }
    }
  }

  template <class Rays>
  void set_ray(Rays& rays, int k, const std::array<float, 3>& d) const {
    rays.ray.org_x[k] = static_cast<float>(soup_.eye[0]);
    rays.ray.org_y[k] = static_cast<float>(soup_.eye[1]);
    rays.ray.org_z[k] = static_cast<float>(soup_.eye[2]);
    rays.ray.tnear[k] = 0;
    rays.ray.tfar[k] = std::numeric_limits<float>::infinity();
    rays.ray.dir_x[k] = d[0];
    rays.ray.dir_y[k] = d[1];
    rays.ray.dir_z[k] = d[2];
    rays.ray.time[k] = 0;
    rays.ray.mask[k] = ~0u;
    rays.ray.flags[k] = 0;
    rays.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
    rays.hit.primID[k] = RTC_INVALID_GEOMETRY_ID;
    rays.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
  }

  void draw_streams(Look look) {
    constexpr int kCount = kStreamWidth * kStreamHeight;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    alignas(64) std::array<RTCRayHit, kCount> rays;
    for (std::int32_t y = 0; y < soup_.height_px; y += kStreamHeight) {
      for (std::int32_t x = 0; x < soup_.width_px; x += kStreamWidth) {
        const std::int32_t width = std::min(kStreamWidth, soup_.width_px - x);
        const std::int32_t height =
            std::min(kStreamHeight, soup_.height_px - y);
        unsigned count = 0;
        for (std::int32_t j = y; j < y + height; ++j) {
          for (std::int32_t i = x; i < x + width; ++i) {
            rays[count++] = single_ray(direction(i, j));
          }
        }
        rtcIntersect1M(scene_, &context, rays.data(), count, sizeof(RTCRayHit));
        count = 0;
        for (std::int32_t j = y; j < y + height; ++j) {
          for (std::int32_t i = x; i < x + width; ++i) {
            const RTCHit& hit = rays[count++].hit;
            put(look, i, j, {&hit.primID, &hit.u, &hit.v}, 0);
          }
        }
      }
    }
  }

  RTCRayHit single_ray(const std::array<float, 3>& d) const {
    RTCRayHit ray{};
    ray.ray.org_x = static_cast<float>(soup_.eye[0]);
    ray.ray.org_y = static_cast<float>(soup_.eye[1]);
    ray.ray.org_z = static_cast<float>(soup_.eye[2]);
    ray.ray.dir_x = d[0];
    ray.ray.dir_y = d[1];
    ray.ray.dir_z = d[2];
    ray.ray.tfar = std::numeric_limits<float>::infinity();
    ray.ray.mask = ~0u;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    ray.hit.primID = RTC_INVALID_GEOMETRY_ID;
    ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    return ray;
  }

  void put(Look look, std::int32_t i, std::int32_t j, const Hits& hits, int k) {
    frame_[static_cast<std::size_t>(j) *
               static_cast<std::size_t>(soup_.width_px) +
           static_cast<std::size_t>(i)] =
        shade(look, hits.triangles[k], hits.u[k], hits.v[k]);
  }

  Pixel shade(Look look, unsigned hit, float u, float v) const {
    if (hit == RTC_INVALID_GEOMETRY_ID) return kWhite;
    const SoupTriangle& triangle = soup_.triangles[hit];
    if (look == Look::kFlat) return triangle.color;
    if (look == Look::kIds) return id_pixel(triangle.source);
    Pixel pixel = Pixel{255} << 24;
    for (const int shift : {0, 8, 16}) {
      const auto value = [&](std::size_t k) {
        return static_cast<float>(triangle.corner_colors[k] >> shift & 255);
      };
      const float mixed =
          (1 - u - v) * value(0) + u * value(1) + v * value(2) + 0.5f;
      pixel |= (static_cast<Pixel>(static_cast<int>(mixed)) & 255) << shift;
    }
    return pixel;
  }

  const Soup& soup_;
  RayPackets packets_;
  std::vector<Pixel> frame_;
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
};

}  // namespace

std::unique_ptr<Peer> make_embree(const Soup& soup, RayPackets packets,
                                  double& build_ms) {
  return std::make_unique<Embree>(soup, packets, build_ms);
}

}  // namespace halfspace::bench
