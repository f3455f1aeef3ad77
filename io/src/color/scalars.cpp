#include "halfspace/io/scalars.hpp"

#include <cmath>

namespace halfspace::io {
namespace {

Error count_error(std::size_t count, std::size_t vertices, std::size_t faces) {
  return {ErrorCode::kOutOfRange,
          "there are " + std::to_string(count) + " numbers for " +
              std::to_string(vertices) + " vertices or " +
              std::to_string(faces) + " faces",
          static_cast<std::int64_t>(count)};
}

/// Where the numbers belong, by how many there are.
Result<ScalarPlace> place_of(const ScalarColumn& column, std::size_t vertices,
                             std::size_t faces) {
  const std::size_t count = column.values.size();
  const bool fits_vertices = count == vertices;
  const bool fits_faces = count == faces;
  if (column.place) {
    const bool fits =
        *column.place == ScalarPlace::kVertices ? fits_vertices : fits_faces;
    if (!fits) return count_error(count, vertices, faces);
    return *column.place;
  }
  if (fits_vertices && fits_faces) {
    return Error{ErrorCode::kOutOfRange,
                 "there are as many vertices as faces, " +
                     std::to_string(count) +
                     "; say which of them the numbers belong to"};
  }
  if (!fits_vertices && !fits_faces) return count_error(count, vertices, faces);
  return fits_vertices ? ScalarPlace::kVertices : ScalarPlace::kFaces;
}

}  // namespace

Result<ScalarField> scalars_of(const LoadedScene& loaded,
                               const ScalarColumn& column) {
  const Scene& scene = loaded.file.scene;
  const Result<ScalarPlace> place =
      place_of(column, loaded.report.vertices, loaded.report.polygons);
  if (!place) return place.error();
  ScalarField field;
  field.at_corners = *place == ScalarPlace::kVertices;
  if (!field.at_corners) {
    for (const PolygonId face : loaded.polygons)
      field.values.push_back(column.values[static_cast<std::size_t>(face)]);
    return make_scalars(scene, std::move(field));
  }
  const bool has_own = loaded.corner_vertices.empty() && loaded.is_scene_file;
  const std::vector<VertexId>& vertices =
      has_own ? scene.data().corners : loaded.corner_vertices;
  if (vertices.size() != scene.data().corners.size()) {
    return Error{ErrorCode::kOutOfRange,
                 "the vertices of this file are not kept apart; numbers can "
                 "only belong to its faces"};
  }
  for (const VertexId vertex : vertices)
    field.values.push_back(column.values[static_cast<std::size_t>(vertex)]);
  return make_scalars(scene, std::move(field));
}

}  // namespace halfspace::io
