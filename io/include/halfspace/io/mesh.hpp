#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "halfspace/io/attributes.hpp"
#include "halfspace/io/number.hpp"
#include "halfspace/polygon.hpp"

namespace halfspace::io {

/// The colour of surfaces that have none, before they are lit.
inline constexpr Rgb kUsualSurface = {236, 214, 184};

/// A mesh as its file holds it, before anything is rounded or judged (S1.7).
///
/// The corners of face `f` are `corners[first_corner[f]]` up to but not
/// including `corners[first_corner[f + 1]]`; they may be fewer than 3, lie in
/// no plane or repeat, but each names a vertex.
/// Shape: first_corner has one entry more than there are faces; vertex_colors
///        is empty or has one entry a vertex, face_colors empty or one a face.
struct Mesh {
  std::vector<std::array<Number, 3>> vertices;
  std::vector<std::uint32_t> first_corner = {0};
  std::vector<VertexId> corners;
  std::vector<std::optional<Rgb>> vertex_colors;
  std::vector<std::optional<Rgb>> face_colors;
  bool decimal = false;  ///< its numbers were read as decimal text
  /// Whatever else its file has, but not the colours above.
  Attributes attributes;

  std::size_t face_count() const { return first_corner.size() - 1; }
};

/// The faces with all their attributes: those of the mesh, and its colours as
/// channels named `color`.
AttributedFaces attributed_faces(const Mesh& mesh);

}  // namespace halfspace::io
