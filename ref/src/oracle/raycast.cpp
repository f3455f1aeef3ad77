#include "halfspace/ref/oracle/raycast.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "halfspace/assert.hpp"
#include "halfspace/ref/clip.hpp"
#include "halfspace/ref/shade.hpp"

namespace halfspace::ref {
namespace {

/// The number c0 + c1 e + c2 e^2, e > 0 infinitely small.
///
/// In every product here one factor is a plain rational, so that the degree
/// stays 2 and nothing is cut off.
struct Infinitesimal {
  Rational c0, c1, c2;
};

Infinitesimal operator+(const Infinitesimal& a, const Infinitesimal& b) {
  return {a.c0 + b.c0, a.c1 + b.c1, a.c2 + b.c2};
}

Infinitesimal operator-(const Infinitesimal& a, const Infinitesimal& b) {
  return {a.c0 - b.c0, a.c1 - b.c1, a.c2 - b.c2};
}

Infinitesimal operator*(const Rational& scale, const Infinitesimal& a) {
  return {scale * a.c0, scale * a.c1, scale * a.c2};
}

Infinitesimal operator*(const Infinitesimal& a, const Infinitesimal& b) {
  if (sign(a.c1) == 0 && sign(a.c2) == 0) return a.c0 * b;
  HALFSPACE_ASSERT(sign(b.c1) == 0 && sign(b.c2) == 0);
  return b.c0 * a;
}

/// The sign for every small enough e: that of the first term not zero.
int sign(const Infinitesimal& a) {
  for (const Rational& term : {a.c0, a.c1, a.c2}) {
    if (const int s = sign(term)) return s;
  }
  return 0;
}

/// A vector of space. Units: lattice steps.
template <class Number>
struct Vector {
  Number x, y, z;

