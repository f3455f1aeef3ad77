#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "adapters/both.hpp"
#include "adapters/scenes.hpp"
#include "halfspace/fast/image/transparent_map.hpp"
#include "halfspace/fast/shade/color_forms.hpp"
#include "halfspace/ref/oracle/painter.hpp"
#include "halfspace/ref/shade.hpp"
#include "laws/law.hpp"
#include "laws/map/map_arcs.hpp"

/// Laws of the transparent map (S7.8) and of shaded regions (S7.9).
namespace halfspace {
namespace {

using map_arcs::Arcs;

constexpr int kTransparentMaps = 150;

struct RefTransparent {
  static Arcs arcs_of(const SceneFile& view,
                      const TransparentOptions& options) {
    return map_arcs::exact_arcs(
        ref::transparent_map(view.scene, *view.camera, options));
  }
};

struct FastTransparent {
  static Arcs arcs_of(const SceneFile& view,
                      const TransparentOptions& options) {
    const auto map = fast::transparent_map(
        view.scene, fast::build(view.scene, {}), *view.camera, options);
    HALFSPACE_LAW(map.has_value());
    return map_arcs::exact_arcs(*map);
  }
};

/// An alpha that differs from view to view.
TransparentOptions transparent_options(const SceneFile& view) {
  std::uint32_t sum = 7;
  for (const GridPoint& p : view.scene.data().vertices)
    sum = 31 * sum + static_cast<std::uint32_t>(p.x + 3 * p.y);
  return {view.options.cull, static_cast<std::uint8_t>(sum >> 7 & 255),
          view.options.background};
}

template <class Impl>
class S7Transparent : public ::testing::Test {};
using TransparentImplementations =
    ::testing::Types<RefTransparent, FastTransparent>;
TYPED_TEST_SUITE(S7Transparent, TransparentImplementations);

TYPED_TEST(S7Transparent, L10SamplesLieInTheRegionOfTheirColour) {
  std::size_t composed = 0;
  law::for_all_views(
      [&](const SceneFile& view) {
        const TransparentOptions options = transparent_options(view);
        const Arcs arcs = TypeParam::arcs_of(view, options);
        ImageOptions flat = view.options;
        flat.shading = Shading::kFlat;
        const ref::BspTree tree = ref::build(view.scene, {});
        const ref::Rendering image =
            ref::blend(view.scene, tree, *view.camera, flat, options.alpha);
        for (std::int32_t j = 0; j < image.items.height_px; ++j) {
          for (std::int32_t i = 0; i < image.items.width_px; ++i) {
            const std::int32_t key = map_arcs::key_at(arcs, i, j);
            const bool is_background = image.items.at(i, j) == kBackground;
            HALFSPACE_LAW((key == kBackgroundKey) == is_background);
            if (is_background) continue;
            HALFSPACE_LAW(color_of_key(key) == image.colors.at(i, j));
            if (color_of_key(key) != view.scene.color(image.items.at(i, j)))
              ++composed;
          }
        }
      },
      kTransparentMaps);
  EXPECT_GT(composed, 1000u);
}

TEST(S7TransparentAgree, RefAndFastGiveTheSameTransparentMap) {
  law::for_all_views(
      [](const SceneFile& view) {
        const TransparentOptions options = transparent_options(view);
        HALFSPACE_LAW(FastTransparent::arcs_of(view, options) ==
                      RefTransparent::arcs_of(view, options));
      },
      kTransparentMaps);
}

/// Alphas that differ from polygon to polygon.
TransparentOptions with_own_alphas(const SceneFile& view) {
  TransparentOptions options = transparent_options(view);
  std::uint32_t number = options.alpha;
  for (std::size_t p = 0; p < view.scene.polygon_count(); ++p) {
    number = 1664525 * number + 1013904223;
    options.alphas.push_back(static_cast<std::uint8_t>(number >> 24));
  }
  return options;
}

/// What a scene of these polygons alone shows, by its own ids.
ItemImage items_of(const SceneFile& view,
                   const std::vector<PolygonId>& chosen) {
  SceneData data = view.scene.data();
  data.corners.clear();
  data.corner_colors.clear();
  data.colors.clear();
  data.first_corner.assign(1, 0);
  for (const PolygonId p : chosen) {
    const auto corners = view.scene.corners(p);
    data.corners.insert(data.corners.end(), corners.begin(), corners.end());
    data.first_corner.push_back(
        static_cast<std::uint32_t>(data.corners.size()));
    data.colors.push_back(view.scene.color(p));
  }
  const Result<Scene> scene = make_scene(std::move(data));
  HALFSPACE_LAW(scene.has_value());
  ImageOptions flat = view.options;
  flat.shading = Shading::kFlat;
  return oracle::zbuffer(*scene, *view.camera, flat).items;
}

/// The order of S5.3 of two polygons in each pixel: 0 or 1 for the one that is
/// in front, by images of the two alone.
class PairOrder {
 public:
  explicit PairOrder(const SceneFile& view) : view_(view) {}
  bool before(PolygonId p, PolygonId q, std::int32_t i, std::int32_t j) {
    const std::pair key = std::minmax(p, q);
    const auto found = images_.find(key);
    const ItemImage& image =
        found != images_.end()
            ? found->second
            : images_.emplace(key, items_of(view_, {key.first, key.second}))
                  .first->second;
    return (image.at(i, j) == 0) == (p < q);
  }

