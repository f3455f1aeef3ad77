#include "rounding/snap.hpp"

#include <algorithm>
#include <unordered_set>

#include "rounding/grid_hash.hpp"

namespace halfspace::fast {
namespace {

/// Moves points of a mesh, and notes how far.
class Mover {
 public:
  explicit Mover(GridMesh& mesh) : mesh_(mesh) {}
  void move(std::size_t p, const StepPoint& from, const GridPoint& to) {
    mesh_.points[p] = to;
    mesh_.moved[p] = 1;
    const double far = distance(from, to);
    if (far > largest_.distance) largest_ = {far, to};
  }
  const LargestMove& largest() const { return largest_; }

 private:
  GridMesh& mesh_;
  LargestMove largest_;
};

}  // namespace

LargestMove snap(GridMesh& mesh, const std::vector<LoosePoint>& loose,
                 const FileGrid& grid) {
  std::fill(mesh.moved.begin(), mesh.moved.end(), std::uint8_t{0});
  Mover mover(mesh);
  for (const LoosePoint& p : loose) {
    mover.move(static_cast<std::size_t>(p.point), p.at,
               grid.rounded(p.at, grid.spacing()));
  }
  return mover.largest();
}

LargestMove coarsened(GridMesh& mesh, const MeshContacts& contacts,
                      const FileGrid& grid, std::int64_t width) {
  const auto place_of = [&](std::int32_t p) {
    return grid.rounded(step_point(mesh.at(p)), width);
  };
  std::unordered_set<GridPoint, GridPointHash> places;
  contacts.for_triangles([&](std::int32_t t) {
    for (const std::int32_t c :
         mesh.triangles[static_cast<std::size_t>(t)].corners)
      places.insert(place_of(c));
  });
  Mover mover(mesh);
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    const GridPoint to = place_of(static_cast<std::int32_t>(p));
    if (to != mesh.points[p] && places.contains(to))
      mover.move(p, step_point(mesh.points[p]), to);
  }
  return mover.largest();
}

}  // namespace halfspace::fast
