#include "halfspace/ref/area_image.hpp"

#include <algorithm>
#include <set>

#include "halfspace/cap_parts.hpp"
#include "halfspace/ref/shade.hpp"

namespace halfspace::ref {
namespace {

Rational clamped(const Rational& value, std::int32_t least) {
  return std::clamp(value, Rational(least), Rational(least + 1));
}

/// The integral of f over [from, to], for a polynomial of degree 3 at most
/// (Simpson's rule).
template <class Function>
Rational integral(const Rational& from, const Rational& to, const Function& f) {
  const Rational middle = (from + to) / Rational(2);
  return (to - from) / Rational(6) *
         (f(from) + Rational(4) * f(middle) + f(to));
}

/// What an arc that goes down adds for the key on its side of smaller x: the
/// integrals of 1, x and y over the part of the pixel left of it, in the rows
/// that it passes.
Moments left_of(const ImagePoint& from, const ImagePoint& to, std::int32_t i,
                std::int32_t j) {
  Moments sum;
  const Rational slope = (to.x - from.x) / (to.y - from.y);
  const auto x_at = [&](const Rational& y) {
    return clamped(from.x + slope * (y - from.y), i);
  };
  // Step 1: cut it where it passes the pixel's rows and columns.
  std::vector<Rational> cuts = {clamped(from.y, j), clamped(to.y, j)};
  if (sign(slope) != 0) {
    for (const std::int32_t x : {i, i + 1}) {
      const Rational y = from.y + (Rational(x) - from.x) / slope;
      if (cuts[0] < y && y < cuts[1]) cuts.push_back(y);
    }
  }
  std::sort(cuts.begin(), cuts.end());
  // Step 2: between cuts x is an affine function of y.
  const Rational left = i;
  for (std::size_t k = 1; k < cuts.size(); ++k) {
    const auto add = [&](Rational& moment, const auto& f) {
      moment += integral(cuts[k - 1], cuts[k], f);
    };
    add(sum.area, [&](const Rational& y) { return x_at(y) - left; });
    add(sum.x, [&](const Rational& y) {
      const Rational x = x_at(y);
      return (x * x - left * left) / Rational(2);
    });
    add(sum.y, [&](const Rational& y) { return y * (x_at(y) - left); });
  }
  return sum;
}

}  // namespace

Moments moments_of(const std::vector<MapArc>& map, std::int32_t key,
                   std::int32_t i, std::int32_t j) {
  Moments sum;
  for (const MapArc& arc : map) {
    if ((arc.left == key) == (arc.right == key) || arc.from.y == arc.to.y)
      continue;
    const bool down = arc.from.y < arc.to.y;
    const Moments part = down ? left_of(arc.from, arc.to, i, j)
                              : left_of(arc.to, arc.from, i, j);
    // The side of smaller x is the right one of an arc that goes down.
    const Rational count = (arc.right == key) == down ? 1 : -1;
    sum.area += count * part.area;
    sum.x += count * part.x;
    sum.y += count * part.y;
  }
  return sum;
}

ColorImage render_area(const Scene& scene, const Camera& camera,
                       const ImageOptions& options) {
  const std::vector<MapArc> map = section_map(scene, camera, options);
  const auto polygons = static_cast<std::int32_t>(scene.polygon_count());
  std::set<std::int32_t> keys;
  for (const MapArc& arc : map) keys.insert({arc.left, arc.right});
  keys.erase(kOutsideKey);
  ColorImage image(camera->width_px, camera->height_px, options.background);
  for (std::int32_t j = 0; j < image.height_px; ++j) {
    for (std::int32_t i = 0; i < image.width_px; ++i) {
      ExactColor sum = {0, 0, 0};
      for (const std::int32_t key : keys) {
        const Moments seen = moments_of(map, key, i, j);
        if (sign(seen.area) == 0) continue;
        const ImagePoint centroid = {seen.x / seen.area, seen.y / seen.area};
        ExactColor color = exact(options.background);
        if (key >= polygons) {
          color = exact(color_of(
              options, cap_item(static_cast<std::size_t>(key - polygons))));
        } else if (key != kBackgroundKey) {
          color = exact_color_at(scene, camera, key, centroid, options.shading);
        }
        for (std::size_t c = 0; c < 3; ++c) sum[c] += seen.area * color[c];
      }
      image.at(i, j) = rounded_color(sum);
    }
  }
  return image;
}

}  // namespace halfspace::ref
