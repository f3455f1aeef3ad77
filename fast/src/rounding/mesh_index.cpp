#include "rounding/mesh_index.hpp"

#include <algorithm>
#include <numeric>

namespace halfspace::fast {

Box box_of(const GridMesh& mesh, const GridTriangle& triangle) {
  Bounds bounds;
  for (const std::int32_t c : triangle.corners) {
    const GridPoint& p = mesh.at(c);
    bounds.add({static_cast<double>(p.x), static_cast<double>(p.y),
                static_cast<double>(p.z), 0});
  }
  return bounds.box();
}

MeshIndex::MeshIndex(const GridMesh& mesh) : places_(mesh.triangles.size()) {
  std::iota(places_.begin(), places_.end(), 0);
  tree_.emplace(
      [&](std::int32_t t) {
        return box_of(mesh, mesh.triangles[static_cast<std::size_t>(t)]);
      },
      places_);
}

void MeshIndex::follow(GridMesh& mesh, const std::vector<std::uint8_t>& moved) {
  if (is_empty()) return;
  std::fill(places_.begin(), places_.end(), -1);
  std::vector<std::int32_t> changed;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    GridTriangle& triangle = mesh.triangles[t];
    const auto id = static_cast<std::int32_t>(t);
    if (has_marked_corner(triangle, moved)) triangle.number = -1;
    if (triangle.number < 0)
      changed.push_back(id);
    else
      places_[static_cast<std::size_t>(triangle.number)] = id;
  }
  changed_count_ = changed.size();
  changed_.emplace(
      [&](std::int32_t t) {
        return box_of(mesh, mesh.triangles[static_cast<std::size_t>(t)]);
      },
      changed);
}

void MeshIndex::keep_up(GridMesh& mesh) {
  constexpr std::size_t kMuch = 8;
  if (!is_empty() && kMuch * changed_count_ <= mesh.triangles.size()) return;
  *this = MeshIndex(mesh);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    mesh.triangles[t].number = static_cast<std::int32_t>(t);
}

}  // namespace halfspace::fast
