#include "placing.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "halfspace/csg/trimmed.hpp"
#include "halfspace/io/import.hpp"
#include "halfspace/io/read_mesh.hpp"

namespace halfspace::identities {
namespace {

/// The least and the greatest coordinates.
std::pair<GridPoint, GridPoint> box_of(const std::vector<GridPoint>& points) {
  auto box = std::pair(points.front(), points.front());
  for (const GridPoint& p : points) {
    box.first = {std::min(box.first.x, p.x), std::min(box.first.y, p.y),
                 std::min(box.first.z, p.z)};
    box.second = {std::max(box.second.x, p.x), std::max(box.second.y, p.y),
                  std::max(box.second.z, p.z)};
  }
  return box;
}

std::int64_t size_of(const std::vector<GridPoint>& points) {
  const auto [low, high] = box_of(points);
  return std::max({high.x - low.x, high.y - low.y, high.z - low.z});
}

void move(std::vector<GridPoint>& points, const GridPoint& by) {
  for (GridPoint& p : points) p = {p.x + by.x, p.y + by.y, p.z + by.z};
}

GridPoint minus(const GridPoint& p, const GridPoint& q) {
  return {p.x - q.x, p.y - q.y, p.z - q.z};
}

void centre(std::vector<GridPoint>& points) {
  const auto [low, high] = box_of(points);
  move(points, {-low.x - (high.x - low.x) / 2, -low.y - (high.y - low.y) / 2,
                -low.z - (high.z - low.z) / 2});
}

std::optional<GridSolid> solid_of(SceneData data, int grid_bits) {
  data.grid_bits = grid_bits;
  Result<Scene> scene = make_scene(std::move(data));
  if (!scene) return std::nullopt;
  Result<GridSolid> solid = make_solid(*std::move(scene));
  if (!solid) return std::nullopt;
  return *std::move(solid);
}

/// So that the smaller one is more than half as large as the larger one.
void match_sizes(std::vector<GridPoint>& a, std::vector<GridPoint>& b) {
  if (size_of(a) > size_of(b)) {
    match_sizes(b, a);
    return;
  }
  std::int64_t factor = 1;
  while (2 * factor * size_of(a) <= size_of(b)) factor *= 2;
  for (GridPoint& p : a) p = {p.x * factor, p.y * factor, p.z * factor};
}

GridPoint offset_of(const SceneData& a, const SceneData& b, Position position) {
  const auto [low, high] = box_of(a.vertices);
  const auto [b_low, b_high] = box_of(b.vertices);
  const GridPoint edge =
      minus(a.vertices[static_cast<std::size_t>(a.corners[1])],
            a.vertices[static_cast<std::size_t>(a.corners[0])]);
  switch (position) {
    case Position::kGeneral:
      return {(high.x - low.x) / 7 + 1, (high.y - low.y) / 11 + 2,
              (high.z - low.z) / 13 + 3};
    case Position::kLow:
      return minus(low, b_low);
    case Position::kBeside:
      return minus({high.x, low.y, low.z}, b_low);
    case Position::kVertex:
      return minus(a.vertices.front(), b.vertices.front());
    case Position::kStep:
      return {1, 0, 0};
    case Position::kAlong:
      return edge;
    case Position::kAlongBit: {
      const std::int64_t by = std::gcd(std::gcd(edge.x, edge.y), edge.z);
      return {edge.x / by, edge.y / by, edge.z / by};
    }
    case Position::kSame:
      break;
  }
  return {};
}

}  // namespace

const char* name_of(Position position) {
  constexpr const char* kNames[] = {"general", "low",  "beside", "vertex",
                                    "same",    "step", "along",  "along-bit"};
  return kNames[static_cast<std::size_t>(position)];
}

Result<GridSolid> load(const std::string& path) {
  const Result<io::Mesh> mesh = io::read_mesh(path);
  if (!mesh) return mesh.error();
  Result<io::Imported> imported = io::import_scene(*mesh, {});
  if (!imported) return imported.error();
  if (imported->scene.polygon_count() == 0)
    return Error{ErrorCode::kEmpty, "no polygons", -1};
  SceneData data = csg::trimmed(imported->scene);
  data.unit = {2, 0};
  centre(data.vertices);
  Result<Scene> scene = make_scene(std::move(data));
  if (!scene) return scene.error();
  return make_solid(*std::move(scene));
}

std::optional<std::pair<GridSolid, GridSolid>> placed(const GridSolid& a,
                                                      const GridSolid& b,
                                                      Position position) {
  if (position >= Position::kSame && !(a.scene() == b.scene()))
    return std::nullopt;
  SceneData first = a.scene().data();
  SceneData second = b.scene().data();
  match_sizes(first.vertices, second.vertices);
  move(second.vertices, offset_of(first, second, position));
  const int bits =
      std::max(grid_bits_for(first.vertices), grid_bits_for(second.vertices));
  if (bits == 0 || grid_bits_for(first.vertices) == 0 ||
      grid_bits_for(second.vertices) == 0)
    return std::nullopt;
  auto x = solid_of(std::move(first), bits);
  auto y = solid_of(std::move(second), bits);
  if (!x || !y) return std::nullopt;
  return std::pair(*std::move(x), *std::move(y));
}

}  // namespace halfspace::identities
