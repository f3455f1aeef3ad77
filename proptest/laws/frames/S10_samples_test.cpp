#include <cstdint>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "adapters/both.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/render.hpp"
#include "laws/changed_views.hpp"
#include "laws/frames/cap_looks.hpp"
#include "laws/frames/clipped_views.hpp"
#include "laws/law.hpp"

/// Laws of samples of clip planes and caps, and of caps by part (S10.4, S10.6).
namespace halfspace {
namespace {

struct RefSamples {
  static Image samples(const SceneFile& view, std::int32_t count) {
    return Ref::image_of(
        ref::render_samples(view.scene, ref::build(view.scene, {}),
                            *view.camera, view.options, count));
  }
};

struct FastSamples {
  static Image samples(const SceneFile& view, std::int32_t count) {
    fast::DisplayTreeOptions options;
    options.leaf_size = 3;
    options.threads = 1;
    fast::Rendering rendering = fast::render_samples(
        view.scene, fast::build_display_tree(view.scene, options), *view.camera,
        view.options, count);
    return {std::move(rendering.items), std::move(rendering.colors),
            rendering.pixels_painted};
  }
};

template <class Impl>
class S10Samples : public ::testing::Test {};
using SampleImplementations = ::testing::Types<RefSamples, FastSamples>;
TYPED_TEST_SUITE(S10Samples, SampleImplementations);

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
  constexpr std::int32_t kCounts[] = {2, 4, 2, 8, 2, 4};
  const std::int32_t samples = kCounts[seed_of(view) % std::size(kCounts)];
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

TYPED_TEST(S10Samples, L5SamplesOfSectionsAreALargerImages) {
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

TYPED_TEST(S10Samples, L5SamplesOfCapsAreALargerImages) {
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

TYPED_TEST(S10Samples, L8PartsAreToldApartByTheCapsOfEachAlone) {
  std::size_t of_one = 0;
  std::size_t of_several = 0;
  law::check(160, [&] {
    const auto number =
        *rc::gen::resize(100, rc::gen::inRange<std::uint64_t>(0, 1u << 20));
    const SceneFile view =
        cut_boxes(number, 2 + static_cast<int>(number % 3), 10, 8);
    const ItemImage without = TypeParam::samples(view, 1).items;
    SceneFile apart = view;
    tell_parts_apart(apart);
    const auto& part_of = apart.options.parts->part_of;
    const auto parts = static_cast<std::uint32_t>(apart.options.parts->count());
    std::vector<ItemImage> alone;
    std::vector<PolygonId> alone_count;
    for (std::uint32_t part = 0; part < parts; ++part) {
      const SceneFile one = only_part(view, part_of, part);
      alone.push_back(TypeParam::samples(one, 1).items);
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
