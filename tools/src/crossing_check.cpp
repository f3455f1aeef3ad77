#include "crossing_check.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "halfspace/fast/crossings.hpp"
#include "halfspace/fast/solid.hpp"

namespace halfspace::tools {
namespace {

using Vector = std::array<double, 3>;

Vector cross(const Vector& u, const Vector& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
          u[0] * v[1] - u[1] * v[0]};
}

double dot(const Vector& u, const Vector& v) {
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

/// The point in grid steps, about: it is for people.
Vector about_at(const fast::Solid& solid, std::int32_t vertex) {
  const fast::SolidVertex at = fast::vertex_at(solid, vertex);
  const auto doubles = [](const GridPoint& p) {
    return Vector{static_cast<double>(p.x), static_cast<double>(p.y),
                  static_cast<double>(p.z)};
  };
  if (at.is_grid) return doubles(at.point);
  std::array<Vector, 3> n;
  Vector offset{};
  for (std::size_t i = 0; i < 3; ++i) {
    const fast::SolidPlane plane = fast::plane_at(solid, at.planes[i]);
    for (std::size_t k = 0; k < 3; ++k)
      n[i][k] = static_cast<double>(plane.normal[k]);
    offset[i] = dot(n[i], doubles(plane.origin));
  }
  Vector point{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector other = cross(n[(i + 1) % 3], n[(i + 2) % 3]);
    for (std::size_t k = 0; k < 3; ++k)
      point[k] += offset[i] * other[k] / dot(n[i], other);
  }
  return point;
}

}  // namespace

Result<Done> without_crossings(const Solid& solid) {
  const fast::Solid exact = fast::to_solid(solid);
  const auto crossings = fast::crossings(exact);
  if (crossings.empty()) return Done{};
  const fast::Crossing& first = crossings.front();
  const auto polygon = [&](std::int32_t face) {
    return exact.faces[static_cast<std::size_t>(face)].polygon;
  };
  const Vector at = about_at(exact, first.vertex);
  const Unit unit = solid.scene().unit();
  const double step = std::pow(static_cast<double>(unit.base), unit.exponent);
  char text[160];
  std::snprintf(text, sizeof text,
                "polygons %d and %d %s near %.9g, %.9g, %.9g",
                polygon(first.first), polygon(first.second),
                first.in_plane ? "overlap" : "cross", step * at[0],
                step * at[1], step * at[2]);
  std::string sentence = "the surface crosses itself: " + std::string(text);
  if (crossings.size() > 1) {
    sentence += ", and " + std::to_string(crossings.size() - 1) +
                " more pairs do such things";
  }
  return Error{ErrorCode::kNotClosed, sentence, polygon(first.first)};
}

}  // namespace halfspace::tools
