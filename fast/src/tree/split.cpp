#include "halfspace/fast/split.hpp"

#include "tree/scene_planes.hpp"
#include "tree/split_walk.hpp"

namespace halfspace::fast {

SplitResult split(const Scene& scene, const Fragment& fragment,
                  PolygonId splitter, FilterStats& stats) {
  const std::vector<FreePlane> none;
  const Geometry geometry(scene, none);
  const FilterPlane plane = filter_plane(geometry.plane(splitter));
  SplitResult result{{fragment.source, {}, {}}, {fragment.source, {}, {}}};

  // Step 1: the plane's sign at each vertex.
  const std::size_t count = fragment.vertices.size();
  std::vector<std::int8_t> signs;
  std::vector<Bounded> values;
  for (std::size_t k = 0; k < count; ++k) {
    signs.push_back(
        static_cast<std::int8_t>(side_of(scene, fragment, k, splitter, stats)));
    values.push_back(
        value_at(plane, fragment.vertices[k], geometry.rounding()));
  }

  // Step 2: walk round the boundary.
  const EdgeName cut_name{EdgeName::Kind::kSplitter, splitter};
  walk_cut(signs, [&](int part, std::size_t k, bool crossing, bool cut) {
    Fragment& to = part > 0 ? result.positive : result.negative;
    const std::size_t next = k + 1 == count ? 0 : k + 1;
    Vertex vertex = fragment.vertices[k];
    if (crossing) {
      vertex = meet(vertex, values[k], fragment.vertices[next], values[next],
                    geometry.rounding());
      const Vertex from_source =
          geometry.crossing(fragment.source, code_of(fragment.edges[k]), plane);
      if (from_source.error <= vertex.error) vertex = from_source;
    }
    to.vertices.push_back(vertex);
    to.edges.push_back(cut ? cut_name : fragment.edges[k]);
  });
  return result;
}

}  // namespace halfspace::fast
