#include "caps.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "../vector.hpp"
#include "halfspace/cap_parts.hpp"
#include "halfspace/ref/clip.hpp"

namespace halfspace::ref {
namespace {

Wall wall_of(const Fragment& polygon, const Camera& camera,
             std::int32_t samples) {
  const Plane plane = plane_of(polygon.vertices);
  Wall wall{0, 0, SeenPlane(plane, camera, samples), {}};
  wall.side = sign(wall.plane.at_eye);
  const std::size_t count = polygon.vertices.size();
  for (std::size_t k = 0; k < count; ++k) {
    const Point& p = polygon.vertices[k];
    const Point edge = difference(polygon.vertices[(k + 1) % count], p);
    const Plane inwards = plane_through(cross(normal_of(plane), edge), p);
    wall.edges.push_back(
        Rational(wall.side) *
        crossed(wall.plane, SeenPlane(inwards, camera, samples)));
  }
  return wall;
}

}  // namespace

SeenPlane::SeenPlane(const Plane& plane, const Camera& camera,
                     std::int32_t samples) {
  const Rational step = 1 << kLatticeBits;
  const auto along = [&](const LatticeVector& v) {
    return dot(normal_of(plane), to_point(v));
  };
  const auto at = [&](const LatticeVector& v) {
    return along(v) + step * plane.d;
  };
  at_eye = camera->perspective ? at(camera->eye) : along(camera->eye);
  at_eye = samples * at_eye;
  at_image = {samples * at(camera->s0), along(camera->sx), along(camera->sy)};
}

Affine crossed(const SeenPlane& p, const SeenPlane& q) {
  return p.at_eye * q.at_image - q.at_eye * p.at_image;
}

namespace {

std::vector<PolygonId> all_ids(const Scene& scene) {
  std::vector<PolygonId> ids(scene.polygon_count());
  std::iota(ids.begin(), ids.end(), PolygonId{0});
  return ids;
}

std::vector<Fragment> whole_polygons(const Scene& scene,
                                     std::span<const PolygonId> ids) {
  std::vector<Fragment> polygons;
  for (const PolygonId id : ids) polygons.push_back(whole(scene, id));
  return polygons;
}

}  // namespace

Caps::Caps(const Scene& scene, const Camera& camera,
           const ImageOptions& options, std::int32_t samples)
    : Caps(scene, camera, options, samples, all_ids(scene)) {}

Caps::Caps(const Scene& scene, const Camera& camera,
           const ImageOptions& options, std::int32_t samples,
           std::span<const PolygonId> ids)
    : Caps(whole_polygons(scene, ids), camera, options, samples) {}

Caps::Caps(std::span<const Fragment> polygons, const Camera& camera,
           const ImageOptions& options, std::int32_t samples)
    : cull_(options.cull), parts_(options.parts) {
  for (const Fragment& polygon : polygons) {
    walls_.push_back(wall_of(polygon, camera, samples));
    if (parts_) {
      walls_.back().part =
          parts_->part_of[static_cast<std::size_t>(polygon.source)];
    }
  }
  for (const ClipPlane& clip : options.clips) {
    SeenPlane plane(function_of(clip), camera, samples);
    std::vector<Affine> beside;
    for (const Wall& wall : walls_)
      beside.push_back(crossed(wall.plane, plane));
    planes_.push_back({std::move(plane), {}, std::move(beside)});
  }
  for (std::size_t k = 0; k < planes_.size(); ++k)
    planes_[k].limits = limits_of(camera, k);
}

std::vector<Affine> Caps::limits_of(const Camera& camera, std::size_t k) const {
  const SeenPlane& cap = planes_[k].plane;
  const Rational side = sign(cap.at_eye);
  const Affine eye{cap.at_eye, 0, 0};
  std::vector<Affine> limits;
  if (camera->perspective) limits.push_back(side * (eye - cap.at_image));
  if (camera->near) {
    const Rational unit = 1 << kNearBits;
    const Rational near = *camera->near;
    limits.push_back(side * (camera->perspective
                                 ? (unit - near) * eye + near * cap.at_image
                                 : unit * cap.at_image - near * eye));
  }
  for (std::size_t other = 0; other < planes_.size(); ++other) {
    if (other != k) limits.push_back(side * crossed(cap, planes_[other].plane));
  }
  return limits;
}

std::optional<std::size_t> Caps::part_at(std::size_t k,
                                         const SignOf& sign_of) const {
  const int side = sign(planes_[k].plane.at_eye);
  if (side == 0 || (cull_ && side > 0)) return std::nullopt;
  for (const Affine& limit : planes_[k].limits) {
    if (sign_of(limit) <= 0) return std::nullopt;
  }
  int winding = 0;
  std::vector<std::uint32_t> inside;
  for (const auto& [part, own] : windings_behind(k, sign_of)) {
    winding += own;
    if (own > 0) inside.push_back(part);
  }
  if (winding <= 0) return std::nullopt;
  if (!parts_) return 0;
  return inside.size() == 1 ? inside.front() : parts_->count();
}

/// The winding numbers of parts at the point of the plane that is seen, on the
/// kept side: what is behind it adds up to them, for at the end of the ray they
/// are 0. A polygon is behind it where it is on the other side than the eye.
std::map<std::uint32_t, int> Caps::windings_behind(
    std::size_t k, const SignOf& sign_of) const {
  const int side = sign(planes_[k].plane.at_eye);
  std::map<std::uint32_t, int> windings;
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    const Wall& wall = walls_[w];
    if (wall.side == 0) continue;
    if (!std::all_of(wall.edges.begin(), wall.edges.end(),
                     [&](const Affine& f) { return sign_of(f) > 0; }))
      continue;
    const int beside = wall.side * sign_of(planes_[k].beside[w]);
    // A polygon in the plane is behind it for an eye on the kept side, where
    // what is kept comes before it.
    const bool is_behind = beside == 0 ? side > 0 : beside == -side;
    if (is_behind) windings[wall.part] -= wall.side;
  }
  return windings;
}

