#include "halfspace/ref/render.hpp"

#include "halfspace/ref/clip.hpp"
#include "halfspace/ref/projection.hpp"
#include "halfspace/ref/scan.hpp"
#include "halfspace/ref/screen.hpp"
#include "halfspace/ref/shade.hpp"
#include "halfspace/ref/traverse.hpp"

namespace halfspace::ref {

Rendering render(const Scene& scene, const BspTree& tree, const Camera& camera,
                 const ImageOptions& options) {
  const std::vector<Plane> planes = planes_of(scene);
  const Projection projection = projection_of(camera);
  DynamicScreen screen(camera->width_px, camera->height_px);
  Rendering image;
  image.items = ItemImage(camera->width_px, camera->height_px, kBackground);

  front_to_back(tree, camera, [&](const Node&, const Fragment& fragment) {
    const Plane& plane = planes[static_cast<std::size_t>(fragment.source)];
    const bool from_behind = side_of_eye(plane, camera) == Side::kNegative;
    if (options.cull && from_behind) return true;
    if (!is_there(plane, options)) return true;
    const auto left = clipped(fragment, options);
    if (!left) return true;
    ++image.fragments_displayed;
    for (const auto& [line, span] : scan_convert(*left, projection)) {
      screen.merge(line, {span}, [&, row = line](Span lit) {
        for (std::int32_t i = lit.first; i <= lit.last; ++i) {
          image.items.at(i, row) = fragment.source;
          ++image.pixels_painted;
        }
      });
    }
    return !screen.full();
  });

  add_caps(scene, camera, options, image.items);
  // Each pixel's colour depends on nothing but the polygon seen there (S5.4).
  image.colors = colors_of(scene, camera, image.items, options);
  return image;
}

}  // namespace halfspace::ref
