#include <algorithm>
#include <type_traits>

#include "adapters/both.hpp"
#include "adapters/looks.hpp"
#include "adapters/scenes.hpp"
#include "definition/definition.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/painter.hpp"
#include "halfspace/fast/shade/back_faces.hpp"
#include "halfspace/ref/shade.hpp"
#include "laws/changed_views.hpp"
#include "laws/law.hpp"

namespace halfspace {
namespace {

constexpr int kMarkedViews = 150;

template <class Impl>
class S5Color : public ::testing::Test {};
TYPED_TEST_SUITE(S5Color, Implementations);

/// A view with corner colours, in Gouraud shading.
SceneFile gouraud(const SceneFile& view) {
  SceneFile changed = with_corner_colors(view);
  changed.options.shading = Shading::kGouraud;
  return changed;
}

TYPED_TEST(S5Color, L12ColoursAreThoseOfTheItemsSeen) {
  std::size_t between = 0;
  law::for_all_views([&](const SceneFile& original) {
    SceneFile view = gouraud(original);
    view.options.background = {1, 2, 3};
    const Image smooth = picture<TypeParam>(view);
    view.options.shading = Shading::kFlat;
    const Image flat = picture<TypeParam>(view);
    HALFSPACE_LAW(flat.items == smooth.items);
    for (std::size_t k = 0; k < flat.items.pixels.size(); ++k) {
      const PolygonId id = flat.items.pixels[k];
      if (id == kBackground) {
        HALFSPACE_LAW(flat.colors.pixels[k] == view.options.background);
        HALFSPACE_LAW(smooth.colors.pixels[k] == view.options.background);
        continue;
      }
      HALFSPACE_LAW(flat.colors.pixels[k] == view.scene.color(id));
      const auto corners = view.scene.corner_colors(id);
      for (const auto channel : {&Rgb::r, &Rgb::g, &Rgb::b}) {
        const auto [least, most] = std::minmax_element(
            corners.begin(), corners.end(), [&](const Rgb& a, const Rgb& b) {
              return a.*channel < b.*channel;
            });
        const std::uint8_t value = smooth.colors.pixels[k].*channel;
        HALFSPACE_LAW((*least).*channel <= value);
        HALFSPACE_LAW(value <= (*most).*channel);
        between += (*least).*channel < value && value < (*most).*channel;
      }
    }
  });
  EXPECT_GT(between, 1000u);
}

TYPED_TEST(S5Color, L13GouraudIsTheExactValueRoundedHalfUp) {
  std::size_t compared = 0;
  law::for_all_views([&](const SceneFile& original) {
    const SceneFile view = gouraud(original);
    const ColorImage expected =
        definition::color_image(view.scene, *view.camera, view.options);
    const Image image = picture<TypeParam>(view);
    HALFSPACE_LAW(image.colors == expected);
    HALFSPACE_LAW(
        oracle::raycast(view.scene, *view.camera, view.options).colors ==
        expected);
    // Alone a triangle is not cut; where it is seen, its colours are the same.
    for (const PolygonId id : ids_of(view.scene)) {
      const Image alone =
          picture<TypeParam>(with_scene(view, chosen(view.scene, {id})));
      for (std::size_t k = 0; k < expected.pixels.size(); ++k) {
        if (image.items.pixels[k] != id) continue;
        HALFSPACE_LAW(alone.colors.pixels[k] == expected.pixels[k]);
        ++compared;
      }
    }
  });
  EXPECT_GT(compared, 1000u);
}

/// What a polygon alone gives: where it is, how deep, and in which colours.
struct Layer {
  PolygonId id = 0;
  definition::Projection depth;
  ItemImage items;
  ColorImage colors;
};

std::vector<Layer> layers_of(const SceneFile& view) {
  std::vector<Layer> layers;
  for (const PolygonId id : ids_of(view.scene)) {
    const Scene alone = chosen(view.scene, {id});
    layers.push_back(
        {id,
         definition::project(definition::facet_of(
                                 view.scene, definition::whole(view.scene, id)),
                             *view.camera, view.options.cull),
         definition::item_image(alone, *view.camera, view.options),
         definition::color_image(alone, *view.camera, view.options)});
  }
  return layers;
}

/// x / 255 rounded half up: the greatest v with v - 1/2 <= x / 255.
std::uint8_t nearest_255th(std::int32_t x) {
  std::int32_t v = 0;
  while (510 * (v + 1) <= 2 * x + 255) ++v;
  return static_cast<std::uint8_t>(v);
}

constexpr Rgb kMark = {255, 130, 7};

/// The mark where a polygon has that colour.
Rgb marked_color(const Rgb& before) {
  const int light = std::max({before.r, before.g, before.b});
  // The v next to m (255 + light) / 510, the greater of two.
  const auto dimmed = [light](int m) {
    int v = 0;
    while (510 * (2 * v + 1) <= 2 * m * (255 + light)) ++v;
    return static_cast<std::uint8_t>(v);
  };
  return {dimmed(kMark.r), dimmed(kMark.g), dimmed(kMark.b)};
}

/// The transparent image from its definition, pixel by pixel. Polygons that are
/// `behind`, if that says so of any, have the mark's colour.
ColorImage blended(const SceneFile& view, const std::vector<Layer>& layers,
                   std::int32_t alpha, std::size_t& deep,
                   const std::vector<bool>& behind = {}) {
  ColorImage image((*view.camera)->width_px, (*view.camera)->height_px,
                   view.options.background);
  for (std::int32_t j = 0; j < image.height_px; ++j) {
    for (std::int32_t i = 0; i < image.width_px; ++i) {
      std::vector<const Layer*> here;
      for (const Layer& layer : layers) {
        if (layer.items.at(i, j) != kBackground) here.push_back(&layer);
      }
      std::sort(here.begin(), here.end(), [&](const Layer* a, const Layer* b) {
        const int order = definition::compare_depth(a->depth, b->depth, i, j);
        return order != 0 ? order > 0 : a->id > b->id;
      });
      if (here.size() > 2) ++deep;
      for (const Layer* layer : here) {
        Rgb own = layer->colors.at(i, j);
        if (!behind.empty() && behind[static_cast<std::size_t>(layer->id)])
          own = marked_color(own);
        for (const auto channel : {&Rgb::r, &Rgb::g, &Rgb::b}) {
          std::uint8_t& value = image.at(i, j).*channel;
          value = nearest_255th(alpha * (own.*channel) + (255 - alpha) * value);
        }
      }
    }
  }
  return image;
}

TYPED_TEST(S5Color, L14TransparentPolygonsAreBlendedFromTheFarthest) {
  std::size_t deep = 0;
  law::for_all_views([&](const SceneFile& original) {
    SceneFile view = gouraud(original);
    view.options.background = {1, 2, 200};
    const std::vector<Layer> layers = layers_of(view);
    const Image opaque = picture<TypeParam>(view);
    for (const int alpha : {0, 100, 255}) {
      const ColorImage expected = blended(view, layers, alpha, deep);
      for (const RootRule rule : {RootRule::kFirst, RootRule::kH4}) {
        const Image image = TypeParam::blend(
            view.scene, TypeParam::build(view.scene, {.rule = rule}),
            *view.camera, view.options, static_cast<std::uint8_t>(alpha));
        HALFSPACE_LAW(image.colors == expected);
        HALFSPACE_LAW(image.items == opaque.items);
        HALFSPACE_LAW(alpha != 255 || image.colors == opaque.colors);
      }
      if constexpr (!std::is_same_v<TypeParam, Ref>) {
        for (const std::size_t leaf_size : {2u, 500u}) {
          fast::DisplayTreeOptions options;
          options.leaf_size = leaf_size;
          options.threads = 1;
          const auto image = fast::blend(
              view.scene, fast::build_display_tree(view.scene, options),
              *view.camera, view.options, static_cast<std::uint8_t>(alpha));
          HALFSPACE_LAW(image.colors == expected);
          HALFSPACE_LAW(image.items == opaque.items);
        }
      }
    }
  });
  EXPECT_GT(deep, 1000u);
}

template <class Impl>
void mark_back_faces(const SceneFile& view, const Rgb& mark, Image& image) {
  if constexpr (std::is_same_v<Impl, Ref>) {
    ref::mark_back_faces(view.scene, *view.camera, image.items, mark,
                         image.colors);
  } else {
    fast::mark_back_faces(view.scene, *view.camera, image.items, mark, 2,
                          image.colors);
  }
}

/// By polygon: whether there is nothing of it where culling is asked for.
std::vector<bool> culled(const SceneFile& view) {
  std::vector<bool> result;
  ImageOptions options = view.options;
  options.cull = true;
  for (const PolygonId id : ids_of(view.scene)) {
    const ItemImage alone =
        definition::item_image(chosen(view.scene, {id}), *view.camera, options);
    result.push_back(
        std::all_of(alone.pixels.begin(), alone.pixels.end(),
                    [](PolygonId seen) { return seen == kBackground; }));
  }
  return result;
}

TYPED_TEST(S5Color, L21AMarkColoursWhatCullingWouldLeaveOut) {
  std::size_t marked = 0, unmarked = 0;
  law::for_all_views([&](const SceneFile& original) {
    SceneFile view = gouraud(original);
    view.options.cull = false;
    const Image plain = picture<TypeParam>(view);
    Image image = plain;
    mark_back_faces<TypeParam>(view, kMark, image);
    HALFSPACE_LAW(image.items == plain.items);
    const std::vector<bool> is_culled = culled(view);
    for (std::size_t k = 0; k < plain.items.pixels.size(); ++k) {
      const PolygonId id = plain.items.pixels[k];
      const Rgb before = plain.colors.pixels[k];
      if (id == kBackground || !is_culled[static_cast<std::size_t>(id)]) {
        HALFSPACE_LAW(image.colors.pixels[k] == before);
        ++unmarked;
        continue;
      }
      HALFSPACE_LAW(image.colors.pixels[k] == marked_color(before));
      ++marked;
    }
    for (const Image& seen : looks_of<TypeParam>(view, {kOpaque, 1, kMark})) {
      HALFSPACE_LAW(seen.items == image.items);
      HALFSPACE_LAW(seen.colors == image.colors);
    }
  });
  EXPECT_GT(marked, 1000u);
  EXPECT_GT(unmarked, 1000u);
}

TYPED_TEST(S5Color, L23TransparentBackFacesHaveTheMark) {
  std::size_t marked = 0, deep = 0;
  law::for_all_views(
      [&](const SceneFile& original) {
        SceneFile view = gouraud(original);
        view.options.cull = false;
        const std::uint64_t seed = view.scene.data().vertices.size();
        if (seed % 3 == 0) view.options.shading = Shading::kFlat;
        const std::vector<Layer> layers = layers_of(view);
        const std::vector<bool> behind = culled(view);
        for (const std::uint8_t alpha : {std::uint8_t{40}, std::uint8_t{200}}) {
          const ColorImage expected =
              blended(view, layers, alpha, deep, behind);
          marked += expected != blended(view, layers, alpha, deep);
          for (const Image& image :
               looks_of<TypeParam>(view, {alpha, 1, kMark}))
            HALFSPACE_LAW(image.colors == expected);
        }
      },
      kMarkedViews);
  EXPECT_GT(marked, 100u);
}

}  // namespace
}  // namespace halfspace
