#pragma once

#include <algorithm>
#include <vector>

#include "halfspace/plane.hpp"
#include "halfspace/scene.hpp"

/// What several laws make of a scene.
namespace halfspace {

/// The ids of a scene's polygons.
inline std::vector<PolygonId> ids_of(const Scene& scene) {
  std::vector<PolygonId> ids;
  for (std::size_t p = 0; p < scene.polygon_count(); ++p)
    ids.push_back(static_cast<PolygonId>(p));
  return ids;
}

/// The scene with every polygon turned over.
inline Scene reversed(const Scene& scene) {
  SceneData data = scene.data();
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    const auto first = static_cast<std::ptrdiff_t>(data.first_corner[p]);
    const auto end = static_cast<std::ptrdiff_t>(data.first_corner[p + 1]);
    std::reverse(data.corners.begin() + first, data.corners.begin() + end);
    if (!data.corner_colors.empty()) {
      std::reverse(data.corner_colors.begin() + first,
                   data.corner_colors.begin() + end);
    }
  }
  return *make_scene(std::move(data));
}

/// The scene of these polygons of a scene, in this order.
inline Scene chosen(const Scene& scene, const std::vector<PolygonId>& ids) {
  SceneData data = scene.data();
  data.first_corner = {0};
  data.corners.clear();
  data.colors.clear();
  data.corner_colors.clear();
  for (const PolygonId id : ids) {
    const auto corners = scene.corners(id);
    const auto colors = scene.corner_colors(id);
    data.corners.insert(data.corners.end(), corners.begin(), corners.end());
    data.corner_colors.insert(data.corner_colors.end(), colors.begin(),
                              colors.end());
    data.first_corner.push_back(
        static_cast<std::uint32_t>(data.corners.size()));
    data.colors.push_back(scene.color(id));
  }
  return *make_scene(std::move(data));
}

/// Fragments of a scene: its polygons, and their parts after cuts by the
/// planes of others.
template <class Impl>
std::vector<typename Impl::Fragment> fragments_of(const Scene& scene) {
  std::vector<typename Impl::Fragment> fragments;
  for (const PolygonId p : ids_of(scene)) {
    auto fragment = Impl::whole(scene, p);
    fragments.push_back(fragment);
    for (const PolygonId q : ids_of(scene)) {
      if (Impl::relation(scene, fragment, q) != Relation::kSpanning) continue;
      auto parts = Impl::split(scene, fragment, q);
      fragments.push_back(parts.first);
      fragments.push_back(parts.second);
      fragment = (p + q) % 2 == 0 ? parts.first : parts.second;
    }
  }
  return fragments;
}

}  // namespace halfspace
