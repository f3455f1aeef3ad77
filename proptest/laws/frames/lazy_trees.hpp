#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "halfspace/fast/image/lazy_tree.hpp"
#include "halfspace/scene.hpp"
#include "halfspace/splitmix.hpp"

/// Lazy trees of few polygons (S3.12), and polygons that move (S3.13).
namespace halfspace {

/// How small cells are, and how an image is made.
struct LazyKind {
  std::size_t cell_size;
  std::size_t most_in_cell;
  std::size_t leaf_size;
  int threads;
  fast::SimdLevel simd;
};
inline constexpr LazyKind kLazyKinds[] = {
    {1, 1, 1, 1, fast::SimdLevel::kBest},
    {1, 1000, 3, 2, fast::SimdLevel::kPortable},
    {3, 2, 500, 1, fast::SimdLevel::kPortable},
    {1000, 1000, 2, 2, fast::SimdLevel::kBest}};

inline fast::LazyTree open_lazy(const Scene& scene, const LazyKind& kind) {
  fast::LazyTreeOptions options;
  options.tree.leaf_size = kind.leaf_size;
  options.tree.threads = kind.threads;
  options.cell_size = kind.cell_size;
  options.most_listed = 6;
  options.most_in_cell = kind.most_in_cell;
  return fast::LazyTree(scene, options);
}

/// The scene with other polygons in place of some: each has the points of
/// another one, in its own vertices, or its own points exchanged or mirrored.
inline std::optional<std::pair<Scene, std::vector<PolygonId>>> moved(
    const Scene& scene, std::uint64_t seed) {
  SceneData data = scene.data();
  const std::size_t count = scene.polygon_count();
  std::vector<PolygonId> changed;
  for (std::size_t p = 0; p < count; ++p) {
    if (mix(seed + 5 * p) % 3 != 0) continue;
    const auto id = static_cast<PolygonId>(p);
    const auto other = static_cast<PolygonId>(mix(seed + 7 * p) % count);
    const auto to = scene.corners(id);
    const auto from = scene.corners(other);
    if (to.size() != from.size()) continue;
    const bool turned = mix(seed + 11 * p) % 2 == 0;
    const std::int64_t away = mix(seed + 13 * p) % 2 == 0 ? 1 : 0;
    for (std::size_t k = 0; k < to.size(); ++k) {
      GridPoint q = scene.point(from[turned ? to.size() - 1 - k : k]);
      q.x += away;
      data.vertices[static_cast<std::size_t>(to[k])] = q;
    }
    changed.push_back(id);
  }
  Result<Scene> made = make_scene(std::move(data));
  if (!made || changed.empty()) return std::nullopt;
  return std::pair(*std::move(made), std::move(changed));
}

/// The scene with vertices of each polygon of their own, so that one moves
/// alone.
inline std::optional<Scene> apart(const Scene& scene) {
  SceneData data = scene.data();
  for (VertexId& corner : data.corners) {
    data.vertices.push_back(data.vertices[static_cast<std::size_t>(corner)]);
    corner = static_cast<VertexId>(data.vertices.size() - 1);
  }
  const std::size_t own = data.corners.size();
  const std::size_t unused = data.vertices.size() - own;
  data.vertices.erase(
      data.vertices.begin(),
      data.vertices.begin() + static_cast<std::ptrdiff_t>(unused));
  for (VertexId& corner : data.corners) corner -= static_cast<VertexId>(unused);
  Result<Scene> made = make_scene(std::move(data));
  if (!made) return std::nullopt;
  return *std::move(made);
}

}  // namespace halfspace
