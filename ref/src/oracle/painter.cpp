#include "halfspace/ref/oracle/painter.hpp"

#include <functional>

#include "halfspace/assert.hpp"
#include "halfspace/cap_parts.hpp"
#include "halfspace/ref/clip.hpp"
#include "halfspace/ref/projection.hpp"
#include "halfspace/ref/scan.hpp"
#include "halfspace/ref/shade.hpp"
#include "halfspace/ref/traverse.hpp"

namespace halfspace::ref {
namespace {

Plane magnified(const Rational& scale, const Plane& f) {
  return {scale * f.a, scale * f.b, scale * f.c, scale * f.d};
}

/// Calls set(i, j, source) for the samples of each fragment, back to front.
using Set = std::function<void(std::int32_t, std::int32_t, PolygonId)>;

void set_back_to_front(const Scene& scene, const BspTree& tree,
                       const Camera& camera, const ImageOptions& options,
                       std::int32_t samples, Rendering& image, const Set& set) {
  const std::vector<Plane> planes = planes_of(scene);
  // The image, so many times as large.
  Projection projection = projection_of(camera);
  projection.x = magnified(samples, projection.x);
  projection.y = magnified(samples, projection.y);
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
                std::int32_t samples, ColorImage& colors) {
  ItemImage caps(colors.width_px, colors.height_px, kBackground);
  add_caps(scene, camera, options, caps, samples, eye);
  for (std::int32_t j = 0; j < caps.height_px; ++j) {
    for (std::int32_t i = 0; i < caps.width_px; ++i) {
      if (caps.at(i, j) == kBackground) continue;
      const auto cap =
          static_cast<std::size_t>(caps.at(i, j)) - scene.polygon_count();
      const Rgb over =
          cap_color_at_sample(options, cap_item(cap), i, j, samples);
      colors.at(i, j) = blended(over, colors.at(i, j), alpha);
    }
  }
}

}  // namespace

Rendering paint(const Scene& scene, const BspTree& tree, const Camera& camera,
                const ImageOptions& options) {
  Rendering image;
  image.items = ItemImage(camera->width_px, camera->height_px, kBackground);
  set_back_to_front(scene, tree, camera, options, 1, image,
                    [&](std::int32_t i, std::int32_t j, PolygonId source) {
                      image.items.at(i, j) = source;
                    });
  add_caps(scene, camera, options, image.items);
  image.colors = colors_of(scene, camera, image.items, options);
  return image;
}

Rendering blend(const Scene& scene, const BspTree& tree, const Camera& camera,
                const ImageOptions& options, std::uint8_t alpha) {
  return blend_in_colors(scene, tree, camera, options, alpha,
                         [&](PolygonId polygon, const ImagePoint& at) {
                           return rounded_color(exact_color_at(
                               scene, camera, polygon, at, options.shading));
                         });
}

Rendering blend_in_colors(const Scene& scene, const BspTree& tree,
                          const Camera& camera, const ImageOptions& options,
                          std::uint8_t alpha, const PointColor& color_of,
                          std::int32_t samples) {
  const std::int32_t width = camera->width_px * samples;
  const std::int32_t height = camera->height_px * samples;
  HALFSPACE_ASSERT(width <= kMaxImageSize && height <= kMaxImageSize);
  Rendering image;
  image.items = ItemImage(width, height, kBackground);
  image.colors = ColorImage(width, height, options.background);
  // Of caps those behind what is kept come first, those before it last (S10,
  // "Caps are composed first or last").
  blend_caps(scene, camera, options, alpha, Side::kPositive, samples,
             image.colors);
  const auto centre = [&](std::int32_t sample) {
    return Rational(2 * sample + 1) / Rational(2 * samples);
  };
  set_back_to_front(scene, tree, camera, options, samples, image,
                    [&](std::int32_t i, std::int32_t j, PolygonId source) {
                      Rgb& color = image.colors.at(i, j);
                      const Rgb own = color_of(source, {centre(i), centre(j)});
                      color = blended(own, color, alpha);
                      image.items.at(i, j) = source;
                    });
  blend_caps(scene, camera, options, alpha, Side::kNegative, samples,
             image.colors);
  add_caps(scene, camera, options, image.items, samples);
  return image;
}

}  // namespace halfspace::ref
