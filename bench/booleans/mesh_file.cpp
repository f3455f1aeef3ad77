#include "booleans/mesh_file.hpp"

#include <algorithm>
#include <cmath>

#include "halfspace/io/number.hpp"
#include "halfspace/io/read_mesh.hpp"

namespace halfspace::bench {

Result<Triangles> read_triangles(const std::filesystem::path& path) {
  const Result<io::Mesh> mesh = io::read_mesh(path);
  if (!mesh) return mesh.error();
  Triangles result;
  for (std::size_t f = 0; f < mesh->face_count(); ++f) {
    const std::uint32_t first = mesh->first_corner[f];
    if (mesh->first_corner[f + 1] - first != 3) {
      return Error{ErrorCode::kNotTriangle,
                   path.string() + ": not a mesh of triangles",
                   static_cast<std::int64_t>(f)};
    }
    result.corners.push_back({mesh->corners[first], mesh->corners[first + 1],
                              mesh->corners[first + 2]});
  }
  const auto coordinate = [](const io::Number& number) {
    return double{static_cast<float>(io::to_double(number))};
  };
  double extent = 0;
  for (const auto& point : mesh->vertices) {
    for (const io::Number& x : point)
      extent = std::max(extent, std::abs(coordinate(x)));
  }
  // Twice as large coordinates, as moving makes them, fit 54 bits.
  const int shift = 51 - std::ilogb(extent);
  for (const auto& point : mesh->vertices) {
    const auto at = [&](std::size_t axis) {
      return std::llround(std::ldexp(coordinate(point[axis]), shift));
    };
    result.points.push_back({at(0), at(1), at(2)});
  }
  return result;
}

BooleanCase mesh_pair(const std::filesystem::path& path, const Triangles& mesh,
                      double turn, std::uint64_t seed) {
  return {path.filename().string() + (turn == 0 ? ", shifted" : ", turned"),
          BooleanOp::kUnion,
          {mesh, moved(mesh, turn, seed)}};
}

}  // namespace halfspace::bench
