#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "adapters/both.hpp"
#include "definition/definition.hpp"
#include "halfspace/fast/image/depth_sort.hpp"
#include "halfspace/ref/depth_sort.hpp"
#include "laws/law.hpp"

/// The laws of depth sort (S3.9).
namespace halfspace {
namespace {

/// What the laws look at: how often a case was met.
struct Sorted {
  std::size_t moves = 0;
  std::size_t cuts = 0;
};

struct RefDepthSort : Ref {
  static Tree list(const SceneFile& view, Sorted& sorted) {
    ref::DepthSort sort = ref::depth_sort(view.scene, *view.camera);
    sorted.moves += sort.moves;
    sorted.cuts += sort.cuts;
    return std::move(sort.list);
  }
  static Image paint(const SceneFile& view, const Tree& list,
                     const ImageOptions& options) {
    return image_of(ref::paint(view.scene, list, *view.camera, options));
  }
};

struct FastDepthSort : Fast {
  static Tree list(const SceneFile& view, Sorted& sorted) {
    fast::DepthSort sort = fast::depth_sort(view.scene, *view.camera);
    sorted.moves += sort.moves;
    sorted.cuts += sort.cuts;
    return {std::move(sort.list), view.scene};
  }
  static Image paint(const SceneFile& view, const Tree& list,
                     const ImageOptions& options) {
    auto image = fast::paint(view.scene, list.tree, *view.camera, options);
    return {std::move(image.items), std::move(image.colors),
            image.pixels_painted};
  }
};

template <class Impl>
class S3DepthSort : public ::testing::Test {};
using DepthSortImplementations = ::testing::Types<RefDepthSort, FastDepthSort>;
TYPED_TEST_SUITE(S3DepthSort, DepthSortImplementations);

using ListedFragments = std::vector<FragmentName>;

/// Each polygon is there as a whole, or not at all and covers no sample.
void expect_whole_polygons(const SceneFile& view,
                           const ListedFragments& listed) {
  std::map<PolygonId, definition::Area> areas;
  for (const FragmentName& fragment : listed) {
    auto& area = areas[fragment.source];
    area =
        area + definition::area_of(definition::points_of(view.scene, fragment));
  }
  for (std::size_t p = 0; p < view.scene.polygon_count(); ++p) {
    const auto id = static_cast<PolygonId>(p);
    const FragmentName whole = definition::whole(view.scene, id);
    if (areas.count(id) > 0) {
      HALFSPACE_LAW(areas[id] == definition::area_of(
                                     definition::points_of(view.scene, whole)));
      continue;
    }
    const auto seen = definition::project(
        definition::facet_of(view.scene, whole), *view.camera, false);
    for (std::int32_t j = 0; j < view.camera->data().height_px; ++j) {
      for (std::int32_t i = 0; i < view.camera->data().width_px; ++i)
        HALFSPACE_LAW(!definition::covers(seen, i, j));
    }
  }
}

/// No fragment hides an earlier one; how many pairs were compared.
std::size_t expect_front_to_back(const SceneFile& view,
                                 const ListedFragments& listed) {
  std::vector<definition::Projection> seen;
  for (const FragmentName& name : listed) {
    seen.push_back(definition::project(definition::facet_of(view.scene, name),
                                       *view.camera, false));
  }
  std::size_t contests = 0;
  for (std::int32_t j = 0; j < view.camera->data().height_px; ++j) {
    for (std::int32_t i = 0; i < view.camera->data().width_px; ++i) {
      std::size_t last = seen.size();
      for (std::size_t k = 0; k < seen.size(); ++k) {
        if (!definition::covers(seen[k], i, j)) continue;
        if (last < seen.size()) {
          const int depth =
              definition::compare_depth(seen[last], seen[k], i, j);
          HALFSPACE_LAW(depth < 0 ||
                        (depth == 0 && listed[last].source < listed[k].source));
          ++contests;
        }
        last = k;
      }
    }
  }
  return contests;
}

TYPED_TEST(S3DepthSort, L15NoListedFragmentIsHiddenByALaterOne) {
  Sorted sorted;
  std::size_t contests = 0;
  law::for_all_views([&](const SceneFile& view) {
    const auto list = TypeParam::list(view, sorted);
    const ListedFragments listed = TypeParam::front_to_back(list, *view.camera);
    expect_whole_polygons(view, listed);
    contests += expect_front_to_back(view, listed);
  });
  EXPECT_GT(contests, 1000u);
  EXPECT_GT(sorted.moves, 100u);
  EXPECT_GT(sorted.cuts, 100u);
}

TYPED_TEST(S3DepthSort, L16DepthSortFeedsTheSameImage) {
  Sorted sorted;
  std::size_t lit = 0;
  law::for_all_views([&](const SceneFile& view) {
    const auto list = TypeParam::list(view, sorted);
    const Image expected =
        oracle::zbuffer(view.scene, *view.camera, view.options);
    for (const Image& image :
         {TypeParam::render(view.scene, list, *view.camera, view.options),
          TypeParam::paint(view, list, view.options)}) {
      HALFSPACE_LAW(image.items == expected.items);
      HALFSPACE_LAW(image.colors == expected.colors);
      lit += image.pixels_painted;
    }
  });
  EXPECT_GT(lit, 1000u);
}

}  // namespace
}  // namespace halfspace
