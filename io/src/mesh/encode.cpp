#include "mesh/encode.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/binary.hpp"

namespace halfspace::io {
namespace {

void append_color(std::string& text, const Rgb& color) {
  for (const std::uint8_t value : {color.r, color.g, color.b}) {
    text += ' ' + std::to_string(value);
  }
}

/// Whether the length of every face fits a byte, as most readers expect.
bool lengths_fit_bytes(const Faces& faces) {
  for (std::size_t face = 0; face < faces.count(); ++face) {
    if (faces.corners_of(face).size() > 255) return false;
  }
  return true;
}

std::string ply_header(std::size_t points, const Faces& faces,
                       std::string_view encoding) {
  std::string text = "ply\nformat ";
  text += encoding;
  text += " 1.0\ncomment written by halfspace\nelement vertex " +
          std::to_string(points) +
          "\nproperty double x\nproperty double y\nproperty double z\n"
          "element face " +
          std::to_string(faces.count()) + "\nproperty list ";
  text += lengths_fit_bytes(faces) ? "uchar" : "uint";
  text += " int vertex_indices\n";
  if (!faces.colors.empty()) {
    text += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  }
  return text + "end_header\n";
}

void append_face(std::string& text, const Faces& faces, std::size_t face) {
  const auto corners = faces.corners_of(face);
  text += std::to_string(corners.size());
  for (const VertexId corner : corners) text += ' ' + std::to_string(corner);
  if (!faces.colors.empty()) append_color(text, faces.colors[face]);
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

std::string obj_text(std::span<const std::string> points, const Faces& faces) {
  std::string text = "# written by halfspace\n";
  for (const std::string& point : points) text += "v " + point + "\n";
  for (std::size_t face = 0; face < faces.count(); ++face) {
    text += 'f';
    for (const VertexId corner : faces.corners_of(face)) {
      text += ' ' + std::to_string(corner + 1);
    }
    text += '\n';
  }
  return text;
}

std::string off_text(std::span<const std::string> points, const Faces& faces) {
  std::string text = "OFF\n" + std::to_string(points.size()) + " " +
                     std::to_string(faces.count()) + " 0\n";
  for (const std::string& point : points) text += point + "\n";
  for (std::size_t face = 0; face < faces.count(); ++face) {
    append_face(text, faces, face);
  }
  return text;
}

std::string ply_text(std::span<const std::string> points, const Faces& faces) {
  std::string text = ply_header(points.size(), faces, "ascii");
  for (const std::string& point : points) text += point + "\n";
  for (std::size_t face = 0; face < faces.count(); ++face) {
    append_face(text, faces, face);
  }
  return text;
}

std::string ply_binary(std::span<const DoublePoint> points,
                       const Faces& faces) {
  std::string bytes = ply_header(points.size(), faces, "binary_little_endian");
  const bool short_lengths = lengths_fit_bytes(faces);
  for (const DoublePoint& point : points) {
    for (const double coordinate : point) store(bytes, coordinate);
  }
  for (std::size_t face = 0; face < faces.count(); ++face) {
    const auto corners = faces.corners_of(face);
    if (short_lengths) {
      store(bytes, static_cast<std::uint8_t>(corners.size()));
    } else {
      store(bytes, static_cast<std::uint32_t>(corners.size()));
    }
    for (const VertexId corner : corners) store(bytes, corner);
    if (!faces.colors.empty()) store(bytes, faces.colors[face]);
  }
  return bytes;
}

Result<std::string> stl_binary(
    std::span<const DoublePoint> points,
    std::span<const std::array<VertexId, 3>> triangles) {
  if (triangles.size() > std::numeric_limits<std::uint32_t>::max()) {
    return Error{ErrorCode::kOutOfRange,
                 "an STL holds at most 4294967295 triangles, not " +
                     std::to_string(triangles.size())};
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (const double value : points[i]) {
      if (std::isfinite(static_cast<float>(value))) continue;
      return Error{ErrorCode::kNotFinite,
                   "vertex " + std::to_string(i) + " has the coordinate " +
                       std::to_string(value) + ", which no float holds",
                   static_cast<std::int64_t>(i)};
    }
  }
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
