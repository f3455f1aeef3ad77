#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "adapters/both.hpp"
#include "adapters/looks.hpp"
#include "halfspace/cap_parts.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/image/transparent_map.hpp"
#include "halfspace/fast/painter.hpp"
#include "halfspace/ref/clip.hpp"
#include "halfspace/ref/oracle/painter.hpp"
#include "halfspace/splitmix.hpp"
#include "halfspace/visible_map.hpp"
#include "laws/changed_views.hpp"
#include "laws/frames/cap_looks.hpp"
#include "laws/frames/clipped_views.hpp"
#include "laws/frames/cut_beforehand.hpp"
#include "laws/law.hpp"
#include "laws/map/map_arcs.hpp"

/// Laws of transparent sections (S10.7).
namespace halfspace::glass {
namespace {

constexpr int kGlassViews = 150;
constexpr int kGlassMaps = 75;

/// What the reference's map takes up to a second for.
constexpr std::size_t kMostPolygons = 18;

/// All that covers samples of a clipped scene: polygons, and caps by their ids.
class Layers {
 public:
  /// Of an image whose pixels are samples, so many each way.
  explicit Layers(const SceneFile& view, std::int32_t samples = 1)
      : view_(view),
        samples_(samples),
        count_(static_cast<PolygonId>(view.scene.polygon_count())) {
    const Camera& camera = *view.camera;
    for (const PolygonId id : ids_of(view.scene))
      polygons_.push_back(polygon_of(id));
    for (const ClipPlane& clip : view.options.clips) {
      definition::Facet facet;
      facet.support = cut_beforehand::to_plane(clip);
      planes_.push_back(definition::project(facet, camera, view.options.cull));
    }
    if (!view.options.caps) return;
    for (const Side side : {Side::kPositive, Side::kNegative}) {
      caps_.emplace_back(camera->width_px, camera->height_px, kBackground);
      ref::add_caps(view.scene, camera, view.options, caps_.back(), 1, side);
    }
  }

  /// What covers a sample, from the farthest on.
  std::vector<PolygonId> at(std::int32_t i, std::int32_t j) const {
    std::vector<PolygonId> here;
    for (PolygonId id = 0; id < count_; ++id) {
      if (definition::covers(polygons_[static_cast<std::size_t>(id)], i, j))
        here.push_back(id);
    }
    for (const ItemImage& caps : caps_) {
      if (caps.at(i, j) != kBackground) here.push_back(caps.at(i, j));
    }
    std::sort(here.begin(), here.end(), [&](PolygonId p, PolygonId q) {
      const int order =
          p == q ? 0
                 : definition::compare_depth(depth_of(p), depth_of(q), i, j);
      return order != 0 ? order > 0 : p > q;
    });
    return here;
  }

  bool is_cap(PolygonId id) const { return id >= count_; }
  /// The colour of one of them at a pixel.
  Rgb color_at(PolygonId id, std::int32_t i, std::int32_t j) const {
    return is_cap(id) ? stripe_color(view_.options,
                                     static_cast<std::size_t>(id - count_), i,
                                     j, samples_)
                      : view_.scene.color(id);
  }
  std::size_t part_of(PolygonId cap) const {
    return cap_item(static_cast<std::size_t>(cap - count_)).part;
  }

 private:
  definition::Projection polygon_of(PolygonId id) const {
    definition::Projection nothing;
    nothing.nothing = true;
    auto points =
        definition::points_of(view_.scene, definition::whole(view_.scene, id));
    for (const ClipPlane& clip : view_.options.clips) {
      const auto plane = cut_beforehand::to_plane(clip);
      const bool lies_there =
          std::all_of(points.begin(), points.end(), [&](const auto& p) {
            return cut_beforehand::value_at(plane, p) == 0;
          });
      if (lies_there && view_.options.caps) return nothing;
      points = cut_beforehand::cut(points, plane);
      if (points.empty()) return nothing;
    }
    return definition::project(definition::facet_of(points), *view_.camera,
                               view_.options.cull);
  }
  const definition::Projection& depth_of(PolygonId id) const {
    if (!is_cap(id)) return polygons_[static_cast<std::size_t>(id)];
    return planes_[cap_item(static_cast<std::size_t>(id - count_)).plane];
  }

