#include "workloads.hpp"

#include <utility>

#include "halfspace/bsp_tree.hpp"
#include "scenes.hpp"

namespace halfspace::bench {
namespace {

Workload triangles(const char* set, const RandomTriangles& recipe) {
  return {std::string(set) + " S" + std::to_string(recipe.size) + " N" +
              std::to_string(recipe.count),
          recipe.parallel,
          [recipe]() -> Result<Scene> { return random_triangles(recipe); },
          [](const Scene&, View view, std::int32_t size_px) {
            return universe_camera(view, size_px);
          }};
}

Workload mesh(const char* name, Surface surface, std::int32_t rings,
              std::int32_t sectors, std::uint64_t seed) {
  return {std::string("W4 ") + name, false,
          [=]() -> Result<Scene> {
            return surface_mesh(surface, rings, sectors, seed);
          },
          &scene_camera};
}

/// The workload with floats for coordinates.
Workload with_floats(Workload workload, int grid_bits) {
  workload.scene = [make = std::move(workload.scene),
                    grid_bits]() -> Result<Scene> {
    const Result<Scene> scene = make();
    return scene ? in_floats(*scene, grid_bits) : scene;
  };
  if (workload.name.rfind("W4", 0) != 0) {
    workload.camera = [](const Scene& scene, View view, std::int32_t size_px) {
      return universe_camera(scene, view, size_px);
    };
  }
  return workload;
}

}  // namespace

std::vector<Workload> workloads(std::uint64_t seed,
                                std::optional<int> grid_bits) {
  const auto seed_of = [seed](std::uint64_t place) {
    return mix(seed) + place;
  };
  std::vector<Workload> all = {
      triangles("W1", {300, 500, false, seed_of(1)}),
      triangles("W1", {500, 500, false, seed_of(2)}),
      triangles("W2", {500, 1'000, true, seed_of(3)}),
      triangles("W2", {500, 10'000, true, seed_of(4)}),
      triangles("W2", {500, 100'000, true, seed_of(5)}),
      triangles("W3", {20, 100'000, false, seed_of(6)}),
      triangles("W3", {20, 1'000'000, false, seed_of(7)}),
      triangles("W3", {50, 1'000'000, false, seed_of(8)}),
      mesh("rock 80k", Surface::kRock, 201, 200, seed_of(9)),
      mesh("Klein bottle 250k", Surface::kKleinBottle, 250, 500, seed_of(10)),
      mesh("torus 1M", Surface::kTorus, 500, 1000, seed_of(11)),
  };
  if (grid_bits) {
    for (Workload& one : all) one = with_floats(std::move(one), *grid_bits);
  }
  return all;
}

}  // namespace halfspace::bench
