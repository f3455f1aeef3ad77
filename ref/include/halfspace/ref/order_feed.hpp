#pragma once

#include <array>
#include <vector>

#include "halfspace/camera.hpp"
#include "halfspace/feed_order.hpp"
#include "halfspace/ref/build.hpp"

namespace halfspace::ref {

/// A triangle of a fragment, and its polygon.
struct FedTriangle {
  PolygonId polygon = 0;
  std::array<Point, 3> corners;
};

/// The order feed of a tree for a camera (S3.8).
///
/// Exact: yes.
std::vector<FedTriangle> ordered_triangles(const BspTree& tree,
                                           const Camera& camera,
                                           FeedOrder order);

}  // namespace halfspace::ref
