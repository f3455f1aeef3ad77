#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "halfspace/polygon.hpp"
#include "halfspace/result.hpp"

namespace halfspace::io {

/// The faces of a mesh to write; see OutputMesh.
struct Faces {
  std::span<const std::uint32_t> first_corner;
  std::span<const VertexId> corners;
  std::span<const Rgb> colors;

  std::size_t count() const { return first_corner.size() - 1; }
  std::span<const VertexId> corners_of(std::size_t face) const {
    return corners.subspan(first_corner[face],
                           first_corner[face + 1] - first_corner[face]);
  }
};

using DoublePoint = std::array<double, 3>;

/// The bytes of a file in each format; `points` are three decimals each.
std::string obj_text(std::span<const std::string> points, const Faces& faces);
std::string off_text(std::span<const std::string> points, const Faces& faces);
std::string ply_text(std::span<const std::string> points, const Faces& faces);
std::string ply_binary(std::span<const DoublePoint> points, const Faces& faces);

/// Errors: kNotFinite (a coordinate beyond floats), kOutOfRange (more than
///         2^32 - 1 triangles).
Result<std::string> stl_binary(
    std::span<const DoublePoint> points,
    std::span<const std::array<VertexId, 3>> triangles);

}  // namespace halfspace::io