 private:
  const SceneFile& view_;
  std::map<std::pair<PolygonId, PolygonId>, ItemImage> images_;
};

TYPED_TEST(S7Transparent, L12PolygonsAreComposedByTheirOwnAlphas) {
  std::size_t several = 0;
  law::for_all_views(
      [&](const SceneFile& view) {
        if (view.scene.polygon_count() > 24) return;
        const TransparentOptions options = with_own_alphas(view);
        const Arcs arcs = TypeParam::arcs_of(view, options);
        std::vector<ItemImage> alone;
        const auto count = static_cast<PolygonId>(view.scene.polygon_count());
        for (PolygonId p = 0; p < count; ++p)
          alone.push_back(items_of(view, {p}));
        PairOrder order(view);
        const CameraData& size = view.camera->data();
        for (std::int32_t k = 0; k < size.width_px * size.height_px; ++k) {
          const std::int32_t i = k % size.width_px;
          const std::int32_t j = k / size.width_px;
          std::vector<PolygonId> covering;
          for (PolygonId p = 0; p < count; ++p) {
            if (alone[static_cast<std::size_t>(p)].at(i, j) != kBackground)
              covering.push_back(p);
          }
          std::sort(covering.begin(), covering.end(),
                    [&](PolygonId p, PolygonId q) {
                      return p != q && order.before(q, p, i, j);
                    });
          Rgb color = options.background;
          for (const PolygonId p : covering) {
            color = composed_color(view.scene.color(p), color,
                                   options.alphas[static_cast<std::size_t>(p)]);
          }
          HALFSPACE_LAW(map_arcs::key_at(arcs, i, j) ==
                        (covering.empty() ? kBackgroundKey : color_key(color)));
          if (covering.size() > 1) ++several;
        }
      },
      kTransparentMaps);
  EXPECT_GT(several, 300u);
}

TEST(S7TransparentAgree, OwnAlphasGiveTheSameMapByRefAndFast) {
  law::for_all_views(
      [](const SceneFile& view) {
        const TransparentOptions options = with_own_alphas(view);
        HALFSPACE_LAW(FastTransparent::arcs_of(view, options) ==
                      RefTransparent::arcs_of(view, options));
      },
      kTransparentMaps / 5);
}

/// The colour that functions of the image point give, which fast has in doubles
/// and ref as rationals.
struct RefShaded {
  /// Last: what the channels may be off by.
  static std::array<double, 4> color_at(const SceneFile& view, PolygonId id,
                                        double x, double y) {
    const auto rational = [](double value) {
      return ref::Rational(static_cast<std::int64_t>(2 * value)) /
             ref::Rational(2);
    };
    const ref::ExactColor color =
        ref::exact_color_at(view.scene, *view.camera, id,
                            {rational(x), rational(y)}, Shading::kGouraud);
    const auto channel = [&](std::size_t c) {
      return static_cast<double>(color[c].big());
    };
    return {channel(0), channel(1), channel(2), 0};
  }
};
struct FastShaded {
  /// Last: what the channels may be off by.
  static std::array<double, 4> color_at(const SceneFile& view, PolygonId id,
                                        double x, double y) {
    const auto forms = fast::color_forms(view.scene, *view.camera, id);
    if (!forms) {
      const Rgb color = view.scene.corner_colors(id)[0];
      return {double(color.r), double(color.g), double(color.b), 0};
    }
    const auto value = [&](std::size_t f) {
      const auto& form = forms->forms[f];
      return form[0] * x + form[1] * y + form[2];
    };
    // Forms are within an ulp, which counts where their terms nearly cancel.
    double terms = 0;
    for (std::size_t f = 0; f < 4; ++f) {
      const auto& form = forms->forms[f];
      terms += (f == 3 ? 256 : 1) * (std::abs(form[0] * x) +
                                     std::abs(form[1] * y) + std::abs(form[2]));
    }
    const double off = 0x1p-50 * terms / value(3);
    HALFSPACE_LAW(value(3) > 0 || !(off < 1));
    return {value(0) / value(3), value(1) / value(3), value(2) / value(3),
            std::abs(off)};
  }
};

template <class Impl>
class S7Shaded : public ::testing::Test {};
using ShadedImplementations = ::testing::Types<RefShaded, FastShaded>;
TYPED_TEST_SUITE(S7Shaded, ShadedImplementations);

/// The scene with colours at its corners, which differ in triangles.
Scene with_corner_colors(const Scene& scene) {
  SceneData data = scene.data();
  data.corner_colors.clear();
  for (PolygonId p = 0; p < static_cast<PolygonId>(scene.polygon_count());
       ++p) {
    const auto corners = scene.corners(p);
    for (std::uint32_t k = 0; k < corners.size(); ++k) {
      const std::uint32_t own = corners.size() == 3 ? 1 + k : 0;
      const std::uint32_t mixed =
          977u * static_cast<std::uint32_t>(p) + 2654435761u * own;
      data.corner_colors.push_back({static_cast<std::uint8_t>(mixed >> 3),
                                    static_cast<std::uint8_t>(mixed >> 11),
                                    static_cast<std::uint8_t>(mixed >> 19)});
    }
  }
  Result<Scene> made = make_scene(std::move(data));
  HALFSPACE_LAW(made.has_value());
  return std::move(*made);
}

TYPED_TEST(S7Shaded, L11FunctionsGiveThePixelsColours) {
  std::size_t shaded = 0;
  law::for_all_views(
      [&](const SceneFile& plain) {
        SceneFile view = plain;
        view.scene = with_corner_colors(plain.scene);
        ImageOptions smooth = view.options;
        smooth.shading = Shading::kGouraud;
        const Image image = oracle::zbuffer(view.scene, *view.camera, smooth);
        for (std::int32_t j = 0; j < image.items.height_px; ++j) {
          for (std::int32_t i = 0; i < image.items.width_px; ++i) {
            const PolygonId id = image.items.at(i, j);
            if (id == kBackground) continue;
            const auto color = TypeParam::color_at(view, id, i + 0.5, j + 0.5);
            const Rgb& pixel = image.colors.at(i, j);
            const double off = 0.5 + 1e-3 + color[3];
            HALFSPACE_LAW(std::abs(color[0] - pixel.r) <= off);
            HALFSPACE_LAW(std::abs(color[1] - pixel.g) <= off);
            HALFSPACE_LAW(std::abs(color[2] - pixel.b) <= off);
            const bool is_triangle = view.scene.corners(id).size() == 3;
            if (is_triangle && color[3] < 1e-3) ++shaded;
          }
        }
      },
      kTransparentMaps);
  EXPECT_GT(shaded, 300u);
}

}  // namespace
}  // namespace halfspace
