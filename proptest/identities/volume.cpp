#include "volume.hpp"

#include <array>

namespace halfspace::identities {
namespace {

using fast::Solid;
using ref::Rational;
using Vector = std::array<Rational, 3>;

Vector cross(const Vector& u, const Vector& v) {
  Vector result;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    result[k] = u[i] * v[j] - u[j] * v[i];
  }
  return result;
}

Rational dot(const Vector& u, const Vector& v) {
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

Vector vector_of(const GridPoint& p) { return {p.x, p.y, p.z}; }

Vector point_at(const Solid& solid, std::int32_t v) {
  const fast::SolidVertex vertex = fast::vertex_at(solid, v);
  if (vertex.is_grid) return vector_of(vertex.point);
  // Cramer's rule, as for any three planes.
  std::array<Vector, 3> n;
  Vector offset;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto plane = fast::plane_at(solid, vertex.planes[i]);
    n[i] = {plane.normal[0], plane.normal[1], plane.normal[2]};
    offset[i] = dot(n[i], vector_of(plane.origin));
  }
  Vector sum;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector product = cross(n[(i + 1) % 3], n[(i + 2) % 3]);
    for (std::size_t k = 0; k < 3; ++k) sum[k] += offset[i] * product[k];
  }
  const Rational below = dot(n[0], cross(n[1], n[2]));
  return {sum[0] / below, sum[1] / below, sum[2] / below};
}

}  // namespace

void VolumeSum::add(const Solid& solid, int factor) {
  any_.table = solid.table;
  for (const fast::Face& face : solid.faces) {
    for (std::uint32_t i = 0; i < face.edge_count; ++i) {
      const fast::SolidEdge& edge = solid.edges[face.first_edge + i];
      if (edge.from < edge.to)
        terms_[{face.plane, edge.from, edge.to}] += factor;
      else
        terms_[{face.plane, edge.to, edge.from}] -= factor;
    }
  }
}

Rational VolumeSum::times6() const {
  std::map<std::int32_t, Vector> points;
  const auto point = [&](std::int32_t v) -> const Vector& {
    const auto [at, is_new] = points.try_emplace(v);
    if (is_new) at->second = point_at(any_, v);
    return at->second;
  };
  Rational total, of_plane;
  std::int32_t last = -1;
  for (const auto& [edge, count] : terms_) {
    if (count == 0) continue;
    const auto& [plane, from, to] = edge;
    if (plane != last) {
      total += of_plane;
      of_plane = 0;
      last = plane;
    }
    const Vector origin = vector_of(fast::plane_at(any_, plane).origin);
    of_plane += Rational(count) * dot(origin, cross(point(from), point(to)));
  }
  return total + of_plane;
}

}  // namespace halfspace::identities
