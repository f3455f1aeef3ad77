#include "halfspace/ref/oracle/painter.hpp"

#include <functional>

#include "halfspace/ref/clip.hpp"
#include "halfspace/ref/projection.hpp"
#include "halfspace/ref/scan.hpp"
#include "halfspace/ref/shade.hpp"
#include "halfspace/ref/traverse.hpp"

namespace halfspace::ref {
namespace {

/// Calls set(i, j, source) for the samples of each fragment, back to front.
using Set = std::function<void(std::int32_t, std::int32_t, PolygonId)>;

void set_back_to_front(const Scene& scene, const BspTree& tree,
                       const Camera& camera, const ImageOptions& options,
                       Rendering& image, const Set& set) {
  const std::vector<Plane> planes = planes_of(scene);
  const Projection projection = projection_of(camera);
  back_to_front(tree, camera, [&](const Node&, const Fragment& fragment) {
    const Plane& plane = planes[static_cast<std::size_t>(fragment.source)];
    const bool from_behind = side_of_eye(plane, camera) == Side::kNegative;
    if (options.cull && from_behind) return true;
    if (!is_there(plane, options)) return true;
    const auto left = clipped(fragment, options);
    if (!left) return true;
    ++image.fragments_displayed;
    for (const auto& [line, span] : scan_convert(*left, projection)) {
      for (std::int32_t i = span.first; i <= span.last; ++i) {
        set(i, line, fragment.source);
        ++image.pixels_painted;
      }
    }
    return true;
  });
}

/// alpha / 255 of `over` and the rest of `under`, rounded half up (S5.6).
std::uint8_t blended(std::uint8_t over, std::uint8_t under,
                     std::uint8_t alpha) {
  const Rational share = Rational(alpha) / Rational(kOpaque);
  const Rational value =
      share * Rational(over) + (Rational(1) - share) * Rational(under);
  const Rational half = Rational(1) / Rational(2);
  return static_cast<std::uint8_t>(floor(value + half).to_int64());
}

Rgb blended(const Rgb& over, const Rgb& under, std::uint8_t alpha) {
  return {blended(over.r, under.r, alpha), blended(over.g, under.g, alpha),
          blended(over.b, under.b, alpha)};
}

/// Blends the caps of planes that the eye is on that side of (S10.7).
void blend_caps(const Scene& scene, const Camera& camera,
                const ImageOptions& options, std::uint8_t alpha, Side eye,
                ColorImage& colors) {
  ItemImage caps(colors.width_px, colors.height_px, kBackground);
  add_caps(scene, camera, options, caps, 1, eye);
  const ColorImage over = colors_of(scene, camera, caps, options);
  for (std::size_t k = 0; k < caps.pixels.size(); ++k) {
    Rgb& color = colors.pixels[k];
    if (caps.pixels[k] != kBackground)
      color = blended(over.pixels[k], color, alpha);
  }
}

}  // namespace

Rendering paint(const Scene& scene, const BspTree& tree, const Camera& camera,
                const ImageOptions& options) {
  Rendering image;
  image.items = ItemImage(camera->width_px, camera->height_px, kBackground);
  set_back_to_front(scene, tree, camera, options, image,
                    [&](std::int32_t i, std::int32_t j, PolygonId source) {
                      image.items.at(i, j) = source;
                    });
  add_caps(scene, camera, options, image.items);
  image.colors = colors_of(scene, camera, image.items, options);
  return image;
}

Rendering blend(const Scene& scene, const BspTree& tree, const Camera& camera,
                const ImageOptions& options, std::uint8_t alpha) {
  return blend_in_colors(
      scene, tree, camera, options, alpha,
      [&](PolygonId polygon, std::int32_t i, std::int32_t j) {
        return color_at(scene, camera, polygon, i, j, options.shading);
      });
}

Rendering blend_in_colors(const Scene& scene, const BspTree& tree,
                          const Camera& camera, const ImageOptions& options,
                          std::uint8_t alpha, const PixelColor& color_of) {
  Rendering image;
  image.items = ItemImage(camera->width_px, camera->height_px, kBackground);
  image.colors =
      ColorImage(camera->width_px, camera->height_px, options.background);
  // Of caps those behind what is kept come first, those before it last (S10,
  // "Caps are composed first or last").
  blend_caps(scene, camera, options, alpha, Side::kPositive, image.colors);
  set_back_to_front(scene, tree, camera, options, image,
                    [&](std::int32_t i, std::int32_t j, PolygonId source) {
                      Rgb& color = image.colors.at(i, j);
                      color = blended(color_of(source, i, j), color, alpha);
                      image.items.at(i, j) = source;
                    });
  blend_caps(scene, camera, options, alpha, Side::kNegative, image.colors);
  add_caps(scene, camera, options, image.items);
  return image;
}

}  // namespace halfspace::ref
