#include "definition/definition.hpp"
#include "halfspace/fast/traverse.hpp"
#include "halfspace/ref/build.hpp"
#include "halfspace/ref/traverse.hpp"
#include "views.hpp"

namespace halfspace {
namespace {

/// Source and splitter of every fragment in the order of display.
using Order = std::vector<std::pair<PolygonId, PolygonId>>;

auto into(Order& order) {
  return [&order](const auto& node, const auto& fragment) {
    order.emplace_back(node.splitter, fragment.source);
    return true;
  };
}

/// Both trees have the same names, sizes and orders of display.
void expect_same(const SceneFile& view, const ref::BspTree& tree,
                 const fast::BspTree& other, const fuzz::Shown& text) {
  HALFSPACE_FUZZ_EXPECT(fast::name_of(other) == ref::name_of(tree), text);
  HALFSPACE_FUZZ_EXPECT(fast::stats(other) == ref::stats(tree), text);
  Order near_first, far_first, other_near_first, other_far_first;
  ref::front_to_back(tree, *view.camera, into(near_first));
  ref::back_to_front(tree, *view.camera, into(far_first));
  fast::front_to_back(other, view.scene, *view.camera, into(other_near_first));
  fast::back_to_front(other, view.scene, *view.camera, into(other_far_first));
  HALFSPACE_FUZZ_EXPECT(other_near_first == near_first, text);
  HALFSPACE_FUZZ_EXPECT(other_far_first == far_first, text);
}

/// Reference, fast library and definition make the same tree by the rule, and
/// walk it alike.
void expect_built(const SceneFile& view, const BuildOptions& options,
                  const fuzz::Shown& text) {
  const ref::BspTree tree = ref::build(view.scene, options);
  const TreeName name = ref::name_of(tree);
  HALFSPACE_FUZZ_EXPECT(definition::build(view.scene, options) == name, text);
  expect_same(view, tree, fast::build(view.scene, options), text);
  std::vector<FragmentName> order;
  ref::front_to_back(tree, *view.camera,
                     [&order](const ref::Node&, const ref::Fragment& fragment) {
                       order.push_back(ref::name_of(fragment));
                       return true;
                     });
  HALFSPACE_FUZZ_EXPECT(
      order == definition::front_to_back(view.scene, name, *view.camera), text);
}

/// Both libraries make the same tree by insertion, and by removal.
void expect_grown(const SceneFile& view, const fuzz::Shown& text) {
  // Inserted one by one, from the back and from the front in turn.
  ref::BspTree grown;
  fast::BspTree other;
  const auto planes = ref::planes_of(view.scene);
  for (PolygonId low = 0,
                 high = static_cast<PolygonId>(view.scene.polygon_count());
       low < high;) {
    const PolygonId id = ((low ^ high) & 1) == 0 ? low++ : --high;
    ref::insert(grown, ref::whole(view.scene, id),
                planes[static_cast<std::size_t>(id)]);
    fast::insert(other, view.scene, id);
  }
  expect_same(view, grown, other, text);
  // Every second one goes.
  std::vector<PolygonId> gone;
  for (PolygonId id = 0;
       id < static_cast<PolygonId>(view.scene.polygon_count()); id += 2) {
    gone.push_back(id);
  }
  ref::remove(grown, gone);
  fast::remove(other, view.scene, gone);
  expect_same(view, grown, other, text);
}

}  // namespace
}  // namespace halfspace

/// An input tries a rule, or insertion and removal; a replay both.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  using namespace halfspace;
  fuzz::Bytes bytes(data, size);
  const BuildOptions options = fuzz::build_options_of(bytes);
  const SceneFile view = fuzz::view_of(bytes);
  const fuzz::Shown text{view};
  // Of its rules only that which draws at random asks for the seed.
  const auto part = options.seed / 12 % 2;
  if (fuzz::kReplays || part == 0) expect_built(view, options, text);
  if (fuzz::kReplays || part == 1) expect_grown(view, text);
  return 0;
}
