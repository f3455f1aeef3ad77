#include "halfspace/camera.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <random>
#include <string>

namespace halfspace {
namespace {

using boost::multiprecision::cpp_int;

/// Looks down the z axis at a square, from an eye above it.
CameraData example() {
  CameraData data;
  data.eye = {0, 0, 100};
  data.s0 = {-8, 8, 0};
  data.sx = {1, 0, 0};
  data.sy = {0, -1, 0};
  data.width_px = data.height_px = 16;
  return data;
}

std::string message_of(const CameraData& data, int grid_bits = 26) {
  const Result<Camera> camera = make_camera(data, grid_bits);
  if (!camera) return camera.error().message;
  EXPECT_EQ(camera->data(), data);
  return "";
}

ErrorCode code_of(const CameraData& data) {
  const Result<Camera> camera = make_camera(data, 26);
  return camera ? static_cast<ErrorCode>(-1) : camera.error().code;
}

TEST(MakeCamera, AcceptsComponentsUpToItsRangeAndNamesTheVectorBeyond) {
  LatticeVector CameraData::*const vectors[] = {
      &CameraData::eye, &CameraData::s0, &CameraData::sx, &CameraData::sy};
  const char* const names[] = {"eye", "s0", "sx", "sy"};
  Int128 LatticeVector::*const axes[] = {&LatticeVector::x, &LatticeVector::y,
                                         &LatticeVector::z};
  for (const int bits : {26, 40, 54}) {
    const Int128 limit = Int128{1} << (bits + 13);
    for (std::size_t v = 0; v < 4; ++v) {
      for (const auto axis : axes) {
        for (const int sign : {-1, 1}) {
          CameraData data = example();
          data.*vectors[v].*axis = sign * limit;
          // A limit in the wrong place may leave no image plane.
          const std::string at_limit = message_of(data, bits);
          EXPECT_EQ(at_limit.find("beyond"), std::string::npos) << at_limit;
          data.*vectors[v].*axis = sign * (limit + 1);
          EXPECT_EQ(message_of(data, bits),
                    std::string("the camera's ") + names[v] +
                        " has a component beyond " + to_string(limit));
        }
      }
    }
  }
  CameraData data = example();
  data.eye.x = Int128{1} << 40;
  EXPECT_EQ(code_of(data), ErrorCode::kOutOfRange);
}

TEST(MakeCamera, AcceptsImagesOf1To65536ColumnsAndRows) {
  for (std::int32_t CameraData::*const side :
       {&CameraData::width_px, &CameraData::height_px}) {
    for (const std::int32_t size : {1, 2, 65535, 65536}) {
      CameraData data = example();
      data.*side = size;
      EXPECT_EQ(message_of(data), "");
    }
    for (const std::int32_t size : {-65536, -1, 0, 65537}) {
      CameraData data = example();
      data.*side = size;
      EXPECT_EQ(message_of(data),
                "an image has 1 to 65536 columns and rows, "
                "not " +
                    std::to_string(size));
      EXPECT_EQ(code_of(data), ErrorCode::kOutOfRange);
    }
  }
}

TEST(MakeCamera, AcceptsANearDistanceUpToItsRange) {
  const std::int64_t most = std::int64_t{1} << 32;
  for (const bool perspective : {false, true}) {
    CameraData data = example();
    data.perspective = perspective;
    const std::int64_t least = perspective ? 0 : -most;
    for (const std::int64_t near : {least, most}) {
      data.near = near;
      EXPECT_EQ(message_of(data), "");
    }
    for (const std::int64_t near : {least - 1, most + 1}) {
      data.near = near;
      EXPECT_EQ(message_of(data),
                "the near distance is from " + std::to_string(least) +
                    " to 4294967296, not " + std::to_string(near));
      EXPECT_EQ(code_of(data), ErrorCode::kOutOfRange);
    }
  }
}

/// The determinant of three vectors, by the rule of Sarrus.
cpp_int determinant(const LatticeVector& u, const LatticeVector& v,
                    const LatticeVector& w) {
  const auto product = [](Int128 a, Int128 b, Int128 c) {
    return cpp_int(cpp_int(a) * cpp_int(b) * cpp_int(c));
  };
  return product(u.x, v.y, w.z) + product(u.y, v.z, w.x) +
         product(u.z, v.x, w.y) - product(u.z, v.y, w.x) -
         product(u.x, v.z, w.y) - product(u.y, v.x, w.z);
}

TEST(MakeCamera, RefusesAnImagePlaneThatIsNoneOrPassesThroughTheEye) {
  std::mt19937 random(20);
  const auto vector = [&](Int128 scale) {
    const auto component = [&] {
      return (static_cast<int>(random() % 5) - 2) * scale;
    };
    const Int128 x = component(), y = component();
    return LatticeVector{x, y, component()};
  };
  int flat = 0;
  for (int i = 0; i < 5000; ++i) {
    // Small vectors, and such at the ends of the range: the same shapes.
    const Int128 scale = i % 2 == 0 ? 1 : Int128{1} << (26 + 12);
    CameraData data = example();
    data.perspective = i % 4 < 2;
    data.eye = vector(scale);
    data.s0 = vector(scale);
    data.sx = vector(scale);
    data.sy = vector(scale);
    const LatticeVector depth =
        data.perspective
            ? LatticeVector{data.s0.x - data.eye.x, data.s0.y - data.eye.y,
                            data.s0.z - data.eye.z}
            : data.eye;
    const bool is_flat = determinant(data.sx, data.sy, depth) == 0;
    flat += is_flat ? 1 : 0;
    ASSERT_EQ(message_of(data),
              !is_flat ? ""
              : data.perspective
                  ? "the camera's image plane passes through its eye, or is "
                    "no plane"
                  : "the camera looks along its image plane, or that is no "
                    "plane");
    ASSERT_EQ(code_of(data) == ErrorCode::kBadCamera, is_flat);
  }
  EXPECT_GT(flat, 250);
  EXPECT_LT(flat, 2500);
}

}  // namespace
}  // namespace halfspace
