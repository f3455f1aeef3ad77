#include "halfspace/csg/trimmed.hpp"

#include <utility>
#include <vector>

namespace halfspace::csg {

SceneData trimmed(const Scene& scene) {
  SceneData data = scene.data();
  std::vector<VertexId> ids(data.vertices.size(), -1);
  std::vector<GridPoint> vertices;
  for (VertexId& corner : data.corners) {
    VertexId& id = ids[static_cast<std::size_t>(corner)];
    if (id < 0) {
      id = static_cast<VertexId>(vertices.size());
      vertices.push_back(scene.point(corner));
    }
    corner = id;
  }
  data.vertices = std::move(vertices);
  data.corner_colors.clear();
  return data;
}

}  // namespace halfspace::csg
