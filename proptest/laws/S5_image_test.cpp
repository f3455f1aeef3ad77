#include <algorithm>
#include <numeric>
#include <set>

#include "adapters/both.hpp"
#include "adapters/scenes.hpp"
#include "definition/definition.hpp"
#include "laws/changed_views.hpp"
#include "laws/law.hpp"

namespace halfspace {
namespace {

template <class Impl>
class S5Image : public ::testing::Test {};
TYPED_TEST_SUITE(S5Image, Implementations);

std::size_t pixels_with_polygons(const ItemImage& items) {
  return static_cast<std::size_t>(
      std::count_if(items.pixels.begin(), items.pixels.end(),
                    [](PolygonId id) { return id != kBackground; }));
}

/// What the tests must have met for a comparison of images to mean something.
struct Contents {
  std::size_t seen = 0;     ///< pixels that see a polygon
  std::size_t hidden = 0;   ///< covered samples that are hidden
  std::size_t several = 0;  ///< images of at least three polygons

  void add(const SceneFile& view, const ItemImage& items) {
    seen += pixels_with_polygons(items);
    const std::set<PolygonId> ids(items.pixels.begin(), items.pixels.end());
    if (ids.size() > 3) ++several;
    std::size_t covered = 0;
    for (const PolygonId p : ids_of(view.scene)) {
      const auto mask = definition::coverage(
          definition::facet_of(view.scene, definition::whole(view.scene, p)),
          *view.camera, view.options.cull);
      covered += std::accumulate(mask.pixels.begin(), mask.pixels.end(),
                                 std::size_t{0});
    }
    hidden += covered - pixels_with_polygons(items);
  }
  void expect_enough() const {
    EXPECT_GT(seen, 3000u);
    EXPECT_GT(hidden, 1000u);
    EXPECT_GT(several, 20u);
  }
};

TYPED_TEST(S5Image, L1SpanAndPainterGiveTheSameImage) {
  Contents contents;
  law::for_all_views([&](const SceneFile& view) {
    const Image span = picture<TypeParam>(view);
    const Image painter =
        oracle::paint(view.scene, *view.camera, view.options, {});
    HALFSPACE_LAW(span.items == painter.items);
    HALFSPACE_LAW(span.colors == painter.colors);
    // The dynamic screen sets no pixel twice, and none for nothing.
    HALFSPACE_LAW(span.pixels_painted == pixels_with_polygons(span.items));
    HALFSPACE_LAW(painter.pixels_painted >= span.pixels_painted);
    contents.add(view, span.items);
  });
  contents.expect_enough();
}

TYPED_TEST(S5Image, L2SpanAndZBufferGiveTheSameImage) {
  Contents contents;
  law::for_all_views([&](const SceneFile& view) {
    const Image span = picture<TypeParam>(view);
    const Image zbuffer =
        oracle::zbuffer(view.scene, *view.camera, view.options);
    HALFSPACE_LAW(span.items == zbuffer.items);
    HALFSPACE_LAW(span.colors == zbuffer.colors);
    contents.add(view, span.items);
  });
  contents.expect_enough();
}

TYPED_TEST(S5Image, L3SpanAndRayCastingGiveTheSameImage) {
  Contents contents;
  law::for_all_views([&](const SceneFile& view) {
    const Image span = picture<TypeParam>(view);
    const Image rays = oracle::raycast(view.scene, *view.camera, view.options);
    HALFSPACE_LAW(span.items == rays.items);
    HALFSPACE_LAW(span.colors == rays.colors);
    // And with the definition, which no implementation has a part in.
    HALFSPACE_LAW(span.items == definition::item_image(view.scene, *view.camera,
                                                       view.options));
    contents.add(view, span.items);
  });
  contents.expect_enough();
}

TYPED_TEST(S5Image, L4TheImageDoesNotDependOnTheTree) {
  std::size_t different_trees = 0;
  law::for_all_views([&](const SceneFile& view) {
    const auto first = TypeParam::build(view.scene, {});
    const Image image = picture<TypeParam>(view);
    for (int rule = 0; rule < 9; ++rule) {
      const BuildOptions options{static_cast<RootRule>(rule), 2, 7, 60};
      const auto tree = TypeParam::build(view.scene, options);
      if (TypeParam::name_of(tree) != TypeParam::name_of(first))
        ++different_trees;
      const Image other =
          TypeParam::render(view.scene, tree, *view.camera, view.options);
      HALFSPACE_LAW(other.items == image.items);
      HALFSPACE_LAW(other.colors == image.colors);
    }
    auto ids = ids_of(view.scene);
    for (const std::size_t stride : {1u, 3u, 7u}) {
      std::stable_sort(ids.begin(), ids.end(), [&](PolygonId a, PolygonId b) {
        const auto place = [&](PolygonId id) {
          return static_cast<std::size_t>(id) * stride % 11;
        };
        return place(a) > place(b);
      });
      auto tree = TypeParam::build(Scene(), {});
      for (const PolygonId id : ids) TypeParam::insert(tree, view.scene, id);
      HALFSPACE_LAW(
          TypeParam::render(view.scene, tree, *view.camera, view.options)
              .items == image.items);
    }
  });
  EXPECT_GT(different_trees, 1000u);
}

TYPED_TEST(S5Image, L5CullingLeavesOutWhatFacesAway) {
  std::size_t left_out = 0;
  law::for_all_views([&](const SceneFile& view) {
    std::vector<PolygonId> facing;
    for (const PolygonId id : ids_of(view.scene)) {
      const auto plane = definition::plane_of(view.scene, id);
      if (definition::side_of_eye(plane, *view.camera) >= 0)
        facing.push_back(id);
    }
    left_out += view.scene.polygon_count() - facing.size();
    for (const Shading shading : {Shading::kFlat, Shading::kGouraud}) {
      SceneFile culled = view;
      culled.options.cull = true;
      culled.options.shading = shading;
      SceneFile without = with_scene(view, chosen(view.scene, facing));
      without.options.cull = false;
      without.options.shading = shading;
      const Image image = picture<TypeParam>(culled);
      Image expected = picture<TypeParam>(without);
      for (PolygonId& id : expected.items.pixels) {
        if (id != kBackground) id = facing[static_cast<std::size_t>(id)];
      }
      HALFSPACE_LAW(image.items == expected.items);
      HALFSPACE_LAW(image.colors == expected.colors);
      HALFSPACE_LAW(
          image.items ==
          oracle::paint(view.scene, *view.camera, culled.options, {}).items);
      HALFSPACE_LAW(
          image.items ==
          oracle::zbuffer(view.scene, *view.camera, culled.options).items);
      HALFSPACE_LAW(
          image.items ==
          oracle::raycast(view.scene, *view.camera, culled.options).items);
    }
  });
  EXPECT_GT(left_out, 300u);
}

TYPED_TEST(S5Image, L6OfCoplanarPolygonsTheLowestIdIsSeen) {
  std::size_t contests = 0;
  law::for_all(
      generate::coincident_polygons(), law::kViews, [&](const auto& view) {
        const auto& camera = *view.camera;
        std::vector<Grid2<std::uint8_t>> masks;
        for (const PolygonId p : ids_of(view.scene)) {
          masks.push_back(definition::coverage(
              definition::facet_of(view.scene,
                                   definition::whole(view.scene, p)),
              camera, view.options.cull));
        }
        const ItemImage items = picture<TypeParam>(view).items;
        for (std::size_t k = 0; k < items.pixels.size(); ++k) {
          const PolygonId seen = items.pixels[k];
          if (seen == kBackground) continue;
          const auto plane = definition::plane_of(view.scene, seen);
          for (const PolygonId p : ids_of(view.scene)) {
            if (p == seen || masks[static_cast<std::size_t>(p)].pixels[k] == 0)
              continue;
            const auto points = definition::points_of(
                view.scene, definition::whole(view.scene, p));
            if (definition::relation(points, plane) != Relation::kCoincident)
              continue;
            HALFSPACE_LAW(seen < p);
            ++contests;
          }
        }
      });
  EXPECT_GT(contests, 300u);
}

TYPED_TEST(S5Image, L7NothingIsSeenAtOrBeforeTheNearDistance) {
  std::size_t kept = 0, lost = 0;
  law::for_all_views([&](const SceneFile& view) {
    CameraData data = view.camera->data();
    data.near.reset();
    const SceneFile far = with_camera(view, data);
    const ItemImage before = picture<TypeParam>(far).items;
    std::vector<definition::Projection> seen;
    for (const PolygonId p : ids_of(view.scene)) {
      seen.push_back(definition::project(
          definition::facet_of(view.scene, definition::whole(view.scene, p)),
          *far.camera, false));
    }
    for (const std::int64_t k : {1, 65536, 90000}) {
      data.near = k;
      const ItemImage after = picture<TypeParam>(with_camera(view, data)).items;
      const auto is_beyond = [&](PolygonId id, std::int32_t i, std::int32_t j) {
        const auto& p = seen[static_cast<std::size_t>(id)];
        const definition::Affine f{(p.num.c << kNearBits) - k * p.den.c,
                                   (p.num.x << kNearBits) - k * p.den.x,
                                   (p.num.y << kNearBits) - k * p.den.y};
        return definition::sign_at_sample(f, i, j) > 0;
      };
      for (std::int32_t j = 0; j < data.height_px; ++j) {
        for (std::int32_t i = 0; i < data.width_px; ++i) {
          const PolygonId old = before.at(i, j);
          const PolygonId now = after.at(i, j);
          HALFSPACE_LAW(now == kBackground || is_beyond(now, i, j));
          if (old == kBackground) continue;
          const bool stays = is_beyond(old, i, j);
          HALFSPACE_LAW(!stays || now == old);
          ++(stays ? kept : lost);
        }
      }
    }
  });
  EXPECT_GT(kept, 1000u);
  EXPECT_GT(lost, 1000u);
}

TYPED_TEST(S5Image, L8OtherIdsChangeTheImageByThoseIdsOnly) {
  std::size_t seen = 0;
  law::for_all_views([&](const SceneFile& view) {
    // Keep the first of polygons in one plane.
    std::vector<PolygonId> ids;
    for (const PolygonId p : ids_of(view.scene)) {
      const auto points =
          definition::points_of(view.scene, definition::whole(view.scene, p));
      const bool is_new =
          std::none_of(ids.begin(), ids.end(), [&](PolygonId q) {
            return definition::relation(points,
                                        definition::plane_of(view.scene, q)) ==
                   Relation::kCoincident;
          });
      if (is_new) ids.push_back(p);
    }
    const ItemImage image =
        picture<TypeParam>(with_scene(view, chosen(view.scene, ids))).items;
    auto other_ids = ids;
    std::reverse(other_ids.begin(), other_ids.end());
    if (!other_ids.empty()) {
      std::rotate(
          other_ids.begin(),
          other_ids.begin() + static_cast<std::ptrdiff_t>(other_ids.size() / 3),
          other_ids.end());
    }
    const ItemImage other =
        picture<TypeParam>(with_scene(view, chosen(view.scene, other_ids)))
            .items;
    for (std::size_t k = 0; k < image.pixels.size(); ++k) {
      const PolygonId a = image.pixels[k], b = other.pixels[k];
      HALFSPACE_LAW((a == kBackground) == (b == kBackground));
      if (a == kBackground) continue;
      HALFSPACE_LAW(ids[static_cast<std::size_t>(a)] ==
                    other_ids[static_cast<std::size_t>(b)]);
      ++seen;
    }
  });
  EXPECT_GT(seen, 1000u);
}

LatticeVector moved(const LatticeVector& v, Int128 k, const LatticeVector& d) {
  return {v.x + k * d.x, v.y + k * d.y, v.z + k * d.z};
}

TYPED_TEST(S5Image, L9ARectangleOfAnImageIsTheImageOfAMovedCamera) {
  law::for_all_views([](const SceneFile& view) {
    CameraData data = view.camera->data();
    const std::int32_t left = data.width_px / 3;
    const std::int32_t top = data.height_px / 2;
    data.s0 = moved(moved(data.s0, left, data.sx), top, data.sy);
    data.width_px = (data.width_px - left + 1) / 2;
    data.height_px = data.height_px - top;
    if (!make_camera(data, view.scene.grid_bits())) return;
    const Image all = picture<TypeParam>(view);
    const Image part = picture<TypeParam>(with_camera(view, data));
    for (std::int32_t j = 0; j < data.height_px; ++j) {
      for (std::int32_t i = 0; i < data.width_px; ++i) {
        HALFSPACE_LAW(part.items.at(i, j) == all.items.at(left + i, top + j));
        HALFSPACE_LAW(part.colors.at(i, j) == all.colors.at(left + i, top + j));
      }
    }
  });
}

TYPED_TEST(S5Image, L10MovingSceneAndCameraChangesNoPixel) {
  std::size_t moved_views = 0;
  law::for_all_views([&](const SceneFile& view) {
    SceneData scene = view.scene.data();
    CameraData camera = view.camera->data();
    for (GridPoint& p : scene.vertices) p = {p.x - 3, p.y + 5, p.z - 1};
    const LatticeVector by{-3, 5, -1};
    constexpr Int128 kStep = 1 << kLatticeBits;
    if (camera.perspective) camera.eye = moved(camera.eye, kStep, by);
    camera.s0 = moved(camera.s0, kStep, by);
    auto made = make_scene(std::move(scene));
    // A scene at the limits of its grid cannot move.
    if (!made || !make_camera(camera, view.scene.grid_bits())) return;
    const Image before = picture<TypeParam>(view);
    const Image after =
        picture<TypeParam>(with_camera(with_scene(view, *made), camera));
    HALFSPACE_LAW(after.items == before.items);
    HALFSPACE_LAW(after.colors == before.colors);
    ++moved_views;
  });
  EXPECT_GT(moved_views, 100u);
}

TYPED_TEST(S5Image, L11TheImagePlaneMayBeNearOrFar) {
  std::size_t views = 0;
  law::for_all_views([&](const SceneFile& view) {
    CameraData data = view.camera->data();
    data.near.reset();
    const Image image = picture<TypeParam>(with_camera(view, data));
    if (data.perspective) {
      // Three times as far, and as large.
      data.s0 = moved(moved(data.eye, -3, data.eye), 3, data.s0);
      data.sx = moved({}, 3, data.sx);
      data.sy = moved({}, 3, data.sy);
    } else {
      data.s0 = moved(data.s0, -2, data.eye);
    }
    if (!make_camera(data, view.scene.grid_bits())) return;
    const Image other = picture<TypeParam>(with_camera(view, data));
    HALFSPACE_LAW(other.items == image.items);
    HALFSPACE_LAW(other.colors == image.colors);
    ++views;
  });
  EXPECT_GT(views, 100u);
}

}  // namespace
}  // namespace halfspace
