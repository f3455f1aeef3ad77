#include "scene/lost_area.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <span>
#include <string>

#include "halfspace/io/load_scene.hpp"

namespace halfspace::io {
namespace {

using Integers3 = std::array<Integer, 3>;

std::span<const VertexId> corners_of(const Mesh& mesh, std::size_t face) {
  const std::size_t first = mesh.first_corner[face];
  return std::span(mesh.corners)
      .subspan(first, mesh.first_corner[face + 1] - first);
}

const std::array<Number, 3>& point(const Mesh& mesh, VertexId corner) {
  return mesh.vertices[static_cast<std::size_t>(corner)];
}

/// The corners as integers, in a unit that all of them are multiples of.
std::vector<Integers3> integers_of(const Mesh& mesh,
                                   std::span<const VertexId> corners) {
  std::int32_t two = std::numeric_limits<std::int32_t>::max();
  std::int32_t five = two;
  for (const VertexId corner : corners) {
    for (const Number& number : point(mesh, corner)) {
      if (number.mantissa == 0) continue;
      two = std::min(two, number.two);
      five = std::min(five, number.five);
    }
  }
  std::vector<Integers3> points;
  for (const VertexId corner : corners) {
    Integers3& at = points.emplace_back();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Number& number = point(mesh, corner)[axis];
      if (number.mantissa == 0) continue;
      at[axis] = number.mantissa *
                 pow(Integer(5), static_cast<unsigned>(number.five - five));
      at[axis] <<= number.two - two;
    }
  }
  return points;
}

bool are_parallel(const Integers3& u, const Integers3& v) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (u[i] * v[j] != u[j] * v[i]) return false;
  }
  return true;
}

/// Whether the face's corners are not all on one line.
bool has_area(const Mesh& mesh, std::size_t face) {
  const auto corners = corners_of(mesh, face);
  if (corners.size() < 3) return false;
  std::vector<Integers3> points = integers_of(mesh, corners);
  const Integers3 start = points.front();
  std::optional<Integers3> along;
  for (Integers3& at : points) {
    for (std::size_t axis = 0; axis < 3; ++axis) at[axis] -= start[axis];
    if (at == Integers3{}) continue;
    if (!along) along = at;
    if (!are_parallel(*along, at)) return true;
  }
  return false;
}

/// How far the face reaches along an axis.
double reach_of(const Mesh& mesh, std::size_t face) {
  double reach = 0;
  for (const VertexId corner : corners_of(mesh, face)) {
    for (const Number& number : point(mesh, corner))
      reach = std::max(reach, std::abs(to_double(number)));
  }
  return reach;
}

}  // namespace

std::optional<Error> lost_area_error(const Mesh& mesh,
                                     const std::vector<bool>& kept,
                                     const ImportReport& report) {
  const auto kept_count =
      static_cast<std::size_t>(std::count(kept.begin(), kept.end(), true));
  if (report.dropped <= kept_count) return std::nullopt;
  std::size_t lost = 0;
  for (std::size_t face = 0; face < kept.size(); ++face)
    if (!kept[face] && has_area(mesh, face)) ++lost;
  if (lost <= kept_count) return std::nullopt;
  std::size_t farthest = 0;
  double reach = 0;
  for (std::size_t face = 0; face < kept.size(); ++face) {
    const double its =
        corners_of(mesh, face).size() < 3 ? 0 : reach_of(mesh, face);
    if (its > reach) farthest = face;
    reach = std::max(reach, its);
  }
  char number[32];
  std::snprintf(number, sizeof number, "%g", reach);
  return Error{ErrorCode::kOutOfRange,
               "polygon " + std::to_string(farthest) + " reaches as far as " +
                   number + "; on the grid of " + to_string(report.unit) +
                   " that holds it " + std::to_string(lost) + " of the " +
                   std::to_string(kept.size()) +
                   " polygons have no area left; correct that polygon, or put "
                   "what is so small beside it into a file of its own",
               static_cast<std::int64_t>(farthest)};
}

}  // namespace halfspace::io
