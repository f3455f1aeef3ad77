#include <cstddef>
#include <optional>
#include <set>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "adapters/both.hpp"
#include "halfspace/fast/image/lazy_tree.hpp"
#include "halfspace/fast/painter.hpp"
#include "halfspace/ref/oracle/zbuffer.hpp"
#include "laws/frames/clipped_views.hpp"
#include "laws/frames/lazy_trees.hpp"
#include "laws/law.hpp"

/// The law of lazy trees (S3.12).
namespace halfspace {
namespace {

constexpr int kLazyViews = 300;
constexpr std::uint8_t kAlpha = 90;

/// What an implementation made of one view.
struct Shown {
  Image opaque;
  Image transparent;
  Image samples;
};

/// A view from a place that is not the scene file's.
SceneFile from(const SceneFile& view, const Camera& camera) {
  SceneFile other = view;
  other.camera = camera;
  return other;
}

/// Views of the same scene: a part of the image, what is behind the viewer, and
/// all of it, twice.
std::vector<SceneFile> views_of(const SceneFile& view) {
  std::vector<SceneFile> views;
  const CameraData& camera = view.camera->data();
  const auto add = [&](const CameraData& data) {
    if (const auto made = make_camera(data, view.scene.grid_bits()))
      views.push_back(from(view, *made));
  };
  CameraData part = camera;
  part.width_px = (camera.width_px + 2) / 3;
  part.height_px = (camera.height_px + 1) / 2;
  add(part);
  CameraData back = camera;
  for (LatticeVector* v : {&back.s0, &back.sx, &back.sy})
    *v = {-v->x, -v->y, -v->z};
  if (camera.perspective) {
    back.s0 = {2 * camera.eye.x + back.s0.x, 2 * camera.eye.y + back.s0.y,
               2 * camera.eye.z + back.s0.z};
  }
  add(back);
  views.push_back(view);
  views.push_back(view);
  return views;
}

void expect_same(const Image& one, const Image& other) {
  HALFSPACE_LAW(one.items == other.items);
  HALFSPACE_LAW(one.colors == other.colors);
}

struct RefLazy {
  static std::vector<Shown> show(const std::vector<SceneFile>& views) {
    std::vector<Shown> all;
    const auto tree = ref::build(views.front().scene, {});
    for (const SceneFile& view : views) {
      const auto image = [](const ref::Rendering& rendering) {
        return Ref::image_of(rendering);
      };
      all.push_back(
          {image(ref::render(view.scene, tree, *view.camera, view.options)),
           image(ref::blend(view.scene, tree, *view.camera, view.options,
                            kAlpha)),
           image(ref::render_samples(view.scene, tree, *view.camera,
                                     view.options, 2))});
    }
    return all;
  }

  /// The reference's trees are built for each scene.
  static std::size_t expect_moved(const std::vector<Scene>& scenes,
                                  const std::vector<std::vector<PolygonId>>&,
                                  const SceneFile& view,
                                  const ImageOptions& options) {
    for (const Scene& scene : scenes) {
      expect_same(Ref::image_of(ref::render(scene, ref::build(scene, {}),
                                            *view.camera, options)),
                  oracle::zbuffer(scene, *view.camera, options));
    }
    return 0;
  }
};

struct FastLazy {
  static Image image_of(fast::Rendering rendering) {
    return {std::move(rendering.items), std::move(rendering.colors),
            rendering.pixels_painted};
  }

  /// Everything that is seen is built; made again, nothing more is.
  static void expect_built(const fast::LazyTree& tree, const SceneFile& view,
                           const fast::RenderOptions& how, const Image& image) {
    const std::set<PolygonId> seen(image.items.pixels.begin(),
                                   image.items.pixels.end());
    const fast::LazyTreeStats built = tree.stats();
    HALFSPACE_LAW(built.polygons_built + seen.count(kBackground) >=
                  seen.size());
    HALFSPACE_LAW(built.cells_built <= built.cells);
    HALFSPACE_LAW(fast::render(tree, *view.camera, view.options, how).items ==
                  image.items);
    HALFSPACE_LAW(tree.stats() == built);
  }

  static std::vector<Shown> show(const std::vector<SceneFile>& views) {
    std::vector<Shown> first;
    for (const LazyKind& kind : kLazyKinds) {
      fast::RenderOptions how;
      how.threads = kind.threads;
      how.simd = kind.simd;
      // One tree for each way of making images, and one for all of them.
      const fast::LazyTree opaque = open_lazy(views.front().scene, kind);
      const fast::LazyTree all = open_lazy(views.front().scene, kind);
      std::vector<Shown> shown;
      for (const SceneFile& view : views) {
        const auto& [camera, options] = std::tie(*view.camera, view.options);
        shown.push_back(
            {image_of(fast::render(opaque, camera, options, how)),
             image_of(fast::blend(all, camera, options, kAlpha, how)),
             image_of(fast::render_samples(all, camera, options, 2, how))});
        expect_built(opaque, view, how, shown.back().opaque);
        note_built(opaque, kind);
        HALFSPACE_LAW(fast::render(all, camera, options, how).items ==
                      shown.back().opaque.items);
        HALFSPACE_LAW(fast::paint(all, camera, options, how).items ==
                      shown.back().opaque.items);
      }
      for (std::size_t k = 0; k < first.size(); ++k) {
        expect_same(shown[k].opaque, first[k].opaque);
        expect_same(shown[k].transparent, first[k].transparent);
        expect_same(shown[k].samples, first[k].samples);
      }
      if (first.empty()) first = std::move(shown);
    }
    return first;
  }

