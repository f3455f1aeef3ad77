#include <algorithm>
#include <utility>
#include <vector>

#include "adapters/both.hpp"
#include "adapters/scenes.hpp"
#include "halfspace/fast/order_feed.hpp"
#include "halfspace/ref/order_feed.hpp"
#include "laws/law.hpp"

namespace halfspace {
namespace {

template <class Impl>
class S3Feed : public ::testing::Test {};
TYPED_TEST_SUITE(S3Feed, Implementations);

using Polygons = std::vector<PolygonId>;

Polygons fed(const Ref*, const SceneFile& view, FeedOrder order) {
  Polygons polygons;
  for (const ref::FedTriangle& triangle :
       ref::ordered_triangles(Ref::build(view.scene, {}), *view.camera, order))
    polygons.push_back(triangle.polygon);
  return polygons;
}

Polygons fed(const Fast*, const SceneFile& view, FeedOrder order) {
  const fast::BspTree tree = fast::build(view.scene, {});
  const fast::FragmentVertices vertices =
      fast::fragment_vertices(view.scene, tree);
  const auto indices =
      fast::order_indices(view.scene, tree, vertices, *view.camera, order);
  HALFSPACE_LAW(indices.size() % 3 == 0);
  Polygons polygons;
  for (std::size_t k = 0; k < indices.size(); k += 3) {
    const std::uint32_t first = indices[k];
    HALFSPACE_LAW(first < indices[k + 1]);
    HALFSPACE_LAW(indices[k + 1] + 1 == indices[k + 2]);
    HALFSPACE_LAW(indices[k + 2] < vertices.positions.size());
    const PolygonId polygon = vertices.polygons[first];
    HALFSPACE_LAW(vertices.polygons[indices[k + 2]] == polygon);
    polygons.push_back(polygon);
  }
  return polygons;
}

/// A fragment's polygon as often as its fan has triangles.
Polygons of_fragments(const std::vector<FragmentName>& fragments) {
  Polygons polygons;
  for (const FragmentName& fragment : fragments)
    polygons.insert(polygons.end(), fragment.edges.size() - 2, fragment.source);
  return polygons;
}

TYPED_TEST(S3Feed, L14TheFeedIsTheDisplaysFragmentsInOrder) {
  const auto* impl = static_cast<const TypeParam*>(nullptr);
  std::size_t triangles = 0;
  law::for_all_views([&](const SceneFile& view) {
    const auto tree = TypeParam::build(view.scene, {});
    const Polygons back = fed(impl, view, FeedOrder::kBackToFront);
    const Polygons front = fed(impl, view, FeedOrder::kFrontToBack);
    HALFSPACE_LAW(back ==
                  of_fragments(TypeParam::back_to_front(tree, *view.camera)));
    HALFSPACE_LAW(front ==
                  of_fragments(TypeParam::front_to_back(tree, *view.camera)));
    Polygons reversed = back;
    std::reverse(reversed.begin(), reversed.end());
    HALFSPACE_LAW(reversed == front);
    triangles += back.size();
  });
  EXPECT_GT(triangles, 1000u);
}

}  // namespace
}  // namespace halfspace
