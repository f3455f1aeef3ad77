#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "halfspace/camera.hpp"
#include "halfspace/result.hpp"
#include "halfspace/scene.hpp"
#include "views.hpp"

namespace halfspace::bench {

/// A scene to draw and how it is looked at; made when it is asked for.
struct Workload {
  std::string name;  ///< for example "W1 S500 N500"
  bool parallel;     ///< its triangles have an exact order
  std::function<Result<Scene>()> scene;
  std::function<Camera(const Scene&, View, std::int32_t size_px)> camera;
};

/// W1: random triangles of F2B, sizes 300 and 500.
/// W2: 1,000 to 100,000 triangles parallel to the screen (seen from the front).
/// W3: 100,000 and 1,000,000 random triangles of sizes 20 and 50.
/// W4: meshes of 80,000 to 1,000,000 triangles made by code.
///
/// Each draws on a seed of its own, which depends on `seed` and its place.
/// With `grid_bits` coordinates are floats on such a grid: in_floats().
std::vector<Workload> workloads(std::uint64_t seed,
                                std::optional<int> grid_bits = std::nullopt);

}  // namespace halfspace::bench
