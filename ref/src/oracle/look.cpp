#include "halfspace/ref/oracle/look.hpp"

#include <algorithm>

#include "halfspace/assert.hpp"
#include "halfspace/ref/oracle/painter.hpp"
#include "halfspace/ref/predicate.hpp"
#include "halfspace/ref/scalars.hpp"
#include "halfspace/ref/shade.hpp"

namespace halfspace::ref {
namespace {

/// The means of so many colours each way, each channel rounded half up.
ColorImage means_of(const ColorImage& colors, std::int32_t samples) {
  ColorImage means(colors.width_px / samples, colors.height_px / samples, {});
  const Rational share = Rational(1) / Rational(samples * samples);
  for (std::int32_t j = 0; j < means.height_px; ++j) {
    for (std::int32_t i = 0; i < means.width_px; ++i) {
      ExactColor mean = {0, 0, 0};
      for (std::int32_t s = 0; s < samples * samples; ++s) {
        const ExactColor own = exact(
            colors.at(i * samples + s % samples, j * samples + s / samples));
        for (std::size_t c = 0; c < 3; ++c) mean[c] += share * own[c];
      }
      means.at(i, j) = rounded_color(mean);
    }
  }
  return means;
}

/// The painter with these colours: with an alpha of 255 what is in front hides
/// what is behind.
Rendering painted_look(const Scene& scene, const BspTree& tree,
                       const Camera& camera, const ImageOptions& options,
                       const Look& look, const PointColor& color_of) {
  Rendering image = blend_in_colors(scene, tree, camera, options, look.alpha,
                                    color_of, look.samples);
  image.colors = means_of(image.colors, look.samples);
  return image;
}

}  // namespace

Rendering render_look(const Scene& scene, const BspTree& tree,
                      const Camera& camera, const ImageOptions& options,
                      const Look& look) {
  if (look.alpha == kOpaque && !look.mark)
    return render_samples(scene, tree, camera, options, look.samples);
  const std::vector<Plane> planes = planes_of(scene);
  return painted_look(
      scene, tree, camera, options, look,
      [&](PolygonId polygon, const ImagePoint& at) {
        const Rgb own = rounded_color(
            exact_color_at(scene, camera, polygon, at, options.shading));
        const Plane& plane = planes[static_cast<std::size_t>(polygon)];
        const bool is_marked =
            look.mark && side_of_eye(plane, camera) == Side::kNegative;
        return is_marked ? marked(*look.mark, own) : own;
      });
}

Rendering render_look(const Scene& scene, const BspTree& tree,
                      const Camera& camera, const ImageOptions& options,
                      const Look& look, const ScalarField& field,
                      const ColorScale& scale) {
  HALFSPACE_ASSERT(!look.mark);
  return painted_look(scene, tree, camera, options, look,
                      [&](PolygonId polygon, const ImagePoint& at) {
                        return scalar_color(scene, camera, options, field,
                                            scale, polygon, at);
                      });
}

}  // namespace halfspace::ref
