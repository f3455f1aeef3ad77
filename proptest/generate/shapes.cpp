#include "generate/shapes.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>

#include "halfspace/assert.hpp"

namespace halfspace::generate {
namespace {

using Polygon = std::vector<GridPoint>;

GridPoint operator+(const GridPoint& p, const GridPoint& q) {
  return {p.x + q.x, p.y + q.y, p.z + q.z};
}

GridPoint operator-(const GridPoint& p, const GridPoint& q) {
  return {p.x - q.x, p.y - q.y, p.z - q.z};
}

GridPoint operator*(std::int64_t k, const GridPoint& p) {
  return {k * p.x, k * p.y, k * p.z};
}

GridPoint vector_at(const Shape& shape, std::size_t first) {
  const auto& n = shape.numbers;
  return {n[first], n[first + 1], n[first + 2]};
}

/// An earlier polygon, or one of its own for the first.
Polygon earlier(const Shape& shape, const Polygons& polygons) {
  if (polygons.empty()) return {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  return polygons[static_cast<std::size_t>(shape.other) % polygons.size()];
}

Polygon copy(const Shape& shape, Polygon polygon) {
  if (shape.numbers[0] < 0) std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

Polygon in_plane(const Shape& shape, const Polygon& polygon) {
  const GridPoint u = polygon[1] - polygon[0];
  const GridPoint v = polygon.back() - polygon[0];
  const auto& n = shape.numbers;
  Polygon result;
  for (std::size_t i = 0; i < 6; i += 2) {
    // Coefficients from -1 to 1, so that the polygons stay small.
    const auto a = static_cast<std::int64_t>(n[i] / 2);
    const auto b = static_cast<std::int64_t>(n[i + 1] / 2);
    result.push_back(polygon[0] + a * u + b * v);
  }
  return result;
}

Polygon on_edge(const Shape& shape, const Polygon& polygon) {
  const auto k = static_cast<std::size_t>(shape.numbers[3] + 4);
  const GridPoint& p = polygon[k % polygon.size()];
  const GridPoint& q = polygon[(k + 1) % polygon.size()];
  // Backwards, as a neighbour runs along it; at times twice as long.
  const std::int64_t length = shape.numbers[4] > 1 ? 2 : 1;
  return {q, q + length * (p - q), vector_at(shape, 0)};
}

Polygon sliver(const Shape& shape) {
  const GridPoint p = vector_at(shape, 0);
  const GridPoint u = vector_at(shape, 3);
  const GridPoint v = vector_at(shape, 6);
  return {p, p + std::int64_t{63} * u, p + std::int64_t{126} * u + v};
}

std::vector<Polygon> box(const GridPoint& low, const GridPoint& high) {
  const auto at = [&](int x, int y, int z) {
    return GridPoint{x != 0 ? high.x : low.x, y != 0 ? high.y : low.y,
                     z != 0 ? high.z : low.z};
  };
  return {{at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0)},
          {at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1)},
          {at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1)},
          {at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0)},
          {at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0)},
          {at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)}};
}

/// The faces between cubes that are there and cubes that are not.
std::vector<Polygon> cubes(const GridPoint& origin, unsigned mask,
                           std::int64_t size) {
  const auto is_there = [&](int x, int y, int z) {
    const bool within = x >= 0 && x < 2 && y >= 0 && y < 2 && z >= 0 && z < 2;
    return within && ((mask >> (4 * x + 2 * y + z)) & 1u) != 0;
  };
  constexpr int kAway[6][3] = {{-1, 0, 0}, {1, 0, 0},  {0, -1, 0},
                               {0, 1, 0},  {0, 0, -1}, {0, 0, 1}};
  std::vector<Polygon> faces;
  for (int cell = 0; cell < 8; ++cell) {
    const int x = cell / 4, y = cell / 2 % 2, z = cell % 2;
    if (!is_there(x, y, z)) continue;
    const GridPoint low = origin + size * GridPoint{x, y, z};
    const auto all = box(low, low + size * GridPoint{1, 1, 1});
    for (std::size_t face = 0; face < 6; ++face) {
      const auto& away = kAway[face];
      if (!is_there(x + away[0], y + away[1], z + away[2]))
        faces.push_back(all[face]);
    }
  }
  return faces;
}

std::vector<Polygon> box_of(const Shape& shape) {
  const GridPoint p = vector_at(shape, 0);
  const GridPoint size = vector_at(shape, 3);
  return box(p, p + GridPoint{1 + std::abs(size.x), 1 + std::abs(size.y),
                              1 + std::abs(size.z)});
}