  static std::size_t expect_moved(
      const std::vector<Scene>& scenes,
      const std::vector<std::vector<PolygonId>>& changed, const SceneFile& view,
      const ImageOptions& options) {
    std::size_t kept = 0;
    for (const LazyKind& kind : kLazyKinds) {
      fast::RenderOptions how;
      how.threads = kind.threads;
      how.simd = kind.simd;
      fast::LazyTree tree = open_lazy(scenes.front(), kind);
      for (std::size_t k = 0; k < scenes.size(); ++k) {
        if (k > 0) tree.move_to(scenes[k], changed[k]);
        HALFSPACE_LAW(&tree.scene() == &scenes[k]);
        kept += k > 0 && tree.stats().cells_built > 0 ? 1u : 0u;
        // Sometimes nothing is displayed between two moves.
        if (k % 3 == 2 && k + 1 < scenes.size()) continue;
        const Image image = oracle::zbuffer(scenes[k], *view.camera, options);
        expect_same(image_of(fast::render(tree, *view.camera, options, how)),
                    image);
        HALFSPACE_LAW(fast::paint(tree, *view.camera, options, how).items ==
                      image.items);
      }
    }
    return kept;
  }

  static void note_built(const fast::LazyTree& tree, const LazyKind& kind) {
    const fast::LazyTreeStats built = tree.stats();
    if (kind.cell_size == 1 && built.cells_built < built.cells) ++partly;
  }
  static inline std::size_t partly = 0;
};

template <class Impl>
class S3Lazy : public ::testing::Test {};
using LazyImplementations = ::testing::Types<RefLazy, FastLazy>;
TYPED_TEST_SUITE(S3Lazy, LazyImplementations);

TYPED_TEST(S3Lazy, L19ImagesOfALazyTreeAreThoseOfAnyTree) {
  std::size_t clips = 0;
  law::for_all_views(
      [&](const SceneFile& original) {
        SceneFile view =
            seed_of(original) % 3 == 0 ? clipped(original) : original;
        view.options.caps = std::nullopt;
        clips += view.options.clips.empty() ? 0u : 1u;
        const std::vector<SceneFile> views = views_of(view);
        const std::vector<Shown> shown = TypeParam::show(views);
        HALFSPACE_LAW(shown.size() == views.size());
        const std::vector<Shown> expected = RefLazy::show(views);
        for (std::size_t k = 0; k < views.size(); ++k) {
          const Image image =
              oracle::zbuffer(view.scene, *views[k].camera, view.options);
          expect_same(shown[k].opaque, image);
          expect_same(shown[k].transparent, expected[k].transparent);
          expect_same(shown[k].samples, expected[k].samples);
        }
      },
      kLazyViews);
  EXPECT_GT(clips, 10u);
  if constexpr (std::is_same_v<TypeParam, FastLazy>) {
    EXPECT_GT(FastLazy::partly, 200u);
  }
}

TYPED_TEST(S3Lazy, L20MovedPolygonsAreSeenWhereTheyAreNow) {
  std::size_t moves = 0;
  std::size_t kept = 0;
  law::for_all_views(
      [&](const SceneFile& view) {
        if (view.scene.polygon_count() == 0) return;
        ImageOptions options = view.options;
        options.caps = std::nullopt;
        const std::optional<Scene> first = apart(view.scene);
        HALFSPACE_LAW(first.has_value());
        std::vector<Scene> scenes = {*first};
        std::vector<std::vector<PolygonId>> changed = {{}};
        for (std::uint64_t k = 1; k <= 4; ++k) {
          auto next = moved(scenes.back(), seed_of(view) + k);
          if (!next) continue;
          scenes.push_back(std::move(next->first));
          changed.push_back(std::move(next->second));
        }
        moves += scenes.size() - 1;
        kept += TypeParam::expect_moved(scenes, changed, view, options);
      },
      kLazyViews);
  EXPECT_GT(moves, 300u);
  if constexpr (std::is_same_v<TypeParam, FastLazy>) {
    EXPECT_GT(kept, 100u) << "moves after which something was still built";
  }
}

}  // namespace
}  // namespace halfspace
