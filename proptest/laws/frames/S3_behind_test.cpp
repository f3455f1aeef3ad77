#include <cstddef>
#include <vector>

#include "adapters/both.hpp"
#include "definition/definition.hpp"
#include "halfspace/fast/image/behind.hpp"
#include "halfspace/ref/behind.hpp"
#include "laws/law.hpp"

/// The law of subtrees behind the viewer (S3.10).
namespace halfspace {
namespace {

struct RefBehind : Ref {
  static bool is_behind(const SceneFile& view, PolygonId splitter, Side side) {
    return ref::is_behind(
        ref::plane_of(ref::whole(view.scene, splitter).vertices), *view.camera,
        side);
  }
};

struct FastBehind : Fast {
  static bool is_behind(const SceneFile& view, PolygonId splitter, Side side) {
    return fast::is_behind(view.scene, splitter, *view.camera, side);
  }
};

template <class Impl>
class S3Behind : public ::testing::Test {};
using BehindImplementations = ::testing::Types<RefBehind, FastBehind>;
TYPED_TEST_SUITE(S3Behind, BehindImplementations);

definition::Integer wide(Int128 value) {
  definition::Integer result = static_cast<std::int64_t>(value >> 64);
  result <<= 64;
  return definition::Integer(result + static_cast<std::uint64_t>(value));
}

/// S3.10, by the signs at the four corners of the image.
bool defined_behind(const SceneFile& view, PolygonId splitter, int side) {
  const definition::Plane h = definition::plane_of(view.scene, splitter);
  const CameraData& camera = view.camera->data();
  const int eye = definition::side_of_eye(h, *view.camera);
  if (camera.perspective ? eye == side : eye != 0) return false;
  const auto along = [&](const LatticeVector& v) -> definition::Integer {
    return h.a * wide(v.x) + h.b * wide(v.y) + h.c * wide(v.z);
  };
  for (const int corner : {0, 1, 2, 3}) {
    definition::Integer growth = along(camera.s0);
    if (corner % 2 == 1) growth += camera.width_px * along(camera.sx);
    if (corner / 2 == 1) growth += camera.height_px * along(camera.sy);
    growth -= camera.perspective ? along(camera.eye)
                                 : definition::Integer(-256 * h.d);
    if (side * growth > 0) return false;
  }
  return true;
}

/// The fragments of a subtree.
std::vector<FragmentName> fragments_below(const TreeName& tree, NodeId root) {
  std::vector<FragmentName> found;
  std::vector<NodeId> ahead = {root};
  while (!ahead.empty()) {
    const NodeId id = ahead.back();
    ahead.pop_back();
    if (id == kNoNode) continue;
    const NodeName& node = tree[static_cast<std::size_t>(id)];
    found.insert(found.end(), node.coincident.begin(), node.coincident.end());
    ahead.push_back(node.positive);
    ahead.push_back(node.negative);
  }
  return found;
}

/// No fragment of the subtree covers a sample.
void expect_nothing_seen(const SceneFile& view, const TreeName& tree,
                         NodeId root) {
  for (const FragmentName& name : fragments_below(tree, root)) {
    const auto seen = definition::project(
        definition::facet_of(view.scene, name), *view.camera, false);
    for (std::int32_t j = 0; j < view.camera->data().height_px; ++j) {
      for (std::int32_t i = 0; i < view.camera->data().width_px; ++i)
        HALFSPACE_LAW(!definition::covers(seen, i, j));
    }
  }
}

TYPED_TEST(S3Behind, L17NothingBehindTheViewerIsSeen) {
  std::size_t left_out = 0;
  std::size_t from_a_splitter = 0;
  law::for_all_views([&](const SceneFile& view) {
    const TreeName tree = TypeParam::name_of(TypeParam::build(view.scene, {}));
    for (const NodeName& node : tree) {
      for (const int side : {1, -1}) {
        const bool is_behind =
            TypeParam::is_behind(view, node.splitter, static_cast<Side>(side));
        HALFSPACE_LAW(is_behind == defined_behind(view, node.splitter, side));
        const NodeId child = side > 0 ? node.positive : node.negative;
        if (!is_behind || child == kNoNode) continue;
        expect_nothing_seen(view, tree, child);
        ++left_out;
        const int eye = definition::side_of_eye(
            definition::plane_of(view.scene, node.splitter), *view.camera);
        from_a_splitter += eye == 0 ? 1u : 0u;
      }
    }
  });
  EXPECT_GT(left_out, 100u);
  EXPECT_GT(from_a_splitter, 20u);
}

/// What a walk leaves out, by the definition.
void count_left_out(const SceneFile& view, const TreeName& tree, NodeId id,
                    fast::BehindCount& count) {
  if (id == kNoNode) return;
  const NodeName& node = tree[static_cast<std::size_t>(id)];
  for (const int side : {1, -1}) {
    const NodeId child = side > 0 ? node.positive : node.negative;
    if (child == kNoNode) continue;
    if (!defined_behind(view, node.splitter, side)) {
      count_left_out(view, tree, child, count);
      continue;
    }
    ++count.subtrees;
    count.fragments += fragments_below(tree, child).size();
  }
}

TYPED_TEST(S3Behind, L17TheCountIsThatOfTheWalk) {
  std::size_t counted = 0;
  law::for_all_views([&](const SceneFile& view) {
    const fast::BspTree tree = fast::build(view.scene, {});
    const TreeName name = fast::name_of(tree);
    fast::BehindCount expected;
    count_left_out(view, name, name.empty() ? kNoNode : 0, expected);
    const fast::BehindCount count =
        fast::count_behind(view.scene, tree, *view.camera);
    HALFSPACE_LAW(count.subtrees == expected.subtrees);
    HALFSPACE_LAW(count.fragments == expected.fragments);
    counted += count.subtrees;
  });
  EXPECT_GT(counted, 50u);
}

}  // namespace
}  // namespace halfspace
