#include "halfspace/ref/oracle/zbuffer.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "halfspace/ref/clip.hpp"
#include "halfspace/ref/shade.hpp"

namespace halfspace::ref {
namespace {

/// A vector of space, or a homogeneous point without its last coordinate.
/// Units: lattice steps.
struct Vector {
  Rational x, y, z;
};

Vector operator-(const Vector& u, const Vector& v) {
  return {u.x - v.x, u.y - v.y, u.z - v.z};
}

Rational determinant(const Vector& u, const Vector& v, const Vector& w) {
  return u.x * (v.y * w.z - v.z * w.y) - u.y * (v.x * w.z - v.z * w.x) +
         u.z * (v.x * w.y - v.y * w.x);
}

Vector to_vector(const LatticeVector& v) { return {v.x, v.y, v.z}; }

/// A function value + x dx + y dy of the image point (x, y).
struct Affine {
  Rational value, dx, dy;
};

Affine operator*(const Rational& scale, const Affine& f) {
  return {scale * f.value, scale * f.dx, scale * f.dy};
}

/// The sign at the sample of pixel (i, j) (S4.4): that of the value at the
/// centre, else of the x-derivative, else of the y-derivative.
int sign_at_sample(const Affine& f, std::int32_t i, std::int32_t j) {
  // Twice the value: the centre is (2i + 1, 2j + 1) / 2.
  const int at_centre =
      sign_of_affine(2, f.value, 2 * i + 1, f.dx, 2 * j + 1, f.dy, 0);
  if (at_centre != 0) return at_centre;
  if (const int s = sign(f.dx)) return s;
  return sign(f.dy);
}

/// The camera in rationals, with the point s of the image as the affine
/// function s0 + x sx + y sy (S4.1).
struct Eye {
  explicit Eye(const Camera& camera)
      : perspective(camera->perspective),
        eye(to_vector(camera->eye)),
        s0(to_vector(camera->s0)),
        sx(to_vector(camera->sx)),
        sy(to_vector(camera->sy)),
        near(camera->near) {}

  bool perspective;
  Vector eye, s0, sx, sy;
  std::optional<std::int64_t> near;
};

/// A polygon prepared for its pixels.
struct Covering {
  /// The sample is covered where all of these are positive (S4.5).
  std::vector<Affine> insides;
  /// The greater, the nearer: 1/t less 1 in perspective, else -t (S5.3).
  Affine nearness;
};

/// The plane's function of the image point: P(s) (S4.5). The plane is given
/// by a point of it, and its normal.
struct Support {
  Vector point, normal;

  Rational along(const Vector& v) const {
    return normal.x * v.x + normal.y * v.y + normal.z * v.z;
  }
  Rational at(const Vector& p) const { return along(p - point); }
  Affine at_image(const Eye& eye) const {
    return {at(eye.s0), along(eye.sx), along(eye.sy)};
  }
};

/// Where the ray passes an edge from p to q: an affine function that is
/// positive where an eye on the positive side sees the image point on the
/// polygon's side of the edge (S4.5).
///
/// That is the sign of P(e) Q(s) - Q(e) P(s), whatever plane Q holds the edge:
/// the side of s against the plane through the edge and the eye.
Affine side_of_edge(const Vector& p, const Vector& q, const Eye& eye) {
  if (eye.perspective) {
    const Vector to_p = p - eye.eye;
    const Vector to_q = q - eye.eye;
    return {determinant(to_q, to_p, eye.s0 - eye.eye),
            determinant(to_q, to_p, eye.sx), determinant(to_q, to_p, eye.sy)};
  }
  const Vector edge = q - p;
  return {determinant(eye.eye, edge, eye.s0 - p),
          determinant(eye.eye, edge, eye.sx),
          determinant(eye.eye, edge, eye.sy)};
}

/// The near condition t > near / 2^16, multiplied out to be affine, for an
/// eye on the positive side (S4.5).
///
/// In perspective t = P(e) / (P(e) - P(s)), else t = P(s) / (n . eye).
/// Requires: eye.near.
Affine beyond_near(const Rational& plane_at_eye, const Affine& plane_at_image,
                   const Eye& eye) {
  const Rational unit = 1 << kNearBits;
  const Rational near = *eye.near;
  if (eye.perspective) {
    Affine f = near * plane_at_image;
    f.value += (unit - near) * plane_at_eye;
    return f;
  }
  Affine f = unit * plane_at_image;
  f.value -= near * plane_at_eye;
  return f;
}

/// P(e) C(s) - C(e) P(s) for a clip plane C, in lattice steps (S10.2).
Affine side_of_clip(const Rational& plane_at_eye, const Affine& plane_at_image,
                    const ClipPlane& clip, const Eye& eye) {
  const Rational offset = Rational(1 << kLatticeBits) * Rational(clip.d);
  const auto along = [&clip](const Vector& v) {
    return Rational(clip.a) * v.x + Rational(clip.b) * v.y +
           Rational(clip.c) * v.z;
  };
  const Rational at_eye =
      eye.perspective ? along(eye.eye) + offset : along(eye.eye);
  const Affine at_image{along(eye.s0) + offset, along(eye.sx), along(eye.sy)};
  const Affine p = plane_at_eye * at_image;
  const Affine q = at_eye * plane_at_image;
  return {p.value - q.value, p.dx - q.dx, p.dy - q.dy};
}

/// The polygon as its pixels need it; nothing if it covers none: its plane
/// contains the eye, or it is seen from behind and culled.
std::optional<Covering> covering_of(const std::vector<Vector>& corners,
                                    const Plane& plane, const Eye& eye,
                                    const ImageOptions& options) {
  const Support support{corners[0], {plane.a, plane.b, plane.c}};
  const Rational plane_at_eye =
      eye.perspective ? support.at(eye.eye) : support.along(eye.eye);
  const int sigma = sign(plane_at_eye);
  if (sigma == 0 || (options.cull && sigma < 0)) return std::nullopt;
  if (!is_there(plane, options)) return std::nullopt;

  Covering covering;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vector& next = corners[(k + 1) % corners.size()];
    covering.insides.push_back(Rational(sigma) *
                               side_of_edge(corners[k], next, eye));
  }
  const Affine plane_at_image = support.at_image(eye);
  // Without a near distance the signs above leave out what is behind the eye.
  if (eye.near) {
    covering.insides.push_back(Rational(sigma) *
                               beyond_near(plane_at_eye, plane_at_image, eye));
  }
  for (const ClipPlane& clip : options.clips) {
    const Affine side = side_of_clip(plane_at_eye, plane_at_image, clip, eye);
    // Zero where the polygon lies in the clip plane, and stays.
    if (sign(side.value) == 0 && sign(side.dx) == 0 && sign(side.dy) == 0)
      continue;
    covering.insides.push_back(Rational(sigma) * side);
  }
  // 1/t - 1 = -P(s) / P(e) in perspective, else -t = -P(s) / (n . eye).
  covering.nearness = Rational(-1) / plane_at_eye * plane_at_image;
  return covering;
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
    std::vector<Vector> corners;
    for (const VertexId vertex : scene.corners(id)) {
      const GridPoint& p = scene.point(vertex);
      const Rational scale = 1 << kLatticeBits;
      corners.push_back({scale * p.x, scale * p.y, scale * p.z});
    }
    auto covering = covering_of(corners, planes[index], eye, options);
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

  add_caps(scene, camera, options, image.items);
  image.colors = colors_of(scene, camera, image.items, options);
  return image;
}

}  // namespace halfspace::ref
