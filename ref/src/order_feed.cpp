#include "halfspace/ref/order_feed.hpp"

#include "halfspace/ref/traverse.hpp"

namespace halfspace::ref {

std::vector<FedTriangle> ordered_triangles(const BspTree& tree,
                                           const Camera& camera,
                                           FeedOrder order) {
  std::vector<FedTriangle> triangles;
  const auto visit = [&](const Node&, const Fragment& fragment) {
    const std::vector<Point>& corners = fragment.vertices;
    for (std::size_t k = 2; k < corners.size(); ++k) {
      triangles.push_back(
          {fragment.source, {corners[0], corners[k - 1], corners[k]}});
    }
    return true;
  };
  if (order == FeedOrder::kBackToFront) {
    back_to_front(tree, camera, visit);
  } else {
    front_to_back(tree, camera, visit);
  }
  return triangles;
}

}  // namespace halfspace::ref
