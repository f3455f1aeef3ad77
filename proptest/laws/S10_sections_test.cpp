#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include "adapters/both.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/image/screens.hpp"
#include "halfspace/fast/painter.hpp"
#include "halfspace/fast/ray.hpp"
#include "halfspace/fast/render.hpp"
#include "halfspace/ref/ray.hpp"
#include "halfspace/ref/screens.hpp"
#include "halfspace/splitmix.hpp"
#include "laws/changed_views.hpp"
#include "laws/frames/cap_looks.hpp"
#include "laws/law.hpp"

/// Laws of clip planes and caps (S10).
namespace halfspace {
namespace {

using definition::Fraction;
using definition::Integer;

constexpr int kClippedViews = 300;

constexpr ScreenKind kScreens[] = {ScreenKind::kList, ScreenKind::kBsp1,
                                   ScreenKind::kQuad, ScreenKind::kBsp2};

std::optional<Int128> to_int128(const Integer& value) {
  if (abs(value) >> 126 != 0) return std::nullopt;
  const Integer size = abs(value);
  const auto high = static_cast<std::uint64_t>(size >> 64);
  const auto low = static_cast<std::uint64_t>(size & ~std::uint64_t{0});
  const Int128 result = (Int128{high} << 64) + low;
  return value < 0 ? -result : result;
}

/// A plane that polygons lie in, or touch, or that is any: by a number.
std::optional<ClipPlane> plane_of(const Scene& scene, std::uint64_t number) {
  const auto count = static_cast<std::uint64_t>(scene.polygon_count());
  const auto id = static_cast<PolygonId>(mix(number) % count);
  const GridPoint& p = scene.point(scene.corners(id)[mix(number + 1) % 3]);
  const Int128 sign = number % 2 == 0 ? 1 : -1;
  switch (mix(number + 2) % 4) {
    case 0: {
      const definition::Plane own = definition::plane_of(scene, id);
      const auto a = to_int128(own.a), b = to_int128(own.b),
                 c = to_int128(own.c), d = to_int128(own.d);
      if (!a || !b || !c || !d) return std::nullopt;
      return ClipPlane{sign * *a, sign * *b, sign * *c, sign * *d};
    }
    case 1:
      return ClipPlane{sign, 0, 0, -sign * p.x};
    case 2:
      return ClipPlane{0, 2 * sign, 0, -sign * (2 * Int128{p.y} + 1)};
    default:
      return ClipPlane{
          sign, -2 * sign, 3 * sign,
          -sign * (Int128{p.x} - 2 * Int128{p.y} + 3 * Int128{p.z})};
  }
}

std::vector<ClipPlane> clips_of(const SceneFile& view, std::uint64_t seed) {
  std::vector<ClipPlane> planes;
  if (view.scene.polygon_count() == 0) return planes;
  const auto count = 1 + mix(seed) % 3;
  for (std::uint64_t k = 0; k < count; ++k) {
    if (const auto plane = plane_of(view.scene, mix(seed + k)))
      planes.push_back(*plane);
  }
  const auto made = make_clips(planes, view.scene.grid_bits());
  return made ? *made : std::vector<ClipPlane>();
}

std::uint64_t seed_of(const SceneFile& view) {
  std::uint64_t seed = view.scene.data().vertices.size();
  for (const GridPoint& p : view.scene.data().vertices) {
    seed = mix(seed + static_cast<std::uint64_t>(p.x + 3 * p.y + 7 * p.z));
  }
  return seed;
}

/// The view with clip planes, or as it is where a saved one has them.
SceneFile clipped(const SceneFile& view) {
  SceneFile result = view;
  if (result.options.clips.empty())
    result.options.clips = clips_of(view, seed_of(view));
  return result;
}

definition::Plane to_plane(const ClipPlane& clip) {
  const auto big = [](Int128 value) {
    Integer result = static_cast<std::int64_t>(value >> 64);
    result <<= 64;
    return Integer(result + static_cast<std::uint64_t>(value));
  };
  return {big(clip.a), big(clip.b), big(clip.c), big(clip.d)};
}

Integer value_at(const definition::Plane& h, const definition::Point& p) {
  return h.a * p.x + h.b * p.y + h.c * p.z + h.d * p.w;
}

/// The polygon's corners, less what is on the plane's negative side.
std::vector<definition::Point> cut(const std::vector<definition::Point>& points,
                                   const definition::Plane& plane) {
  std::vector<definition::Point> left;
  bool some_positive = false;
  bool some_negative = false;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const definition::Point& p = points[k];
    const definition::Point& q = points[(k + 1) % points.size()];
    const Integer hp = value_at(plane, p);
    const Integer hq = value_at(plane, q);
    some_positive = some_positive || hp > 0;
    some_negative = some_negative || hp < 0;
    if (hp >= 0) left.push_back(p);
    if ((hp < 0 && hq > 0) || (hp > 0 && hq < 0)) {
      const Integer sign = hp < 0 ? -1 : 1;
      const auto at = [&](const Integer& x, const Integer& y) -> Integer {
        return sign * (hp * y - hq * x);
      };
      left.push_back({at(p.x, q.x), at(p.y, q.y), at(p.z, q.z), at(p.w, q.w)});
    }
  }
  if (some_negative && !some_positive) left.clear();
  return left;
}

/// The item image of the scene that is cut beforehand, by the definition.
ItemImage cut_beforehand(const SceneFile& view) {
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
    return images;
  }
  static Image samples(const SceneFile& view, std::int32_t count) {
    return Ref::image_of(
        ref::render_samples(view.scene, ref::build(view.scene, {}),
                            *view.camera, view.options, count));
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
    return images;
  }
  static Image samples(const SceneFile& view, std::int32_t count) {
    return image_of(fast::render_samples(view.scene, tree_of(view.scene, 3),
                                         *view.camera, view.options, count));
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
        const ItemImage expected = cut_beforehand(view);
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

/// Closed scenes: boxes within boxes, cubes that touch, and soups.
generate::Views closed_views() {
  return rc::gen::oneOf(generate::nested_solids(), generate::touching_solids());
}

/// Calls the property for views of closed scenes with clip planes and caps.
void for_all_capped(const std::function<void(const SceneFile&)>& property) {
  law::for_all(closed_views(), kClippedViews, [&](const SceneFile& whole) {
    if (!bad_edges(whole.scene).empty()) return;
    SceneFile view = clipped(whole);
    if (!view.options.caps)
      view.options.caps = CapStyle{{9, 8, 7}, Rgb{1, 2, 3}};
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

/// The winding number next to a point of the plane, on its positive side;
/// nothing where another polygon's plane holds the point.
std::optional<int> winding_beside(const std::vector<definition::Facet>& facets,
                                  const definition::Point& p,
                                  const definition::Plane& plane) {
  Fraction step = 1;
  for (const definition::Facet& facet : facets) {
    const definition::Plane& h = facet.support;
    const Fraction value = Fraction(value_at(h, p)) / Fraction(p.w);
    const Fraction slope =
        Fraction(Integer(h.a * plane.a + h.b * plane.b + h.c * plane.c));
    if (value == 0) {
      const bool same = h.a * plane.b == h.b * plane.a &&
                        h.b * plane.c == h.c * plane.b &&
                        h.a * plane.c == h.c * plane.a;
      if (!same) return std::nullopt;
      continue;
    }
    if (slope == 0) continue;
    const Fraction t = -value / slope;
    if (t > 0 && t / 2 < step) step = t / 2;
  }
  const Fraction q[3] = {
      Fraction(p.x) / Fraction(p.w) + step * Fraction(plane.a),
      Fraction(p.y) / Fraction(p.w) + step * Fraction(plane.b),
      Fraction(p.z) / Fraction(p.w) + step * Fraction(plane.c)};
  Integer w = 1;
  for (const Fraction& x : q) w = lcm(w, denominator(x));
  const auto whole = [&](const Fraction& x) -> Integer {
    return numerator(x) * (w / denominator(x));
  };
  return definition::winding(facets,
                             {whole(q[0]), whole(q[1]), whole(q[2]), w});
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

/// The view, so many times as large, and its clip planes with it.
std::optional<SceneFile> magnified_section(const SceneFile& view,
                                           std::int32_t samples) {
  auto large = magnified(view, samples);
  if (!large) return std::nullopt;
  for (ClipPlane& clip : large->options.clips) {
    if (clip.d > (Int128{1} << 120) || -clip.d > (Int128{1} << 120))
      return std::nullopt;
    clip.d *= samples;
  }
  const auto made = make_clips(large->options.clips, large->scene.grid_bits());
  if (!made || made->size() != view.options.clips.size()) return std::nullopt;
  large->options.clips = *made;
  return large;
}

/// The mean of the samples of pixel (i, j) of a flat image that is so many
/// times as large; stripes of caps are as many times as wide (S10.4).
Rgb mean_of_samples(const SceneFile& view, const Image& large,
                    std::int32_t samples, std::int32_t i, std::int32_t j) {
  const auto count = static_cast<PolygonId>(view.scene.polygon_count());
  int sum[3] = {};
  for (std::int32_t s = 0; s < samples * samples; ++s) {
    const std::int32_t x = i * samples + s % samples;
    const std::int32_t y = j * samples + s / samples;
    const PolygonId item = large.items.at(x, y);
    const Rgb color =
        item < count
            ? large.colors.at(x, y)
            : stripe_color(view.options, static_cast<std::size_t>(item - count),
                           x, y, samples);
    sum[0] += color.r;
    sum[1] += color.g;
    sum[2] += color.b;
  }
  const int all = samples * samples;
  const auto mean = [&](int channel) {
    return static_cast<std::uint8_t>((2 * channel + all) / (2 * all));
  };
  return {mean(sum[0]), mean(sum[1]), mean(sum[2])};
}

/// Compares an image of samples with the larger one; the samples that differ
/// from the first of their pixel.
template <class Impl>
std::size_t expect_means(const SceneFile& section) {
  SceneFile view = section;
  view.options.shading = Shading::kFlat;
  if (view.options.clips.empty()) return 0;
  const std::int32_t samples = 2 << (seed_of(view) % 3);
  const auto larger = magnified_section(view, samples);
  if (!larger) return 0;
  const Image large =
      oracle::zbuffer(larger->scene, *larger->camera, larger->options);
  const Image image = Impl::samples(view, samples);
  HALFSPACE_LAW(image.items == large.items);
  std::size_t mixed = 0;
  for (std::int32_t j = 0; j < image.colors.height_px; ++j) {
    for (std::int32_t i = 0; i < image.colors.width_px; ++i) {
      HALFSPACE_LAW(image.colors.at(i, j) ==
                    mean_of_samples(view, large, samples, i, j));
      mixed +=
          image.items.at(i * samples, j * samples) !=
                  image.items.at((i + 1) * samples - 1, (j + 1) * samples - 1)
              ? 1u
              : 0u;
    }
  }
  return mixed;
}

constexpr int kSampledViews = 150;

TYPED_TEST(S10Sections, L5SamplesOfSectionsAreALargerImages) {
  std::size_t mixed = 0;
  law::for_all_views(
      [&](const SceneFile& whole) {
        SceneFile view = clipped(whole);
        view.options.caps = std::nullopt;
        mixed += expect_means<TypeParam>(view);
      },
      kSampledViews);
  EXPECT_GT(mixed, 150u);
}

TYPED_TEST(S10Sections, L5SamplesOfCapsAreALargerImages) {
  std::size_t mixed = 0;
  law::for_all(closed_views(), kSampledViews, [&](const SceneFile& whole) {
    if (!bad_edges(whole.scene).empty()) return;
    SceneFile view = clipped(whole);
    view.options.caps = CapStyle{{9, 8, 7}, Rgb{201, 102, 3}};
    if (seed_of(view) % 2 == 0) tell_parts_apart(view);
    mixed += expect_means<TypeParam>(view);
  });
  EXPECT_GT(mixed, 100u);
}

/// The view with the polygons of one part alone.
SceneFile only_part(const SceneFile& view,
                    const std::vector<std::uint32_t>& part_of,
                    std::uint32_t part) {
  const Scene& scene = view.scene;
  SceneData data;
  data.unit = scene.unit();
  data.grid_bits = scene.grid_bits();
  data.vertices = scene.data().vertices;
  for (const PolygonId id : ids_of(scene)) {
    if (part_of[static_cast<std::size_t>(id)] != part) continue;
    const auto corners = scene.corners(id);
    data.corners.insert(data.corners.end(), corners.begin(), corners.end());
    data.first_corner.push_back(
        static_cast<std::uint32_t>(data.corners.size()));
    data.colors.push_back(scene.color(id));
  }
  return with_scene(view, *make_scene(std::move(data)));
}

TYPED_TEST(S10Sections, L8PartsAreToldApartByTheCapsOfEachAlone) {
  std::size_t of_one = 0;
  std::size_t of_several = 0;
  law::check(160, [&] {
    const auto number =
        *rc::gen::resize(100, rc::gen::inRange<std::uint64_t>(0, 1u << 20));
    const SceneFile view =
        cut_boxes(number, 2 + static_cast<int>(number % 3), 10, 8);
    const ItemImage without = TypeParam::render(view);
    SceneFile apart = view;
    tell_parts_apart(apart);
    const auto& part_of = apart.options.parts->part_of;
    const auto parts = static_cast<std::uint32_t>(apart.options.parts->count());
    std::vector<ItemImage> alone;
    std::vector<PolygonId> alone_count;
    for (std::uint32_t part = 0; part < parts; ++part) {
      const SceneFile one = only_part(view, part_of, part);
      alone.push_back(TypeParam::render(one));
      alone_count.push_back(static_cast<PolygonId>(one.scene.polygon_count()));
    }
    const Image image = TypeParam::samples(apart, 1);
    const auto count = static_cast<PolygonId>(view.scene.polygon_count());
    for (std::int32_t j = 0; j < without.height_px; ++j) {
      for (std::int32_t i = 0; i < without.width_px; ++i) {
        const PolygonId item = image.items.at(i, j);
        if (without.at(i, j) < count) {
          HALFSPACE_LAW(item == without.at(i, j));
          continue;
        }
        std::vector<std::uint32_t> inside;
        for (std::uint32_t part = 0; part < parts; ++part) {
          if (alone[part].at(i, j) >= alone_count[part]) inside.push_back(part);
        }
        HALFSPACE_LAW(!inside.empty());
        const std::uint32_t part = inside.size() == 1 ? inside[0] : parts;
        HALFSPACE_LAW(item == count + static_cast<PolygonId>(16 * part));
        HALFSPACE_LAW(image.colors.at(i, j) ==
                      stripe_color(apart.options,
                                   static_cast<std::size_t>(item - count), i, j,
                                   1));
        ++(inside.size() == 1 ? of_one : of_several);
      }
    }
  });
  EXPECT_GT(of_one, 300u);
  EXPECT_GT(of_several, 100u);
}

}  // namespace
}  // namespace halfspace
