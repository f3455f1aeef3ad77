#include "tree/scene_planes.hpp"

#include <algorithm>
#include <cmath>

namespace halfspace::fast {

Plane ScenePlanes::plane(PlaneId id) const {
  if (!is_free(id)) return plane_of(scene_, id);
  const FreePlane& free = free_plane(id);
  if (free.axis == kSlantedFace) {
    return with_grid(scene_.grid_bits(), [&](auto bits) {
      return rounded(exact_plane<bits()>(face_of(free)));
    });
  }
  return {free.axis == 0 ? 1.0 : 0.0, free.axis == 1 ? 1.0 : 0.0,
          free.axis == 2 ? 1.0 : 0.0, -static_cast<double>(free.coordinate)};
}

std::array<GridPoint, 2> ScenePlanes::source_edge(PolygonId source,
                                                  std::int32_t corner) const {
  const auto corners = scene_.corners(source);
  const auto from = static_cast<std::size_t>(corner);
  const std::size_t to = from + 1 == corners.size() ? 0 : from + 1;
  return {scene_.point(corners[from]), scene_.point(corners[to])};
}

Vertex ScenePlanes::crossing(PolygonId source, EdgeCode edge,
                             const FilterPlane& plane) const {
  if (is_source(edge)) {
    const auto ends = source_edge(source, edge);
    const Vertex p = to_vertex(ends[0]);
    const Vertex q = to_vertex(ends[1]);
    return meet(p, value_at(plane, p, rounding_), q,
                value_at(plane, q, rounding_), rounding_);
  }
  const FilterPlane other = filter_plane(this->plane(splitter_of(edge)));
  const std::array<GridPoint, 3> corners = plane_corners(scene_, source);
  std::array<Vertex, 3> p;
  std::array<Bounded, 3> f;
  std::array<Bounded, 3> g;
  for (std::size_t k = 0; k < 3; ++k) {
    p[k] = to_vertex(corners[k]);
    f[k] = value_at(other, p[k], rounding_);
    g[k] = value_at(plane, p[k], rounding_);
  }
  // The meet is in the polygon, so its extent bounds all three differences.
  double extent = 0;
  for (const VertexId vertex : scene_.corners(source)) {
    const Vertex v = to_vertex(scene_.point(vertex));
    extent = std::max({extent, std::abs(v.x - p[0].x), std::abs(v.y - p[0].y),
                       std::abs(v.z - p[0].z)});
  }
  return meet(p, f, g, extent * (1 + 0x1p-50), rounding_);
}

template <int kBits>
int ScenePlanes::exact_sign_on(PolygonId source, EdgeCode before,
                               EdgeCode after, PlaneId plane) const {
  const ExactPlane<kBits> r = exact<kBits>(plane);
  if (is_source(before) && is_source(after)) {
    // Edges that follow each other in the source: the corner `after` leaves.
    return sign(value_at(r, source_edge(source, after)[0]));
  }
  if (is_source(before) || is_source(after)) {
    const bool first = is_source(before);
    return sign_at_meet<kBits>(
        exact<kBits>(splitter_of(first ? after : before)),
        source_edge(source, first ? before : after), r);
  }
  return sign_at_meet<kBits>(exact<kBits>(splitter_of(before)),
                             exact<kBits>(splitter_of(after)),
                             plane_corners(scene_, source), r);
}

int ScenePlanes::exact_sign(PolygonId source, EdgeCode before, EdgeCode after,
                            PlaneId plane) const {
  return with_grid(scene_.grid_bits(), [&](auto bits) {
    return exact_sign_on<bits()>(source, before, after, plane);
  });
}

}  // namespace halfspace::fast