  friend Vector operator+(const Vector& u, const Vector& v) {
    return {u.x + v.x, u.y + v.y, u.z + v.z};
  }
  friend Vector operator-(const Vector& u, const Vector& v) {
    return {u.x - v.x, u.y - v.y, u.z - v.z};
  }
};

using Fixed = Vector<Rational>;
using Moving = Vector<Infinitesimal>;

template <class Number>
Number dot(const Fixed& u, const Vector<Number>& v) {
  return u.x * v.x + u.y * v.y + u.z * v.z;
}

Fixed cross(const Fixed& u, const Fixed& v) {
  return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

Moving times(const Infinitesimal& scale, const Fixed& v) {
  return {v.x * scale, v.y * scale, v.z * scale};
}

template <class Number>
Vector<Number> times(const Rational& scale, const Vector<Number>& v) {
  return {scale * v.x, scale * v.y, scale * v.z};
}

Moving to_moving(const Fixed& v) {
  return {{v.x, 0, 0}, {v.y, 0, 0}, {v.z, 0, 0}};
}

Fixed to_vector(const LatticeVector& v) { return {v.x, v.y, v.z}; }

/// The ray through a sample: eye + t (s - eye) in perspective, s - t eye else.
struct Ray {
  bool perspective;
  Fixed eye;
  Moving s;
};

Ray ray_through(const Camera& camera, std::int32_t i, std::int32_t j) {
  const Rational half = Rational(1) / Rational(2);
  const Infinitesimal x{Rational(i) + half, 1, 0};
  const Infinitesimal y{Rational(j) + half, 0, 1};
  return {camera->perspective, to_vector(camera->eye),
          to_moving(to_vector(camera->s0)) + times(x, to_vector(camera->sx)) +
              times(y, to_vector(camera->sy))};
}

/// A polygon in space.
struct Polygon {
  std::vector<Fixed> corners;
  Plane plane;  ///< in grid steps
  Fixed normal;
  /// For each edge, a vector in the plane that points from it to the inside.
  std::vector<Fixed> inwards;
  /// The plane at the eye: h(eye), or normal . eye where it is a direction.
  Rational at_eye;
};

Polygon polygon_of(const Scene& scene, PolygonId id, const Camera& camera) {
  Polygon polygon;
  const Rational scale = 1 << kLatticeBits;
  for (const VertexId vertex : scene.corners(id)) {
    const GridPoint& p = scene.point(vertex);
    polygon.corners.push_back({scale * p.x, scale * p.y, scale * p.z});
  }
  const Plane plane = plane_of(whole(scene, id).vertices);
  polygon.plane = plane;
  polygon.normal = {plane.a, plane.b, plane.c};
  const std::size_t count = polygon.corners.size();
  for (std::size_t k = 0; k < count; ++k) {
    const Fixed edge = polygon.corners[(k + 1) % count] - polygon.corners[k];
    polygon.inwards.push_back(cross(polygon.normal, edge));
  }
  const Fixed eye = to_vector(camera->eye);
  polygon.at_eye =
      dot(polygon.normal, camera->perspective ? eye - polygon.corners[0] : eye);
  return polygon;
}

/// Where a ray meets a plane: the ray parameter t is depth / weight, and the
/// point is point / weight. The weight is positive.
struct Hit {
  Infinitesimal depth;
  Infinitesimal weight;
  Moving point;
};

/// The meeting point of the ray and the polygon's plane, if there is one.
///
/// With h the plane's function, eye + t (s - eye) is in the plane where
/// t = h(eye) / (h(eye) - h(s)), which is the point
/// (h(eye) s - h(s) eye) / (h(eye) - h(s)); and s - t eye is in it where
/// t = h(s) / (n . eye), the point ((n . eye) s - h(s) eye) / (n . eye).
std::optional<Hit> meet(const Ray& ray, const Polygon& polygon) {
  const Infinitesimal at_s =
      dot(polygon.normal, ray.s - to_moving(polygon.corners[0]));
  const Infinitesimal at_eye{polygon.at_eye, 0, 0};
  Hit hit;
  hit.depth = ray.perspective ? at_eye : at_s;
  hit.weight = ray.perspective ? at_eye - at_s : at_eye;
  hit.point = times(polygon.at_eye, ray.s) - times(at_s, ray.eye);
  const int orientation = sign(hit.weight);
  // Never true: no plane is parallel to every ray, nor to one at a sample; of
  // those that are so in an orthographic view can_be_seen() leaves none.
  if (orientation == 0) return std::nullopt;
  hit.depth = Rational(orientation) * hit.depth;
  hit.weight = Rational(orientation) * hit.weight;
  hit.point = times(Rational(orientation), hit.point);
  return hit;
}

/// Whether the hit is beyond the near distance (S4.3).
bool is_seen(const Hit& hit, const Camera& camera) {
  if (!camera->perspective && !camera->near) return true;
  const Rational unit = 1 << kNearBits;
  const Rational near = camera->near.value_or(0);
  return sign(unit * hit.depth - near * hit.weight) > 0;
}

/// Whether the hit point is on the inner side of every edge.
bool is_inside(const Hit& hit, const Polygon& polygon) {
  for (std::size_t k = 0; k < polygon.corners.size(); ++k) {
    // inwards . (point / weight - corner), times the weight.
    const Infinitesimal side =
        dot(polygon.inwards[k], hit.point) -
        dot(polygon.inwards[k], polygon.corners[k]) * hit.weight;
    if (sign(side) <= 0) return false;
  }
  return true;
}

/// Whether the hit point is on no clip plane's negative side (S10.2).
bool is_kept(const Hit& hit, const ImageOptions& options) {
  for (const ClipPlane& clip : options.clips) {
    const Fixed normal{clip.a, clip.b, clip.c};
    const Rational offset = Rational(1 << kLatticeBits) * Rational(clip.d);
    if (sign(dot(normal, hit.point) + offset * hit.weight) < 0) return false;
  }
  return true;
}

/// Whether `a` comes before `b` on their ray: the weights are positive.
bool is_before(const Hit& a, const Hit& b) {
  return sign(a.depth * b.weight - b.depth * a.weight) < 0;
}

/// Whether the ray hits the polygon before `first`, which then is that hit.
bool hits_first(const Ray& ray, const Polygon& polygon, const Camera& camera,
                const ImageOptions& options, std::optional<Hit>& first) {
  std::optional<Hit> hit = meet(ray, polygon);
  // Never true: see meet().
  if (!hit) return false;
  if (!is_seen(*hit, camera)) return false;
  if (first && !is_before(*hit, *first)) return false;
  if (!is_inside(*hit, polygon)) return false;
  if (!is_kept(*hit, options)) return false;
  first = std::move(hit);
  return true;
}

/// Whether an eye in its plane, or culling, leaves the polygon to be seen.
bool can_be_seen(const Polygon& polygon, const ImageOptions& options) {
  const int side = sign(polygon.at_eye);
  if (!is_there(polygon.plane, options)) return false;
  return side != 0 && !(options.cull && side < 0);
}

/// The plane of the eye and of a line of the image, positive to the right of
/// a column's boundary or below a row's.
struct Boundary {
  Fixed point, normal;
};

/// The boundaries 0 to `count` between the rows, or the columns: image lines
/// that run `along`, one `across` after the other.
std::vector<Boundary> boundaries(const Camera& camera, const Fixed& along,
                                 const Fixed& across, std::int32_t count) {
  const Fixed eye = to_vector(camera->eye);
  std::vector<Boundary> result;
  for (std::int32_t k = 0; k <= count; ++k) {
    const Fixed point = to_vector(camera->s0) + times(Rational(k), across);
    const Fixed normal = cross(camera->perspective ? point - eye : eye, along);
    result.push_back(
        {point, times(Rational(sign(dot(normal, across))), normal)});
  }
  return result;
}

/// Which strips between neighbouring boundaries the polygon has points in. A
/// ray within another strip misses it, wherever the eye is: so this saves
/// rays, and changes nothing.
std::vector<bool> strips_of(const Polygon& polygon,
                            const std::vector<Boundary>& boundaries) {
  const auto some_corner = [&](const Boundary& boundary, int side) {
    return std::any_of(
        polygon.corners.begin(), polygon.corners.end(), [&](const Fixed& p) {
          return sign(dot(boundary.normal, p - boundary.point)) == side;
        });
  };
  std::vector<bool> strips;
  for (std::size_t k = 0; k + 1 < boundaries.size(); ++k) {
    strips.push_back(some_corner(boundaries[k], 1) &&
                     some_corner(boundaries[k + 1], -1));
  }
  return strips;
}

}  // namespace

Rendering raycast(const Scene& scene, const Camera& camera,
                  const ImageOptions& options) {
  const std::int32_t width = camera->width_px;
  const std::int32_t height = camera->height_px;
  const Fixed sx = to_vector(camera->sx);
  const Fixed sy = to_vector(camera->sy);
  const auto columns = boundaries(camera, sy, sx, width);
  const auto rows = boundaries(camera, sx, sy, height);

  // The polygons that an eye in their plane, or culling, leaves to be seen,
  // by the rows and columns that they touch.
  std::vector<Polygon> polygons(scene.polygon_count());
  std::vector<std::vector<bool>> columns_of(polygons.size());
  std::vector<std::vector<PolygonId>> in_row(static_cast<std::size_t>(height));
  Rendering image;
  for (PolygonId id = 0; id < std::ssize(polygons); ++id) {
    Polygon polygon = polygon_of(scene, id, camera);
    if (!can_be_seen(polygon, options)) continue;
    ++image.fragments_displayed;
    const std::vector<bool> touched = strips_of(polygon, rows);
    for (std::size_t j = 0; j < touched.size(); ++j) {
      if (touched[j]) in_row[j].push_back(id);
    }
    columns_of[static_cast<std::size_t>(id)] = strips_of(polygon, columns);
    polygons[static_cast<std::size_t>(id)] = std::move(polygon);
  }

  image.items = ItemImage(width, height, kBackground);
  for (std::int32_t j = 0; j < height; ++j) {
    for (std::int32_t i = 0; i < width; ++i) {
      const Ray ray = ray_through(camera, i, j);
      std::optional<Hit> first;
      for (const PolygonId id : in_row[static_cast<std::size_t>(j)]) {
        const auto index = static_cast<std::size_t>(id);
        if (!columns_of[index][static_cast<std::size_t>(i)]) continue;
        if (!hits_first(ray, polygons[index], camera, options, first)) continue;
        image.items.at(i, j) = id;
        ++image.pixels_painted;
      }
    }
  }

  add_caps(scene, camera, options, image.items);
  image.colors = colors_of(scene, camera, image.items, options);
  return image;
}

PolygonId raycast_at(const Scene& scene, const Camera& camera,
                     const ImageOptions& options, std::int32_t i,
                     std::int32_t j, std::span<const PolygonId> ids) {
  const Ray ray = ray_through(camera, i, j);
  PolygonId seen = kBackground;
  std::optional<Hit> first;
  for (const PolygonId id : ids) {
    const Polygon polygon = polygon_of(scene, id, camera);
    if (!can_be_seen(polygon, options)) continue;
    if (hits_first(ray, polygon, camera, options, first)) seen = id;
  }
  return seen;
}

}  // namespace halfspace::ref
