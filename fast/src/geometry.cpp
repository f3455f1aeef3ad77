#include "geometry.hpp"

namespace halfspace::fast {

Plane Geometry::plane(PlaneId id) const {
  if (!is_free(id)) return plane_of(scene_, id);
  const FreePlane& free = free_plane(id);
  return {free.axis == 0 ? 1.0 : 0.0, free.axis == 1 ? 1.0 : 0.0,
          free.axis == 2 ? 1.0 : 0.0, -static_cast<double>(free.coordinate)};
}

std::array<GridPoint, 2> Geometry::source_edge(PolygonId source,
                                               std::int32_t corner) const {
  const auto corners = scene_.corners(source);
  const auto from = static_cast<std::size_t>(corner);
  const std::size_t to = from + 1 == corners.size() ? 0 : from + 1;
  return {scene_.point(corners[from]), scene_.point(corners[to])};
}

template <int kBits>
int Geometry::exact_sign_on(PolygonId source, EdgeCode before, EdgeCode after,
                            PlaneId plane) const {
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

int Geometry::exact_sign(PolygonId source, EdgeCode before, EdgeCode after,
                         PlaneId plane) const {
  return with_grid(scene_.grid_bits(), [&](auto bits) {
    return exact_sign_on<bits()>(source, before, after, plane);
  });
}

}  // namespace halfspace::fast
