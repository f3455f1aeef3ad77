#include <algorithm>

#include "adapters/both.hpp"
#include "adapters/scenes.hpp"
#include "definition/definition.hpp"
#include "laws/law.hpp"

namespace halfspace {
namespace {

template <class Impl>
class S3Order : public ::testing::Test {};
TYPED_TEST_SUITE(S3Order, Implementations);

TYPED_TEST(S3Order, L11TheTwoOrdersAreEachOthersReverse) {
  std::size_t on_splitter = 0;
  law::for_all_views([&](const SceneFile& view) {
    for (const RootRule rule : {RootRule::kFirst, RootRule::kRandom}) {
      const auto tree = TypeParam::build(view.scene, {rule});
      const TreeName name = TypeParam::name_of(tree);
      const auto forwards = TypeParam::front_to_back(tree, *view.camera);
      auto backwards = TypeParam::back_to_front(tree, *view.camera);
      HALFSPACE_LAW(forwards ==
                    definition::front_to_back(view.scene, name, *view.camera));
      HALFSPACE_LAW(backwards ==
                    definition::back_to_front(view.scene, name, *view.camera));
      std::reverse(backwards.begin(), backwards.end());
      HALFSPACE_LAW(forwards == backwards);
      // Every fragment once, but for those whose plane holds the eye.
      std::size_t visible = 0;
      for (const NodeName& node : name) {
        const int eye = definition::side_of_eye(
            definition::plane_of(view.scene, node.splitter), *view.camera);
        if (eye != 0) visible += node.coincident.size();
        if (eye == 0) ++on_splitter;
      }
      HALFSPACE_LAW(forwards.size() == visible);
    }
  });
  EXPECT_GT(on_splitter, 100u);
}

TYPED_TEST(S3Order, L12NoFragmentIsHiddenByALaterOne) {
  std::size_t contests = 0;
  law::for_all_views([&](const SceneFile& view) {
    const auto tree = TypeParam::build(view.scene, {});
    std::vector<definition::Projection> seen;
    std::vector<PolygonId> sources;
    for (const auto& name : TypeParam::front_to_back(tree, *view.camera)) {
      seen.push_back(definition::project(definition::facet_of(view.scene, name),
                                         *view.camera, false));
      sources.push_back(name.source);
    }
    for (std::int32_t j = 0; j < view.camera->data().height_px; ++j) {
      for (std::int32_t i = 0; i < view.camera->data().width_px; ++i) {
        std::size_t last = seen.size();
        for (std::size_t k = 0; k < seen.size(); ++k) {
          if (!definition::covers(seen[k], i, j)) continue;
          if (last < seen.size()) {
            const int depth =
                definition::compare_depth(seen[last], seen[k], i, j);
            HALFSPACE_LAW(depth < 0 ||
                          (depth == 0 && sources[last] < sources[k]));
            ++contests;
          }
          last = k;
        }
      }
    }
  });
  EXPECT_GT(contests, 1000u);
}

TYPED_TEST(S3Order, L13ADisplayThatSaysStopIsNotCalledAgain) {
  law::for_all_views([&](const SceneFile& view) {
    const auto tree = TypeParam::build(view.scene, {});
    const auto forwards = TypeParam::front_to_back(tree, *view.camera);
    const auto backwards = TypeParam::back_to_front(tree, *view.camera);
    for (std::size_t limit = 1; limit <= forwards.size(); ++limit) {
      const auto end = static_cast<std::ptrdiff_t>(limit);
      const auto some = TypeParam::front_to_back(tree, *view.camera, limit);
      HALFSPACE_LAW(std::vector(forwards.begin(), forwards.begin() + end) ==
                    some);
      const auto others = TypeParam::back_to_front(tree, *view.camera, limit);
      HALFSPACE_LAW(std::vector(backwards.begin(), backwards.begin() + end) ==
                    others);
    }
  });
}

}  // namespace
}  // namespace halfspace
