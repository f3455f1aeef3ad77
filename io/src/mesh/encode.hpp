#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/io/attributes.hpp"
#include "halfspace/polygon.hpp"
#include "halfspace/result.hpp"

namespace halfspace::io {

/// The faces of a mesh to write; see OutputMesh.
struct Faces {
  std::span<const std::uint32_t> first_corner;
  std::span<const VertexId> corners;
  std::span<const Rgb> colors;                   ///< empty: no face has one
  const std::vector<bool>* has_color = nullptr;  ///< by face; null: all have

  bool is_colored(std::size_t face) const {
    return !colors.empty() && (has_color == nullptr || (*has_color)[face]);
  }
  std::size_t count() const { return first_corner.size() - 1; }
  std::span<const VertexId> corners_of(std::size_t face) const {
    return corners.subspan(first_corner[face],
                           first_corner[face + 1] - first_corner[face]);
  }
};

using DoublePoint = std::array<double, 3>;

/// The bytes of a file in each format; `points` are three decimals each.
/// Attributes, which may be null, are those of the faces and their corners.
/// `library` is the file that has the materials; empty: they are not named.
/// `textures` are what the file calls the images, by material; empty: as the
/// materials say.
std::string obj_text(std::span<const std::string> points, const Faces& faces,
                     const Attributes* attributes = nullptr,
                     std::string_view library = {});
std::string off_text(std::span<const std::string> points, const Faces& faces);
std::string ply_text(std::span<const std::string> points, const Faces& faces,
                     const Attributes* attributes = nullptr,
                     std::span<const std::string> textures = {});
std::string ply_binary(std::span<const DoublePoint> points, const Faces& faces,
                       const Attributes* attributes = nullptr,
                       std::span<const std::string> textures = {});

/// All digits of a double: no more than 17 + 1074 of them.
std::string all_digits(double value);

/// The file of materials of an OBJ; empty if no face has one, or a colour.
std::string mtl_text(const Attributes& attributes,
                     std::span<const std::string> textures = {});

/// What a file calls the image of a material.
inline const std::string& texture_of(const Attributes& attributes,
                                     std::span<const std::string> textures,
                                     std::size_t material) {
  return textures.empty() ? attributes.materials[material].texture
                          : textures[material];
}

/// Whether all corners of a vertex have the same numbers; then those of each
/// vertex, kNoValue of those without corners.
std::optional<std::vector<double>> by_vertex(const Channel& channel,
                                             std::span<const VertexId> corners,
                                             std::size_t vertex_count);

/// Errors: kNotFinite (a coordinate beyond floats), kOutOfRange (more than
///         2^32 - 1 triangles).
Result<std::string> stl_binary(
    std::span<const DoublePoint> points,
    std::span<const std::array<VertexId, 3>> triangles);

}  // namespace halfspace::io
