#include "halfspace/assert.hpp"
#include "halfspace/cap_parts.hpp"
#include "halfspace/ref/clip.hpp"
#include "halfspace/ref/projection.hpp"
#include "halfspace/ref/render.hpp"
#include "halfspace/ref/scan.hpp"
#include "halfspace/ref/screen.hpp"
#include "halfspace/ref/shade.hpp"
#include "halfspace/ref/traverse.hpp"

namespace halfspace::ref {
namespace {

Plane times(const Rational& scale, const Plane& f) {
  return {scale * f.a, scale * f.b, scale * f.c, scale * f.d};
}

/// The mean of the colours that the samples of pixel (i, j) see, not rounded
/// (S5.7).
ExactColor mean_color(const Scene& scene, const Camera& camera,
                      const ItemImage& items, const ImageOptions& options,
                      std::int32_t i, std::int32_t j, std::int32_t samples) {
  const Rational share = Rational(1) / Rational(samples * samples);
  const auto polygons = static_cast<PolygonId>(scene.polygon_count());
  const auto centre = [&](std::int32_t pixel, std::int32_t sample) {
    return Rational(pixel) + Rational(2 * sample + 1) / Rational(2 * samples);
  };
  ExactColor mean = {0, 0, 0};
  for (std::int32_t b = 0; b < samples; ++b) {
    for (std::int32_t a = 0; a < samples; ++a) {
      const PolygonId seen = items.at(i * samples + a, j * samples + b);
      ExactColor color = exact(options.background);
      if (seen >= polygons) {
        color = exact(cap_color_at_sample(
            options, cap_item(static_cast<std::size_t>(seen - polygons)),
            i * samples + a, j * samples + b, samples));
      } else if (seen != kBackground) {
        color = exact_color_at(scene, camera, seen,
                               {centre(i, a), centre(j, b)}, options.shading);
      }
      for (std::size_t c = 0; c < 3; ++c) mean[c] += share * color[c];
    }
  }
  return mean;
}

}  // namespace

Rendering render_samples(const Scene& scene, const BspTree& tree,
                         const Camera& camera, const ImageOptions& options,
                         std::int32_t samples) {
  const std::vector<Plane> planes = planes_of(scene);
  const std::int32_t width = camera->width_px * samples;
  const std::int32_t height = camera->height_px * samples;
  HALFSPACE_ASSERT(width <= kMaxImageSize && height <= kMaxImageSize);
  // The image, so many times as large.
  Projection projection = projection_of(camera);
  projection.x = times(samples, projection.x);
  projection.y = times(samples, projection.y);
  DynamicScreen screen(width, height);
  Rendering image;
  image.items = ItemImage(width, height, kBackground);
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
  add_caps(scene, camera, options, image.items, samples);
  image.colors =
      ColorImage(camera->width_px, camera->height_px, options.background);
  for (std::int32_t j = 0; j < camera->height_px; ++j) {
    for (std::int32_t i = 0; i < camera->width_px; ++i) {
      image.colors.at(i, j) = rounded_color(
          mean_color(scene, camera, image.items, options, i, j, samples));
    }
  }
  return image;
}

}  // namespace halfspace::ref