std::vector<Polygon> cubes_of(const Shape& shape) {
  unsigned mask = 1;
  for (std::size_t i = 3; i < 9; ++i)
    mask = 3 * mask + static_cast<unsigned>(shape.numbers[i] + 4);
  // A full block of eight cubes hides its common corner; leave one out.
  return cubes(vector_at(shape, 0), mask % 255, 1 + shape.other % 2);
}

std::vector<Polygon> tetrahedron_of(const Shape& shape) {
  const GridPoint o = vector_at(shape, 0);
  const GridPoint u = vector_at(shape, 3);
  const GridPoint v = vector_at(shape, 6);
  const GridPoint p = o + u, q = o + v;
  const GridPoint r = o + GridPoint{v.y - u.x, u.z + 2, 3 - v.x};
  const GridPoint w = r - o;
  const std::int64_t volume = u.x * (v.y * w.z - v.z * w.y) -
                              u.y * (v.x * w.z - v.z * w.x) +
                              u.z * (v.x * w.y - v.y * w.x);
  if (volume == 0) return {};
  if (volume < 0) return {{o, p, q}, {o, r, p}, {o, q, r}, {p, r, q}};
  return {{o, q, p}, {o, p, r}, {o, r, q}, {p, q, r}};
}

/// Bars along the sides of a convex polygon. Each rises on its way, so that it
/// lies above the next one where that begins: a cycle.
std::vector<Polygon> pinwheel(const Shape& shape) {
  constexpr std::int64_t kCorners[8][2] = {
      {2, 1}, {1, 2}, {-1, 2}, {-2, 1}, {-2, -1}, {-1, -2}, {1, -2}, {2, -1}};
  const auto count = static_cast<std::size_t>(3 + shape.other % 6);
  const auto corner = [&](std::size_t k) {
    // For few bars, corners that are far apart.
    const auto& c = kCorners[k % count * 8 / count];
    return GridPoint{c[0], c[1], 0};
  };
  const std::int64_t rise = 1 + std::abs(shape.numbers[3]);
  std::vector<Polygon> bars;
  for (std::size_t k = 0; k < count; ++k) {
    const GridPoint side = corner(k + 1) - corner(k);
    const GridPoint start =
        vector_at(shape, 0) + std::int64_t{4} * corner(k) - side;
    const GridPoint along = std::int64_t{6} * side + GridPoint{0, 0, rise};
    const GridPoint across{-side.y, side.x, 0};
    bars.push_back(
        {start, start + along, start + along + across, start + across});
  }
  return bars;
}

/// Four bars round a square hole, lying in the plane of u and v.
void add_ring(const GridPoint& centre, const GridPoint& u, const GridPoint& v,
              std::vector<Polygon>& bars) {
  const auto at = [&](std::int64_t a, std::int64_t b) {
    return centre + a * u + b * v;
  };
  bars.push_back({at(-4, -4), at(4, -4), at(4, -3), at(-4, -3)});
  bars.push_back({at(4, -3), at(4, 3), at(3, 3), at(3, -3)});
  bars.push_back({at(4, 4), at(-4, 4), at(-4, 3), at(4, 3)});
  bars.push_back({at(-4, 3), at(-4, -3), at(-3, -3), at(-3, 3)});
}

std::vector<Polygon> rings(const Shape& shape) {
  const GridPoint centre = vector_at(shape, 0);
  const GridPoint x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  std::vector<Polygon> bars;
  add_ring(centre, x, y, bars);
  add_ring(centre + std::int64_t{4} * x, x,
           z + std::int64_t{shape.numbers[3] / 4} * y, bars);
  return bars;
}

std::vector<Polygon> polygons_of(const Shape& shape, const Polygons& polygons) {
  const GridPoint p = vector_at(shape, 0);
  const GridPoint u = vector_at(shape, 3);
  const GridPoint v = vector_at(shape, 6);
  switch (shape.kind) {
    case ShapeKind::kTriangle:
      return {{p, u, v}};
    case ShapeKind::kParallelogram:
      return {{p, p + u, p + u + v, p + v}};
    case ShapeKind::kStraightCorner:
      return {
          {p + u, p + u + u, p + u + u + v, p + u + v + v, p + v + v, p + v}};
    case ShapeKind::kCopy:
      return {copy(shape, earlier(shape, polygons))};
    case ShapeKind::kInPlane:
      return {in_plane(shape, earlier(shape, polygons))};
    case ShapeKind::kOnEdge:
      return {on_edge(shape, earlier(shape, polygons))};
    case ShapeKind::kSliver:
      return {sliver(shape)};
    case ShapeKind::kBox:
      return box_of(shape);
    case ShapeKind::kCubes:
      return cubes_of(shape);
    case ShapeKind::kTetrahedron:
      return tetrahedron_of(shape);
    case ShapeKind::kPinwheel:
      return pinwheel(shape);
    case ShapeKind::kRings:
      return rings(shape);
  }
  return {};
}

