#include "mesh/encode.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/binary.hpp"
#include "mesh/writers.hpp"

namespace halfspace::io {
namespace {

void append_color(std::string& text, const Rgb& color) {
  for (const std::uint8_t value : {color.r, color.g, color.b}) {
    text += ' ' + std::to_string(value);
  }
}

void append_face(std::string& text, const Faces& faces, std::size_t face) {
  const auto corners = faces.corners_of(face);
  text += std::to_string(corners.size());
  for (const VertexId corner : corners) text += ' ' + std::to_string(corner);
  if (faces.is_colored(face)) append_color(text, faces.colors[face]);
  text += '\n';
}

using FloatPoint = std::array<float, 3>;

FloatPoint unit_normal(const std::array<FloatPoint, 3>& corners) {
  std::array<double, 3> u{};
  std::array<double, 3> v{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    u[axis] = double{corners[1][axis]} - double{corners[0][axis]};
    v[axis] = double{corners[2][axis]} - double{corners[0][axis]};
  }
  const std::array<double, 3> n = {u[1] * v[2] - u[2] * v[1],
                                   u[2] * v[0] - u[0] * v[2],
                                   u[0] * v[1] - u[1] * v[0]};
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  FloatPoint unit{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (length > 0) unit[axis] = static_cast<float>(n[axis] / length);
  }
  return unit;
}

}  // namespace

std::string off_text(std::span<const std::string> points, const Faces& faces) {
  std::string text = "OFF\n" + std::to_string(points.size()) + " " +
                     std::to_string(faces.count()) + " 0\n";
  for (const std::string& point : points) {
    text += point;
    text += '\n';
  }
  for (std::size_t face = 0; face < faces.count(); ++face) {
    append_face(text, faces, face);
  }
  return text;
}

std::optional<Error> beyond_floats(std::span<const DoublePoint> points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (const double value : points[i]) {
      if (std::isfinite(static_cast<float>(value))) continue;
      return Error{ErrorCode::kNotFinite,
                   "vertex " + std::to_string(i) + " has the coordinate " +
                       std::to_string(value) + ", which no float holds",
                   static_cast<std::int64_t>(i)};
    }
  }
  return std::nullopt;
}

Result<std::string> stl_binary(
    std::span<const DoublePoint> points,
    std::span<const std::array<VertexId, 3>> triangles) {
  if (triangles.size() > std::numeric_limits<std::uint32_t>::max()) {
    return Error{ErrorCode::kOutOfRange,
                 "an STL holds at most 4294967295 triangles, not " +
                     std::to_string(triangles.size())};
  }
  if (auto error = beyond_floats(points)) return *error;
  std::string bytes = "binary STL written by halfspace";
  bytes.resize(80, ' ');
  store(bytes, static_cast<std::uint32_t>(triangles.size()));
  for (const auto& triangle : triangles) {
    std::array<FloatPoint, 3> corners{};
    for (std::size_t i = 0; i < 3; ++i) {
      const DoublePoint& point = points[static_cast<std::size_t>(triangle[i])];
      std::transform(point.begin(), point.end(), corners[i].begin(),
                     [](double value) { return static_cast<float>(value); });
    }
    for (const float value : unit_normal(corners)) store(bytes, value);
    for (const FloatPoint& corner : corners) {
      for (const float value : corner) store(bytes, value);
    }
    store(bytes, std::uint16_t{0});
  }
  return bytes;
}

}  // namespace halfspace::io
