#include "halfspace/ref/zbuffer.hpp"

#include <algorithm>
#include <vector>

#include "covering.hpp"
#include "halfspace/ref/shade.hpp"

namespace halfspace::ref {
namespace {

/// The sign at the sample of pixel (i, j) (S4.4): that of the value at the
/// centre, else of the x-derivative, else of the y-derivative.
int sign_at_sample(const Affine& f, std::int32_t i, std::int32_t j) {
  // Twice the value: the centre is (2i + 1, 2j + 1) / 2.
  const Rational twice =
      2 * f.value + Rational(2 * i + 1) * f.dx + Rational(2 * j + 1) * f.dy;
  if (const int s = sign(twice)) return s;
  if (const int s = sign(f.dx)) return s;
  return sign(f.dy);
}

/// Columns and rows of pixels, ends included.
struct Bounds {
  std::int32_t left, right, top, bottom;
};

/// Bounds of the pixels that the polygon can cover: no more than a saving.
Bounds bounds_of(const std::vector<Vector>& corners, const Eye& eye,
                 const Camera& camera) {
  const std::int32_t width = camera->width_px;
  const std::int32_t height = camera->height_px;
  const Bounds whole{0, width - 1, 0, height - 1};
  const Vector depth =
      eye.perspective ? eye.s0 - eye.eye : Vector{0, 0, 0} - eye.eye;
  const Rational volume = determinant(eye.sx, eye.sy, depth);
  const auto pixel = [](const Rational& value, std::int32_t size) {
    const Rational clamped =
        std::clamp(floor(value), Rational(-1), Rational(size));
    return static_cast<std::int32_t>(clamped.to_int64());
  };
  Bounds bounds{width, -1, height, -1};
  for (const Vector& p : corners) {
    const Vector v = p - (eye.perspective ? eye.eye : eye.s0);
    // v = X sx + Y sy + t depth, all three times `volume`.
    const Rational t = determinant(eye.sx, eye.sy, v);
    const Rational w = eye.perspective ? t : volume;
    if (sign(w) * sign(volume) <= 0) return whole;
    const std::int32_t i = pixel(determinant(v, eye.sy, depth) / w, width);
    const std::int32_t j = pixel(determinant(eye.sx, v, depth) / w, height);
    bounds = {std::min(bounds.left, i), std::max(bounds.right, i),
              std::min(bounds.top, j), std::max(bounds.bottom, j)};
  }
  return {std::max(bounds.left, 0), std::min(bounds.right, width - 1),
          std::max(bounds.top, 0), std::min(bounds.bottom, height - 1)};
}

bool covers(const Covering& polygon, std::int32_t i, std::int32_t j) {
  return std::all_of(
      polygon.insides.begin(), polygon.insides.end(),
      [&](const Affine& f) { return sign_at_sample(f, i, j) > 0; });
}

/// Whether `f` is nearer than `g` at the sample.
bool is_nearer(const Affine& f, const Affine& g, std::int32_t i,
               std::int32_t j) {
  const Affine by{f.value - g.value, f.dx - g.dx, f.dy - g.dy};
  return sign_at_sample(by, i, j) > 0;
}

}  // namespace

Rendering zbuffer(const Scene& scene, const Camera& camera,
                  const ImageOptions& options) {
  const Eye eye(camera);
  const std::vector<Plane> planes = planes_of(scene);
  Rendering image;
  image.items = ItemImage(camera->width_px, camera->height_px, kBackground);
  // The buffer of depths: for each pixel, that of the polygon seen so far.
  Grid2<const Affine*> nearest(camera->width_px, camera->height_px, nullptr);
  std::vector<Covering> polygons(scene.polygon_count());

  for (PolygonId id = 0; id < std::ssize(polygons); ++id) {
    const auto index = static_cast<std::size_t>(id);
    const std::vector<Vector> corners = lattice_corners(scene, id);
    auto covering = covering_of(corners, planes[index], eye, options.cull);
    if (!covering) continue;
    polygons[index] = *std::move(covering);
    ++image.fragments_displayed;

    const Covering& polygon = polygons[index];
    const Bounds bounds = bounds_of(corners, eye, camera);
    for (std::int32_t j = bounds.top; j <= bounds.bottom; ++j) {
      for (std::int32_t i = bounds.left; i <= bounds.right; ++i) {
        if (!covers(polygon, i, j)) continue;
        const Affine*& depth = nearest.at(i, j);
        if (depth && !is_nearer(polygon.nearness, *depth, i, j)) continue;
        depth = &polygon.nearness;
        image.items.at(i, j) = id;
        ++image.pixels_painted;
      }
    }
  }

  image.colors = colors_of(scene, camera, image.items, options);
  return image;
}

}  // namespace halfspace::ref