SceneData data_of(const Polygons& polygons, int grid_bits) {
  SceneData data;
  data.grid_bits = grid_bits;
  for (const Polygon& polygon : polygons) {
    for (const GridPoint& point : polygon) {
      data.corners.push_back(static_cast<VertexId>(data.vertices.size()));
      data.vertices.push_back(point);
    }
    data.first_corner.push_back(
        static_cast<std::uint32_t>(data.corners.size()));
    const auto p = data.colors.size();
    data.colors.push_back({static_cast<std::uint8_t>(40 * p + 15),
                           static_cast<std::uint8_t>(90 * p),
                           static_cast<std::uint8_t>(200 - 30 * p)});
  }
  return data;
}

/// Colours at the corners: different ones for triangles.
void color_corners(SceneData& data) {
  for (std::size_t p = 0; p + 1 < data.first_corner.size(); ++p) {
    const std::uint32_t first = data.first_corner[p];
    const std::uint32_t end = data.first_corner[p + 1];
    for (std::uint32_t c = first; c < end; ++c) {
      const std::uint32_t k = end - first == 3 ? c - first : 0;
      data.corner_colors.push_back(
          {static_cast<std::uint8_t>(k == 0 ? 255 : 3 * p),
           static_cast<std::uint8_t>(k == 1 ? 255 - p : 10),
           static_cast<std::uint8_t>(77 * k + 13 * p)});
    }
  }
}

std::int64_t greatest_size(const Polygons& polygons) {
  std::int64_t greatest = 1;
  for (const Polygon& polygon : polygons) {
    for (const GridPoint& p : polygon) {
      greatest =
          std::max({greatest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
  }
  return greatest;
}

/// Moves the corners of triangles by single steps, each its own way.
void jitter(Polygons& polygons) {
  std::int64_t turn = 0;
  for (Polygon& polygon : polygons) {
    if (polygon.size() != 3) continue;
    for (GridPoint& p : polygon) {
      turn = (5 * turn + 7) % 27;
      p = p + GridPoint{turn % 3 - 1, turn / 3 % 3 - 1, turn / 9 - 1};
    }
  }
}

}  // namespace

bool is_valid(const Polygon& polygon) {
  return make_scene(data_of({polygon}, 54)).has_value();
}

void add(const Shape& shape, Polygons& polygons) {
  for (Polygon& polygon : polygons_of(shape, polygons)) {
    if (is_valid(polygon)) polygons.push_back(std::move(polygon));
  }
}

MadeScene make(const SceneRecipe& recipe) {
  Polygons polygons;
  for (const Shape& shape : recipe.shapes) add(shape, polygons);
  if (polygons.size() > recipe.most_polygons)
    polygons.resize(recipe.most_polygons);
  MadeScene made;
  int grid_bits = 26;
  if (recipe.stretch != Stretch::kNone) {
    grid_bits = kGridBits[static_cast<std::size_t>(recipe.stretch) - 1];
    // One step is left for the jitter.
    made.scale =
        ((std::int64_t{1} << (grid_bits - 1)) - 2) / greatest_size(polygons);
    for (Polygon& polygon : polygons) {
      for (GridPoint& p : polygon) p = made.scale * p;
    }
    if (recipe.jitter) jitter(polygons);
    std::erase_if(polygons, [](const Polygon& p) { return !is_valid(p); });
  }
  SceneData data = data_of(polygons, grid_bits);
  if (recipe.corner_colors) color_corners(data);
  auto scene = make_scene(std::move(data));
  HALFSPACE_ASSERT(scene.has_value());
  made.scene = *scene;
  return made;
}

Scene scene_of(const Polygons& polygons, Rgb color) {
  SceneData data = data_of(polygons, 26);
  data.grid_bits = grid_bits_for(data.vertices);
  std::fill(data.colors.begin(), data.colors.end(), color);
  auto scene = make_scene(std::move(data));
  HALFSPACE_ASSERT(scene.has_value());
  return *scene;
}

}  // namespace halfspace::generate
