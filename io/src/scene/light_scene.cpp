#include "halfspace/io/light_scene.hpp"

#include <utility>

#include "scene/shade.hpp"

namespace halfspace::io {

Scene lit_scene(const Scene& scene, const std::vector<bool>& is_lit) {
  SceneData data = scene.data();
  const ImportOptions options;
  std::vector<GridPoint> points;
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    if (!is_lit.empty() && is_lit[p]) continue;
    points.clear();
    for (const VertexId corner : scene.corners(static_cast<PolygonId>(p)))
      points.push_back(scene.point(corner));
    data.colors[p] = lit(data.colors[p], normal_of(points), options);
  }
  // Nothing but colours differs from a scene that was valid.
  return *make_scene(std::move(data));
}

}  // namespace halfspace::io
