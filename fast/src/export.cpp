#include "halfspace/fast/export.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <utility>

#include "parallel.hpp"
#include "space.hpp"
#include "triangulate.hpp"

namespace halfspace::fast {
namespace {

/// One grid step in model units. A power of ten is rounded, and applied to
/// numbers that are divided by it where it is less than one.
double scaled(double value, Unit unit) {
  if (unit.base == 2) return std::ldexp(value, unit.exponent);
  return unit.exponent < 0 ? value / std::pow(10.0, -unit.exponent)
                           : value * std::pow(10.0, unit.exponent);
}

/// A polygon of the mesh by points' ids, then by vertices.
struct Polygon {
  std::vector<std::int32_t> corners;
  std::int32_t face = 0;
};

/// Adds the polygons of the faces from `first` to before `last`.
void add_polygons(const Solid& solid, std::size_t first, std::size_t last,
                  bool triangles, std::vector<Polygon>& polygons) {
  std::vector<std::array<std::int32_t, 3>> parts;
  std::vector<std::vector<std::int32_t>> joined;
  for (std::size_t f = first; f < last; ++f) {
    const auto id = static_cast<std::int32_t>(f);
    const Face& face = solid.faces[f];
    if (!triangles || face.edge_count == 3) {
      auto loop = convex_loop(
          solid, face,
          std::span(solid.edges).subspan(face.first_edge, face.edge_count));
      if (!loop.empty()) {
        polygons.push_back({std::move(loop), id});
        continue;
      }
    }
    parts.clear();
    triangulate(solid, face, parts);
    if (!triangles) {
      joined.clear();
      join_convex(solid, face, parts, joined);
      for (auto& part : joined) polygons.push_back({std::move(part), id});
      continue;
    }
    for (const auto& part : parts)
      polygons.push_back({{part.begin(), part.end()}, id});
  }
}

std::vector<Polygon> polygons_of(const Solid& solid,
                                 const ExportOptions& options) {
  constexpr std::size_t kBlock = 256;
  std::vector<std::vector<Polygon>> blocks((solid.faces.size() + kBlock - 1) /
                                           kBlock);
  for_blocks(options.threads, solid.faces.size(), kBlock,
             [&](std::size_t number, std::size_t first, std::size_t last) {
               add_polygons(solid, first, last, options.triangles,
                            blocks[number]);
             });
  std::vector<Polygon> polygons;
  for (auto& block : blocks) {
    polygons.insert(polygons.end(), std::make_move_iterator(block.begin()),
                    std::make_move_iterator(block.end()));
  }
  return polygons;
}

/// Puts the vertices that the polygons have in the mesh, in the order of their
/// coordinates, and their numbers there in place of the points' ids.
void add_vertices(const Solid& solid, std::vector<Polygon>& polygons,
                  ExportedMesh& mesh) {
  const Space& space = *solid.space;
  std::vector<std::int32_t> numbers(space.vertex_count(), -1);
  std::vector<std::int32_t> used;
  for (const Polygon& polygon : polygons) {
    for (const std::int32_t v : polygon.corners) {
      std::int32_t& number = numbers[static_cast<std::size_t>(v)];
      if (number < 0) used.push_back(v);
      number = 0;
    }
  }
  std::sort(used.begin(), used.end(), [&](std::int32_t u, std::int32_t v) {
    for (int axis = 0; axis < 3; ++axis) {
      const int order = space.compare(axis, u, v);
      if (order != 0) return order < 0;
    }
    return false;
  });
  for (const std::int32_t v : used) {
    numbers[static_cast<std::size_t>(v)] =
        static_cast<std::int32_t>(mesh.vertices.size());
    bool rounded = false;
    std::array<double, 3> at = space.nearest(v, rounded);
    for (double& coordinate : at) coordinate = scaled(coordinate, solid.unit);
    mesh.vertices.push_back(at);
    if (!rounded && solid.unit.base == 2) continue;
    // Half a unit in the last place, and 2^-51 for a power of ten and what is
    // done with it.
    const double size =
        std::max({std::abs(at[0]), std::abs(at[1]), std::abs(at[2])});
    ++mesh.moved;
    mesh.max_move = std::max(mesh.max_move,
                             size * (solid.unit.base == 2 ? 0x1p-53 : 0x1p-50));
  }
  for (Polygon& polygon : polygons) {
    for (std::int32_t& v : polygon.corners)
      v = numbers[static_cast<std::size_t>(v)];
    std::rotate(
        polygon.corners.begin(),
        std::min_element(polygon.corners.begin(), polygon.corners.end()),
        polygon.corners.end());
  }
}

/// Whether a corner surely turns to the left as seen from outside.
bool surely_turns(const ExportedMesh& mesh, const Polygon& polygon,
                  std::size_t i, const Plane& normal, double sign) {
  const auto at = [&](std::size_t k) -> const std::array<double, 3>& {
    return mesh.vertices[static_cast<std::size_t>(
        polygon.corners[(i + k) % polygon.corners.size()])];
  };
  std::array<double, 3> u, v;
  double size = 0, length = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    u[k] = at(1)[k] - at(0)[k];
    v[k] = at(2)[k] - at(0)[k];
    size = std::max({size, std::abs(u[k]), std::abs(v[k])});
    length = std::max(
        {length, std::abs(normal.a), std::abs(normal.b), std::abs(normal.c)});
  }
  const double value = normal.a * (u[1] * v[2] - u[2] * v[1]) +
                       normal.b * (u[2] * v[0] - u[0] * v[2]) +
                       normal.c * (u[0] * v[1] - u[1] * v[0]);
  // Six products of three factors, each with five roundings or fewer.
  return sign * value > 64 * kRounding * length * size * size;
}

}  // namespace

ExportedMesh exported(const Solid& solid, const ExportOptions& options) {
  ExportedMesh mesh;
  if (solid.faces.empty()) return mesh;
  auto polygons = polygons_of(solid, options);
  add_vertices(solid, polygons, mesh);
  std::sort(
      polygons.begin(), polygons.end(), [](const Polygon& p, const Polygon& q) {
        return p.corners != q.corners ? p.corners < q.corners : p.face < q.face;
      });
  for (const Polygon& polygon : polygons) {
    const Face& face = solid.faces[static_cast<std::size_t>(polygon.face)];
    const Plane& normal = solid.space->plane(face.plane).filter.plane;
    // A convex polygon may have straight corners: one sure corner is enough to
    // tell where it faces.
    bool turned = true;
    for (std::size_t i = 0; i < polygon.corners.size() && turned; ++i)
      turned = !surely_turns(mesh, polygon, i, normal, face.turned ? -1 : 1);
    if (turned)
      mesh.turned.push_back(static_cast<std::int32_t>(mesh.faces.size()));
    mesh.corners.insert(mesh.corners.end(), polygon.corners.begin(),
                        polygon.corners.end());
    mesh.first_corner.push_back(
        static_cast<std::uint32_t>(mesh.corners.size()));
    mesh.faces.push_back(polygon.face);
    mesh.colors.push_back(face.color);
  }
  return mesh;
}

}  // namespace halfspace::fast
