#include "halfspace/fast/order_feed.hpp"

#include "halfspace/fast/traverse.hpp"
#include "tree/tree_reader.hpp"

namespace halfspace::fast {

FragmentVertices fragment_vertices(const Scene& scene, const BspTree& tree) {
  const TreeReader reader(scene, tree);
  FragmentVertices result;
  for (const TreeFragment& fragment : tree.fragments) {
    for (const Corner& corner : reader.corners(fragment)) {
      const Vertex v = reader.vertex(corner.vertex);
      result.positions.push_back({v.x, v.y, v.z});
      result.polygons.push_back(fragment.source);
    }
    result.first_vertex.push_back(
        static_cast<std::uint32_t>(result.positions.size()));
  }
  return result;
}

std::vector<std::uint32_t> order_indices(const Scene& scene,
                                         const BspTree& tree,
                                         const FragmentVertices& vertices,
                                         const Camera& camera,
                                         FeedOrder order) {
  std::vector<std::uint32_t> indices;
  const auto visit = [&](const Node&, const TreeFragment& fragment) {
    const auto f = static_cast<std::size_t>(&fragment - tree.fragments.data());
    const std::uint32_t first = vertices.first_vertex[f];
    for (std::uint32_t k = first + 2; k < vertices.first_vertex[f + 1]; ++k)
      indices.insert(indices.end(), {first, k - 1, k});
    return true;
  };
  if (order == FeedOrder::kBackToFront) {
    back_to_front(tree, scene, camera, visit);
  } else {
    front_to_back(tree, scene, camera, visit);
  }
  return indices;
}

}  // namespace halfspace::fast
