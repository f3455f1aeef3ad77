#include "halfspace/ref/painter.hpp"

#include "halfspace/ref/projection.hpp"
#include "halfspace/ref/scan.hpp"
#include "halfspace/ref/shade.hpp"
#include "halfspace/ref/traverse.hpp"

namespace halfspace::ref {

Rendering paint(const Scene& scene, const BspTree& tree, const Camera& camera,
                const ImageOptions& options) {
  const std::vector<Plane> planes = planes_of(scene);
  const Projection projection = projection_of(camera);
  Rendering image;
  image.items = ItemImage(camera->width_px, camera->height_px, kBackground);

  back_to_front(tree, camera, [&](const Node&, const Fragment& fragment) {
    const Plane& plane = planes[static_cast<std::size_t>(fragment.source)];
    const bool from_behind = side_of_eye(plane, camera) == Side::kNegative;
    if (options.cull && from_behind) return true;
    ++image.fragments_displayed;
    for (const auto& [line, span] : scan_convert(fragment, projection)) {
      for (std::int32_t i = span.first; i <= span.last; ++i) {
        image.items.at(i, line) = fragment.source;
        ++image.pixels_painted;
      }
    }
    return true;
  });

  image.colors = colors_of(scene, camera, image.items, options);
  return image;
}

}  // namespace halfspace::ref
