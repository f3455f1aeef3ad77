#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include "adapters/both.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/image/depth_sort.hpp"
#include "halfspace/fast/image/screens.hpp"
#include "halfspace/fast/painter.hpp"
#include "halfspace/fast/ray.hpp"
#include "halfspace/fast/render.hpp"
#include "halfspace/ref/depth_sort.hpp"
#include "halfspace/ref/ray.hpp"
#include "halfspace/ref/screens.hpp"
#include "halfspace/splitmix.hpp"
#include "laws/changed_views.hpp"
#include "laws/frames/cap_looks.hpp"
#include "laws/frames/clipped_views.hpp"
#include "laws/frames/cut_beforehand.hpp"
#include "laws/law.hpp"

/// Laws of clip planes and caps (S10).
namespace halfspace {
namespace {

using cut_beforehand::cut;
using cut_beforehand::to_plane;
using cut_beforehand::value_at;
using cut_beforehand::winding_beside;
using definition::Fraction;
using definition::Integer;

constexpr int kClippedViews = 300;

constexpr ScreenKind kScreens[] = {ScreenKind::kList, ScreenKind::kBsp1,
                                   ScreenKind::kQuad, ScreenKind::kBsp2};

/// The item image of the scene that is cut beforehand, by the definition.
ItemImage image_cut_beforehand(const SceneFile& view) {
  std::vector<definition::Projection> polygons;
  const Scene& scene = view.scene;
  for (const PolygonId id : ids_of(scene)) {
    auto points = definition::points_of(scene, definition::whole(scene, id));
    for (const ClipPlane& clip : view.options.clips) {
      if (!points.empty()) points = cut(points, to_plane(clip));
    }
    polygons.emplace_back();
    polygons.back().nothing = true;
    if (!points.empty()) {
      polygons.back() = definition::project(definition::facet_of(points),
                                            *view.camera, view.options.cull);
    }
  }
  ItemImage items((*view.camera)->width_px, (*view.camera)->height_px,
                  kBackground);
  for (std::int32_t j = 0; j < items.height_px; ++j) {
    for (std::int32_t i = 0; i < items.width_px; ++i) {
      PolygonId& item = items.at(i, j);
      for (const PolygonId id : ids_of(scene)) {
        const auto& polygon = polygons[static_cast<std::size_t>(id)];
        if (polygon.nothing || !definition::covers(polygon, i, j)) continue;
        if (item == kBackground ||
            definition::compare_depth(
                polygon, polygons[static_cast<std::size_t>(item)], i, j) < 0)
          item = id;
      }
    }
  }
  return items;
}

struct RefSections {
  static ItemImage render(const SceneFile& view) {
    return ref::render(view.scene, ref::build(view.scene, {}), *view.camera,
                       view.options)
        .items;
  }
  static std::vector<Image> all_methods(const SceneFile& view) {
    BuildOptions other;
    other.rule = RootRule::kH4;
    const auto tree = ref::build(view.scene, other);
    const auto& [scene, camera, options] = view;
    std::vector<Image> images;
    images.push_back(Ref::image_of(ref::render(scene, tree, *camera, options)));
    images.push_back(Ref::image_of(ref::paint(scene, tree, *camera, options)));
    images.push_back(Ref::image_of(ref::zbuffer(scene, *camera, options)));
    images.push_back(Ref::image_of(ref::raycast(scene, *camera, options)));
    for (const ScreenKind kind : kScreens) {
      images.push_back(
          Ref::image_of(ref::render_on(scene, tree, *camera, options, kind)));
    }
    const auto sorted = ref::depth_sort(scene, *camera);
    images.push_back(
        Ref::image_of(ref::render(scene, sorted.list, *camera, options)));
    return images;
  }
  static PolygonId pick(const SceneFile& view, std::int32_t i, std::int32_t j) {
    return ref::pick(view.scene, *view.camera, view.options, i, j);
  }
};

struct FastSections {
  static Image image_of(fast::Rendering rendering) {
    return {std::move(rendering.items), std::move(rendering.colors),
            rendering.pixels_painted};
  }
  static fast::BspTree tree_of(const Scene& scene, std::size_t leaf_size) {
    fast::DisplayTreeOptions options;
    options.leaf_size = leaf_size;
    options.threads = 1;
    return fast::build_display_tree(scene, options);
  }
  static ItemImage render(const SceneFile& view) {
    return fast::render(view.scene, tree_of(view.scene, 8), *view.camera,
                        view.options)
        .items;
  }
  static std::vector<Image> all_methods(const SceneFile& view) {
    const auto& [scene, camera, options] = view;
    std::vector<Image> images;
    for (const std::size_t leaf : {1u, 3u, 500u}) {
      images.push_back(image_of(
          fast::render(scene, tree_of(scene, leaf), *camera, options)));
    }
    const auto plain = fast::build(scene, {});
    images.push_back(image_of(fast::render(scene, plain, *camera, options)));
    images.push_back(image_of(fast::paint(scene, plain, *camera, options)));
    fast::RenderOptions how;
    how.threads = 2;
    how.simd = fast::SimdLevel::kPortable;
    images.push_back(image_of(
        fast::render(scene, tree_of(scene, 8), *camera, options, how)));
    for (const ScreenKind kind : kScreens) {
      images.push_back(
          image_of(fast::render_on(scene, plain, *camera, options, kind)));
    }
    const auto sorted = fast::depth_sort(scene, *camera);
    images.push_back(
        image_of(fast::render(scene, sorted.list, *camera, options)));
    images.push_back(
        image_of(fast::paint(scene, sorted.list, *camera, options)));
    return images;
  }
  static PolygonId pick(const SceneFile& view, std::int32_t i, std::int32_t j) {
    return fast::pick(view.scene, tree_of(view.scene, 2), *view.camera,
                      view.options, i, j);
  }
};

template <class Impl>
class S10Sections : public ::testing::Test {};
using SectionImplementations = ::testing::Types<RefSections, FastSections>;
TYPED_TEST_SUITE(S10Sections, SectionImplementations);

TYPED_TEST(S10Sections, L1TheImageIsThatOfTheSceneCutBeforehand) {
  std::size_t changed = 0;
  law::for_all_views(
      [&](const SceneFile& whole) {
        SceneFile view = clipped(whole);
        view.options.caps = std::nullopt;
        const ItemImage expected = image_cut_beforehand(view);
        HALFSPACE_LAW(TypeParam::render(view) == expected);
        for (std::int32_t j = 0; j < expected.height_px; ++j) {
          for (std::int32_t i = 0; i < expected.width_px; ++i)
            HALFSPACE_LAW(TypeParam::pick(view, i, j) == expected.at(i, j));
        }
        SceneFile unclipped = view;
        unclipped.options.clips.clear();
        const bool differs = TypeParam::render(unclipped) != expected;
        const bool some =
            std::any_of(expected.pixels.begin(), expected.pixels.end(),
                        [](PolygonId id) { return id >= 0; });
        changed += differs && some ? 1 : 0;
      },
      kClippedViews);
  EXPECT_GT(changed, 15u);
}

/// Calls the property for views of closed scenes with clip planes and caps. In
/// three of four of those that had no planes the eye is on the side of the
/// first one that is cut away: most caps are seen from there.
void for_all_capped(const std::function<void(const SceneFile&)>& property) {
  law::for_all(closed_views(), kClippedViews, [&](const SceneFile& whole) {
    if (!bad_edges(whole.scene).empty()) return;
    SceneFile view = clipped(whole);
    if (!view.options.caps)
      view.options.caps = CapStyle{{9, 8, 7}, Rgb{1, 2, 3}};
    std::vector<ClipPlane>& planes = view.options.clips;
    if (whole.options.clips.empty() && !planes.empty() &&
        seed_of(view) / 2 % 4 != 0 &&
        definition::side_of_eye(to_plane(planes[0]), *view.camera) > 0) {
      const ClipPlane& first = planes[0];
      const ClipPlane other = {-first.a, -first.b, -first.c, -first.d};
      if (std::find(planes.begin(), planes.end(), other) == planes.end())
        planes[0] = other;
    }
    property(view);
  });
}

TYPED_TEST(S10Sections, L2AllMethodsAgree) {
  law::for_all_views(
      [](const SceneFile& whole) {
        SceneFile view = clipped(whole);
        view.options.caps = std::nullopt;
        const Image expected =
            oracle::zbuffer(view.scene, *view.camera, view.options);
        for (const Image& image : TypeParam::all_methods(view)) {
          HALFSPACE_LAW(image.items == expected.items);
          HALFSPACE_LAW(image.colors == expected.colors);
        }
      },
      kClippedViews);
}

TYPED_TEST(S10Sections, L2AllMethodsAgreeWithCaps) {
  std::size_t capped = 0;
  for_all_capped([&](const SceneFile& whole) {
    SceneFile view = whole;
    if (seed_of(view) % 2 == 0) tell_parts_apart(view);
    const Image expected =
        oracle::zbuffer(view.scene, *view.camera, view.options);
    for (const Image& image : TypeParam::all_methods(view)) {
      HALFSPACE_LAW(image.items == expected.items);
      HALFSPACE_LAW(image.colors == expected.colors);
    }
    const auto count = static_cast<PolygonId>(view.scene.polygon_count());
    for (std::int32_t j = 0; j < expected.items.height_px; ++j) {
      for (std::int32_t i = 0; i < expected.items.width_px; ++i) {
        capped += expected.items.at(i, j) >= count ? 1u : 0u;
        // A pick is an image of its own.
        if (i != j || i % 4 != 0) continue;
        HALFSPACE_LAW(TypeParam::pick(view, i, j) == expected.items.at(i, j));
      }
    }
  });
  EXPECT_GT(capped, 100u);
}

TYPED_TEST(S10Sections, L3OrderAndMultiplesOfPlanesDoNotMatter) {
  for_all_capped([](const SceneFile& view) {
    if (view.options.clips.empty()) return;
    std::vector<ClipPlane> planes = view.options.clips;
    std::reverse(planes.begin(), planes.end());
    planes.push_back(planes.front());
    planes.push_back(
        {3 * planes[0].a, 3 * planes[0].b, 3 * planes[0].c, 3 * planes[0].d});
    const auto made = make_clips(planes, view.scene.grid_bits());
    if (!made) return;  // three times is beyond the bits
    HALFSPACE_LAW(made->size() == view.options.clips.size());
    SceneFile other = view;
    other.options.clips = *made;
    const ItemImage expected = TypeParam::render(view);
    const ItemImage items = TypeParam::render(other);
    const auto count = static_cast<PolygonId>(view.scene.polygon_count());
    const auto last = static_cast<PolygonId>(made->size()) - 1;
    for (std::size_t k = 0; k < items.pixels.size(); ++k) {
      PolygonId item = items.pixels[k];
      if (item >= count) item = count + last - (item - count);
      HALFSPACE_LAW(item == expected.pixels[k]);
    }
  });
}

/// The point in which the centre of a pixel sees a plane, if it is in front.
std::optional<definition::Point> seen_at(const SceneFile& view,
                                         const definition::Plane& plane,
                                         std::int32_t i, std::int32_t j) {
  const CameraData& camera = (*view.camera).data();
  const auto big = [](Int128 value) {
    return Fraction(static_cast<std::int64_t>(value >> 40)) *
               Fraction(std::int64_t{1} << 40) +
           Fraction(static_cast<std::int64_t>(value & ((Int128{1} << 40) - 1)));
  };
  const auto at = [&](Int128 s0, Int128 sx, Int128 sy) -> Fraction {
    return big(s0) + Fraction(2 * i + 1) / 2 * big(sx) +
           Fraction(2 * j + 1) / 2 * big(sy);
  };
  Fraction s[3] = {at(camera.s0.x, camera.sx.x, camera.sy.x),
                   at(camera.s0.y, camera.sx.y, camera.sy.y),
                   at(camera.s0.z, camera.sx.z, camera.sy.z)};
  Fraction e[3] = {big(camera.eye.x), big(camera.eye.y), big(camera.eye.z)};
  Fraction origin[3], along[3];
  for (int a = 0; a < 3; ++a) {
    s[a] /= 256;
    e[a] /= 256;
    origin[a] = camera.perspective ? e[a] : s[a];
    along[a] = camera.perspective ? Fraction(s[a] - e[a]) : Fraction(-e[a]);
  }
  const Fraction slope = Fraction(plane.a) * along[0] +
                         Fraction(plane.b) * along[1] +
                         Fraction(plane.c) * along[2];
  const Fraction value = Fraction(plane.a) * origin[0] +
                         Fraction(plane.b) * origin[1] +
                         Fraction(plane.c) * origin[2] + Fraction(plane.d);
  if (slope == 0) return std::nullopt;
  const Fraction t = -value / slope;
  const Fraction near =
      camera.near ? Fraction(*camera.near) / 65536 : Fraction(0);
  if ((camera.perspective || camera.near) && t <= near) return std::nullopt;
  Fraction p[3];
  Integer w = 1;
  for (int a = 0; a < 3; ++a) {
    p[a] = origin[a] + t * along[a];
    w = lcm(w, denominator(p[a]));
  }
  const auto whole = [&](const Fraction& x) -> Integer {
    return numerator(x) * (w / denominator(x));
  };
  return definition::Point{whole(p[0]), whole(p[1]), whole(p[2]), w};
}

TYPED_TEST(S10Sections, L4CapsAreWhereTheSolidGoesOn) {
  std::size_t shown = 0;
  std::size_t not_shown = 0;
  for_all_capped([&](const SceneFile& whole) {
    SceneFile view = whole;
    if (view.options.clips.empty()) return;
    view.options.cull = false;
    view.options.clips.resize(1);
    const definition::Plane plane = to_plane(view.options.clips[0]);
    if (definition::side_of_eye(plane, *view.camera) == 0) return;
    std::vector<definition::Facet> facets;
    for (const PolygonId id : ids_of(view.scene)) {
      facets.push_back(
          definition::facet_of(view.scene, definition::whole(view.scene, id)));
    }
    SceneFile open = view;
    open.options.caps = std::nullopt;
    const ItemImage without = TypeParam::render(open);
    const ItemImage items = TypeParam::render(view);
    const auto cap = static_cast<PolygonId>(view.scene.polygon_count());
    for (std::int32_t j = 0; j < items.height_px; ++j) {
      for (std::int32_t i = 0; i < items.width_px; ++i) {
        const auto point = seen_at(view, plane, i, j);
        if (!point) continue;
        const auto winding = winding_beside(facets, *point, plane);
        if (!winding) continue;
        // From the removed side nothing is in front of the plane.
        const bool from_outside =
            definition::side_of_eye(plane, *view.camera) < 0;
        if (*winding <= 0) {
          HALFSPACE_LAW(items.at(i, j) != cap);
          ++not_shown;
        } else if (from_outside) {
          HALFSPACE_LAW(items.at(i, j) == cap);
          ++shown;
        } else if (items.at(i, j) != cap) {
          HALFSPACE_LAW(items.at(i, j) == without.at(i, j));
        }
      }
    }
  });
  EXPECT_GT(shown, 200u);
  EXPECT_GT(not_shown, 200u);
}

}  // namespace
}  // namespace halfspace