  const SceneFile& view_;
  std::int32_t samples_;
  PolygonId count_;
  std::vector<definition::Projection> polygons_;
  std::vector<definition::Projection> planes_;
  std::vector<ItemImage> caps_;
};

struct RefGlass {
  using Library = Ref;
  static constexpr std::size_t kMost = kMostPolygons;
  static std::vector<std::pair<ItemImage, ColorImage>> images_of(
      const SceneFile& view, std::uint8_t alpha) {
    const auto image = ref::blend(view.scene, ref::build(view.scene, {}),
                                  *view.camera, view.options, alpha);
    return {{image.items, image.colors}};
  }
  static map_arcs::Arcs arcs_of(const SceneFile& view,
                                const TransparentOptions& options) {
    return map_arcs::exact_arcs(ref::transparent_section(
        view.scene, *view.camera, options, view.options));
  }
};

struct FastGlass {
  using Library = Fast;
  static constexpr std::size_t kMost = 1000;
  static std::vector<std::pair<ItemImage, ColorImage>> images_of(
      const SceneFile& view, std::uint8_t alpha) {
    std::vector<std::pair<ItemImage, ColorImage>> images;
    for (const std::size_t leaf_size : {1u, 8u, 500u}) {
      fast::DisplayTreeOptions options;
      options.leaf_size = leaf_size;
      options.threads = 1;
      fast::RenderOptions how;
      how.threads = leaf_size == 8 ? 3 : 1;
      auto image =
          fast::blend(view.scene, fast::build_display_tree(view.scene, options),
                      *view.camera, view.options, alpha, how);
      images.emplace_back(std::move(image.items), std::move(image.colors));
    }
    return images;
  }
  static map_arcs::Arcs arcs_of(const SceneFile& view,
                                const TransparentOptions& options) {
    const auto map =
        fast::transparent_section(view.scene, fast::build(view.scene, {}),
                                  *view.camera, options, view.options);
    HALFSPACE_LAW(map.has_value());
    return map_arcs::exact_arcs(*map);
  }
};

/// Calls the property for so many flat views, twice, of closed scenes that are
/// cut: with caps, told apart by parts in every other one.
void for_all_sections(int views,
                      const std::function<void(const SceneFile&)>& property) {
  const auto cut = [&](SceneFile view) {
    if (view.options.clips.empty()) return;
    view.options.shading = Shading::kFlat;
    view.options.background = {200, 2, 200};
    if (!view.options.caps)
      view.options.caps = CapStyle{{9, 8, 7}, Rgb{1, 250, 3}};
    if (seed_of(view) % 2 == 0) tell_parts_apart(view);
    property(view);
  };
  law::for_all(closed_views(), views, [&](const SceneFile& whole) {
    if (bad_edges(whole.scene).empty()) cut(clipped(whole));
  });
  law::check(views, [&] {
    const auto number = *rc::gen::arbitrary<std::uint64_t>();
    SceneFile view = cut_boxes(number, 2, 16, 12);
    view.options.cull = number % 5 == 0;
    cut(view);
  });
}

template <class Impl>
class S10Glass : public ::testing::Test {};
using Glasses = ::testing::Types<RefGlass, FastGlass>;
TYPED_TEST_SUITE(S10Glass, Glasses);

TYPED_TEST(S10Glass, L9PolygonsAndCapsAreBlendedFromTheFarthest) {
  std::size_t behind = 0, before = 0;
  for_all_sections(kGlassViews, [&](const SceneFile& view) {
    const Layers layers(view);
    const auto alpha = static_cast<std::uint8_t>(seed_of(view) >> 9 & 255);
    const auto images = TypeParam::images_of(view, alpha);
    for (const auto& [items, colors] : images) {
      for (std::int32_t j = 0; j < items.height_px; ++j) {
        for (std::int32_t i = 0; i < items.width_px; ++i) {
          const std::vector<PolygonId> here = layers.at(i, j);
          Rgb color = view.options.background;
          for (const PolygonId id : here)
            color = composed_color(layers.color_at(id, i, j), color, alpha);
          HALFSPACE_LAW(colors.at(i, j) == color);
          HALFSPACE_LAW(items.at(i, j) ==
                        (here.empty() ? kBackground : here.back()));
          if (here.size() < 2) continue;
          behind += layers.is_cap(here.front()) ? 1u : 0u;
          before += layers.is_cap(here.back()) ? 1u : 0u;
        }
      }
    }
  });
  EXPECT_GT(behind, 100u);
  EXPECT_GT(before, 100u);
}

/// A section so many times as large.
std::optional<SceneFile> magnified_section(const SceneFile& view,
                                           std::int32_t k) {
  auto large = magnified(view, k);
  if (!large) return large;
  for (ClipPlane& clip : large->options.clips) clip.d *= k;
  const auto clips = make_clips(large->options.clips, large->scene.grid_bits());
  // Reduced, two of them could be one.
  if (!clips || clips->size() != view.options.clips.size()) return std::nullopt;
  large->options.clips = *clips;
  return large;
}

TYPED_TEST(S10Glass, L9SamplesAreMeansOfPolygonsAndCaps) {
  using Impl = typename TypeParam::Library;
  std::size_t compared = 0, caps = 0;
  for_all_sections(kGlassMaps, [&](const SceneFile& view) {
    const std::int32_t k = seed_of(view) % 4 == 0 ? 4 : 2;
    const auto large = magnified_section(view, k);
    if (!large) return;
    ++compared;
    const Layers layers(*large, k);
    const auto alpha = static_cast<std::uint8_t>(seed_of(view) >> 9 & 255);
    const CameraData& size = large->camera->data();
    ColorImage fine(size.width_px, size.height_px, view.options.background);
    for (std::int32_t j = 0; j < size.height_px; ++j) {
      for (std::int32_t i = 0; i < size.width_px; ++i) {
        for (const PolygonId id : layers.at(i, j)) {
          fine.at(i, j) =
              composed_color(layers.color_at(id, i, j), fine.at(i, j), alpha);
          caps += layers.is_cap(id);
        }
      }
    }
    const ColorImage expected = smaller(fine, k);
    const auto images = looks_of<Impl>(view, {alpha, k, std::nullopt});
    for (const Image& image : images) HALFSPACE_LAW(image.colors == expected);
  });
  EXPECT_GT(compared, 50u);
  EXPECT_GT(caps, 500u);
}

/// Alphas that differ from polygon to polygon and from part to part, or not.
TransparentOptions alphas_of(const SceneFile& view) {
  std::uint64_t drawn = seed_of(view) + 5;
  const auto next = [&drawn] {
    drawn = mix(drawn + 1);
    return static_cast<std::uint8_t>(drawn >> 11 & 255);
  };
  TransparentOptions options = {view.options.cull, next(),
                                view.options.background};
  if (next() % 3 == 0) return options;
  for (std::size_t p = 0; p < view.scene.polygon_count(); ++p)
    options.alphas.push_back(next());
  const std::size_t caps =
      view.options.parts ? view.options.parts->count() + 1 : 1;
  for (std::size_t q = 0; q < caps; ++q) options.cap_alphas.push_back(next());
  return options;
}

TYPED_TEST(S10Glass, L10SamplesLieInTheRegionOfTheirColour) {
  std::size_t caps = 0, own = 0;
  for_all_sections(kGlassMaps, [&](const SceneFile& view) {
    if (view.scene.polygon_count() > TypeParam::kMost) return;
    const Layers layers(view);
    const TransparentOptions options = alphas_of(view);
    const auto arcs = TypeParam::arcs_of(view, options);
    const CameraData& size = view.camera->data();
    for (std::int32_t j = 0; j < size.height_px; ++j) {
      for (std::int32_t i = 0; i < size.width_px; ++i) {
        const std::vector<PolygonId> here = layers.at(i, j);
        Rgb color = view.options.background;
        for (const PolygonId id : here) {
          const std::uint8_t alpha =
              layers.is_cap(id) ? options.alpha_of_cap(layers.part_of(id))
                                : options.alpha_of(id);
          color = composed_color(layers.color_at(id, i, j), color, alpha);
          if (!layers.is_cap(id)) continue;
          ++caps;
          own += options.cap_alphas.empty() ? 0u : 1u;
        }
        HALFSPACE_LAW(map_arcs::key_at(arcs, i, j) ==
                      (here.empty() ? kBackgroundKey : color_key(color)));
      }
    }
  });
  EXPECT_GT(caps, 30u);
  EXPECT_GT(own, 15u);
}

TEST(S10GlassAgree, RefAndFastGiveTheSameMapOfATransparentSection) {
  for_all_sections(kGlassMaps, [&](const SceneFile& view) {
    if (view.scene.polygon_count() > kMostPolygons) return;
    const TransparentOptions options = alphas_of(view);
    HALFSPACE_LAW(FastGlass::arcs_of(view, options) ==
                  RefGlass::arcs_of(view, options));
  });
}

}  // namespace
}  // namespace halfspace::glass
