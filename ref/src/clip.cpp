#include "halfspace/ref/clip.hpp"

#include "halfspace/ref/split.hpp"
#include "vector.hpp"

namespace halfspace::ref {
namespace {

/// A function value + x dx + y dy of the image point (x, y).
struct Affine {
  Rational value, dx, dy;
};

Affine operator-(const Affine& f, const Affine& g) {
  return {f.value - g.value, f.dx - g.dx, f.dy - g.dy};
}
Affine operator*(const Rational& scale, const Affine& f) {
  return {scale * f.value, scale * f.dx, scale * f.dy};
}

/// The sign at the sample of pixel (i, j) (S4.4).
int sign_at_sample(const Affine& f, std::int32_t i, std::int32_t j) {
  const Rational twice =
      2 * f.value + Rational(2 * i + 1) * f.dx + Rational(2 * j + 1) * f.dy;
  if (const int s = sign(twice)) return s;
  if (const int s = sign(f.dx)) return s;
  return sign(f.dy);
}

/// A plane as the camera sees it: P(e), and P(s) (S4.5), x and y counting
/// samples, so many a pixel.
struct Seen {
  Rational at_eye;
  Affine at_image;

  Seen(const Plane& plane, const Camera& camera, std::int32_t samples) {
    const Rational step = 1 << kLatticeBits;
    const auto along = [&](const LatticeVector& v) {
      return dot(normal_of(plane), to_point(v));
    };
    const auto at = [&](const LatticeVector& v) {
      return along(v) + step * plane.d;
    };
    at_eye = camera->perspective ? at(camera->eye) : along(camera->eye);
    const Rational share = Rational(1) / Rational(samples);
    at_image = {at(camera->s0), share * along(camera->sx),
                share * along(camera->sy)};
  }
};

/// P(e) Q(s) - Q(e) P(s).
Affine crossed(const Seen& p, const Seen& q) {
  return p.at_eye * q.at_image - q.at_eye * p.at_image;
}

/// A polygon of the solid, and the planes through its edges that hold the eye.
struct Wall {
  int side;  ///< of the eye
  Seen plane;
  std::vector<Affine> edges;  ///< positive within
};

Wall wall_of(const Fragment& polygon, const Camera& camera,
             std::int32_t samples) {
  const Plane plane = plane_of(polygon.vertices);
  Wall wall{0, Seen(plane, camera, samples), {}};
  wall.side = sign(wall.plane.at_eye);
  const std::size_t count = polygon.vertices.size();
  for (std::size_t k = 0; k < count; ++k) {
    const Point& p = polygon.vertices[k];
    const Point edge = difference(polygon.vertices[(k + 1) % count], p);
    const Plane inwards = plane_through(cross(normal_of(plane), edge), p);
    wall.edges.push_back(Rational(wall.side) *
                         crossed(wall.plane, Seen(inwards, camera, samples)));
  }
  return wall;
}

/// The winding number at the point of clip plane `cap` that the sample sees,
/// on the kept side: what is behind it adds up to it, for at the end of the ray
/// it is 0. A polygon is behind it where it is on the other side than the eye.
int winding_behind(const std::vector<Wall>& walls, const Seen& cap,
                   std::int32_t i, std::int32_t j) {
  const int side = sign(cap.at_eye);
  int winding = 0;
  for (const Wall& wall : walls) {
    if (wall.side == 0) continue;
    bool is_hit = true;
    for (const Affine& edge : wall.edges)
      is_hit = is_hit && sign_at_sample(edge, i, j) > 0;
    if (!is_hit) continue;
    const int beside =
        wall.side * sign_at_sample(crossed(wall.plane, cap), i, j);
    // A polygon in the plane is behind it for an eye on the kept side, where
    // what is kept comes before it.
    const bool is_behind = beside == 0 ? side > 0 : beside == -side;
    if (is_behind) winding -= wall.side;
  }
  return winding;
}

/// Whether the sample's ray meets the plane where it can be seen.
bool is_met(const Seen& cap, const Camera& camera, std::int32_t i,
            std::int32_t j) {
  const Rational side = sign(cap.at_eye);
  const Affine eye{cap.at_eye, 0, 0};
  if (camera->perspective &&
      sign_at_sample(side * (eye - cap.at_image), i, j) <= 0)
    return false;
  if (!camera->near) return true;
  const Rational unit = 1 << kNearBits;
  const Rational near = *camera->near;
  const Affine beyond = camera->perspective
                            ? (unit - near) * eye - (-near) * cap.at_image
                            : unit * cap.at_image - near * eye;
  return sign_at_sample(side * beyond, i, j) > 0;
}

}  // namespace

Plane function_of(const ClipPlane& clip) {
  return {clip.a, clip.b, clip.c, clip.d};
}

bool is_there(const Plane& plane, const ImageOptions& options) {
  if (!options.caps) return true;
  for (const ClipPlane& clip : options.clips) {
    const Plane c = function_of(clip);
    const Point turn = cross(normal_of(plane), normal_of(c));
    const bool is_parallel = turn == Point{0, 0, 0};
    // Parallel planes are the same if their offsets are in proportion.
    const Rational along = dot(normal_of(plane), normal_of(c));
    const Rational square = dot(normal_of(c), normal_of(c));
    if (is_parallel && plane.d * square == c.d * along) return false;
  }
  return true;
}

std::optional<Fragment> clipped(Fragment fragment,
                                const ImageOptions& options) {
  constexpr PolygonId kNoSplitter = -1;
  for (const ClipPlane& clip : options.clips) {
    const Plane plane = function_of(clip);
    switch (relation(fragment, plane)) {
      case Relation::kPositive:
      case Relation::kCoincident:
        break;
      case Relation::kNegative:
        return std::nullopt;
      case Relation::kSpanning:
        fragment = split(fragment, plane, kNoSplitter).positive;
        break;
    }
  }
  return fragment;
}

void add_caps(const Scene& scene, const Camera& camera,
              const ImageOptions& options, ItemImage& items,
              std::int32_t samples) {
  if (!options.caps || options.clips.empty()) return;
  std::vector<Wall> walls;
  std::vector<Seen> planes;
  const auto count = static_cast<PolygonId>(scene.polygon_count());
  for (PolygonId id = 0; id < count; ++id) {
    walls.push_back(wall_of(whole(scene, id), camera, samples));
    planes.push_back(walls.back().plane);
  }
  std::vector<Seen> caps;
  for (const ClipPlane& clip : options.clips)
    caps.emplace_back(function_of(clip), camera, samples);
  planes.insert(planes.end(), caps.begin(), caps.end());

  const auto shows = [&](std::size_t k, std::int32_t i, std::int32_t j) {
    const int side = sign(caps[k].at_eye);
    if (side == 0 || (options.cull && side > 0)) return false;
    if (!is_met(caps[k], camera, i, j)) return false;
    for (std::size_t other = 0; other < caps.size(); ++other) {
      if (other == k) continue;
      if (side * sign_at_sample(crossed(caps[k], caps[other]), i, j) <= 0)
        return false;
    }
    return winding_behind(walls, caps[k], i, j) > 0;
  };
  const auto is_in_front = [&](PolygonId cap, PolygonId seen, std::int32_t i,
                               std::int32_t j) {
    if (seen == kBackground) return true;
    const Seen& p = planes[static_cast<std::size_t>(cap)];
    const Seen& q = planes[static_cast<std::size_t>(seen)];
    return sign(p.at_eye) * sign(q.at_eye) *
               sign_at_sample(crossed(p, q), i, j) >
           0;
  };
  for (std::int32_t j = 0; j < items.height_px; ++j) {
    for (std::int32_t i = 0; i < items.width_px; ++i) {
      for (std::size_t k = 0; k < caps.size(); ++k) {
        const PolygonId id = count + static_cast<PolygonId>(k);
        if (shows(k, i, j) && is_in_front(id, items.at(i, j), i, j))
          items.at(i, j) = id;
      }
    }
  }
}

}  // namespace halfspace::ref