std::vector<Affine> Caps::forms() const {
  std::vector<Affine> forms;
  for (const CapPlane& plane : planes_) {
    forms.insert(forms.end(), plane.limits.begin(), plane.limits.end());
    for (std::size_t w = 0; w < walls_.size(); ++w) {
      const Wall& wall = walls_[w];
      if (wall.side == 0) continue;
      forms.insert(forms.end(), wall.edges.begin(), wall.edges.end());
      forms.push_back(plane.beside[w]);
    }
  }
  return forms;
}

namespace {

/// The sign at the sample of pixel (i, j) (S4.4).
int cap_sign_at_sample(const Affine& f, std::int32_t i, std::int32_t j) {
  const int at_centre =
      sign_of_affine(2, f.value, 2 * i + 1, f.dx, 2 * j + 1, f.dy, 0);
  if (at_centre != 0) return at_centre;
  if (const int s = sign(f.dx)) return s;
  return sign(f.dy);
}

}  // namespace

namespace {

/// The item at a pixel's sample: the nearest cap, or `seen` if that is in front
/// of all.
template <class PlaneOf>
PolygonId with_caps(const Caps& caps, const PlaneOf& plane_of_item,
                    PolygonId count, std::int32_t i, std::int32_t j,
                    PolygonId seen, const std::vector<bool>& are_asked) {
  const auto sign_of = [&](const Affine& f) {
    return cap_sign_at_sample(f, i, j);
  };
  for (std::size_t k = 0; k < caps.count(); ++k) {
    if (!are_asked[k]) continue;
    const auto part = caps.part_at(k, sign_of);
    if (!part) continue;
    const PolygonId id = count + number_of({k, *part, false});
    if (seen == kBackground) {
      seen = id;
      continue;
    }
    const SeenPlane& p = plane_of_item(id);
    const SeenPlane& q = plane_of_item(seen);
    if (sign(p.at_eye) * sign(q.at_eye) * sign_of(crossed(p, q)) > 0) seen = id;
  }
  return seen;
}

}  // namespace

namespace {

/// Puts caps into items; `plane_of` tells planes of polygons.
template <class PlaneOf>
void put_caps(const Caps& caps, const PlaneOf& plane_of, PolygonId count,
              const std::vector<bool>& are_asked, ItemImage& items) {
  const auto plane_of_item = [&](PolygonId item) -> const SeenPlane& {
    if (item < count) return plane_of(item);
    return caps.plane(cap_item(static_cast<std::size_t>(item - count)).plane);
  };
  for (std::int32_t j = 0; j < items.height_px; ++j) {
    for (std::int32_t i = 0; i < items.width_px; ++i) {
      items.at(i, j) = with_caps(caps, plane_of_item, count, i, j,
                                 items.at(i, j), are_asked);
    }
  }
}

}  // namespace

void add_caps(const Scene& scene, const Camera& camera,
              const ImageOptions& options, ItemImage& items,
              std::int32_t samples, std::optional<Side> eye) {
  if (!options.caps || options.clips.empty()) return;
  const Caps caps(scene, camera, options, samples);
  std::vector<SeenPlane> planes;
  const auto count = static_cast<PolygonId>(scene.polygon_count());
  for (PolygonId id = 0; id < count; ++id) {
    planes.emplace_back(plane_of(whole(scene, id).vertices), camera, samples);
  }
  std::vector<bool> are_asked;
  for (const ClipPlane& clip : options.clips)
    are_asked.push_back(!eye || side_of_eye(function_of(clip), camera) == *eye);
  const auto seen_plane = [&](PolygonId id) -> const SeenPlane& {
    return planes[static_cast<std::size_t>(id)];
  };
  put_caps(caps, seen_plane, count, are_asked, items);
}

void add_caps_of(std::span<const Fragment> polygons, std::size_t count,
                 const Camera& camera, const ImageOptions& options,
                 ItemImage& items) {
  if (!options.caps || options.clips.empty()) return;
  const Caps caps(polygons, camera, options, 1);
  std::map<PolygonId, SeenPlane> planes;
  for (const Fragment& polygon : polygons) {
    planes.try_emplace(polygon.source, plane_of(polygon.vertices), camera, 1);
  }
  put_caps(
      caps, [&](PolygonId id) -> const SeenPlane& { return planes.at(id); },
      static_cast<PolygonId>(count), std::vector<bool>(caps.count(), true),
      items);
}

PolygonId with_caps_at(const Scene& scene, const Camera& camera,
                       const ImageOptions& options, std::int32_t i,
                       std::int32_t j, PolygonId seen,
                       std::span<const PolygonId> ids) {
  if (!options.caps || options.clips.empty()) return seen;
  const Caps caps(scene, camera, options, 1, ids);
  const auto count = static_cast<PolygonId>(scene.polygon_count());
  std::optional<SeenPlane> own;
  if (seen != kBackground)
    own.emplace(plane_of(whole(scene, seen).vertices), camera, 1);
  const auto plane_of_item = [&](PolygonId item) -> const SeenPlane& {
    if (item < count) return *own;
    return caps.plane(cap_item(static_cast<std::size_t>(item - count)).plane);
  };
  return with_caps(caps, plane_of_item, count, i, j, seen,
                   std::vector<bool>(caps.count(), true));
}

}  // namespace halfspace::ref
