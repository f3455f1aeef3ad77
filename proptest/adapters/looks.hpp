#pragma once

#include <type_traits>
#include <utility>
#include <vector>

#include "adapters/answers.hpp"
#include "adapters/both.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/image/lazy_tree.hpp"
#include "halfspace/fast/shade/look.hpp"
#include "halfspace/ref/oracle/look.hpp"
#include "halfspace/scene_file.hpp"

namespace halfspace {

/// Numbers and their colours.
struct Numbers {
  const ScalarField& field;
  const ColorScale& scale;
};

/// The images by a look: of the reference one, of the fast library one from
/// trees of several kinds, of which one is lazy.
template <class Impl>
std::vector<Image> looks_of(const SceneFile& view, const Look& look,
                            const Numbers* numbers = nullptr) {
  const Scene& scene = view.scene;
  const Camera& camera = *view.camera;
  if constexpr (std::is_base_of_v<Ref, Impl>) {
    const auto tree = ref::build(scene, {});
    auto image = numbers == nullptr
                     ? ref::render_look(scene, tree, camera, view.options, look)
                     : ref::render_look(scene, tree, camera, view.options, look,
                                        numbers->field, numbers->scale);
    return {{std::move(image.items), std::move(image.colors),
             image.pixels_painted}};
  } else {
    fast::ScalarColors colors;
    if (numbers != nullptr)
      colors = fast::prepare_scalars(scene, numbers->field, numbers->scale);
    const fast::ScalarColors* own = numbers != nullptr ? &colors : nullptr;
    std::vector<Image> images;
    const auto add = [&images](fast::Rendering image) {
      images.push_back({std::move(image.items), std::move(image.colors),
                        image.pixels_painted});
    };
    for (const std::size_t leaf_size : {1u, 8u, 500u}) {
      fast::DisplayTreeOptions options;
      options.leaf_size = leaf_size;
      options.threads = 1;
      fast::RenderOptions how;
      how.threads = leaf_size == 8 ? 3 : 1;
      if (leaf_size == 1) how.simd = fast::SimdLevel::kPortable;
      add(fast::render_look(scene, fast::build_display_tree(scene, options),
                            camera, view.options, look, how, own));
    }
    const fast::LazyTree lazy(scene);
    add(fast::render_look(lazy, camera, view.options, look, {}, own));
    return images;
  }
}

/// The means of so many pixels each way, each channel rounded half up.
inline ColorImage smaller(const ColorImage& image, std::int32_t k) {
  ColorImage means(image.width_px / k, image.height_px / k, {});
  for (std::int32_t j = 0; j < means.height_px; ++j) {
    for (std::int32_t i = 0; i < means.width_px; ++i) {
      for (const auto channel : {&Rgb::r, &Rgb::g, &Rgb::b}) {
        int sum = 0;
        for (std::int32_t s = 0; s < k * k; ++s)
          sum += image.at(i * k + s % k, j * k + s / k).*channel;
        means.at(i, j).*channel =
            static_cast<std::uint8_t>((2 * sum + k * k) / (2 * k * k));
      }
    }
  }
  return means;
}

}  // namespace halfspace
