#include <algorithm>
#include <array>
#include <utility>

#include "generate/generate.hpp"
#include "generate/shapes.hpp"
#include "halfspace/assert.hpp"

namespace halfspace::generate {
namespace {

namespace gen = rc::gen;

using Coordinates = std::array<std::int64_t, 3>;

GridPoint point(const Coordinates& c) { return {c[0], c[1], c[2]}; }

/// A double pyramid over a square, its diagonals along two axes: the square
/// lies in a plane of the grid, where boxes have their faces.
Polygons octahedron(const Coordinates& centre, const Coordinates& radius) {
  const auto tip = [&](std::size_t axis, int sign) {
    Coordinates c = centre;
    c[axis] += sign * radius[axis];
    return point(c);
  };
  Polygons polygons;
  for (const int x : {-1, 1}) {
    for (const int y : {-1, 1}) {
      for (const int z : {-1, 1}) {
        std::vector<GridPoint> triangle{tip(0, x), tip(1, y), tip(2, z)};
        if (x * y * z < 0) std::swap(triangle[0], triangle[1]);
        polygons.push_back(std::move(triangle));
      }
    }
  }
  return polygons;
}

/// Half a box, cut along a diagonal of the face across `axis`.
Polygons wedge(const Coordinates& low, const Coordinates& size,
               std::size_t axis) {
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto at = [&](int along, int right, int up) {
    Coordinates c = low;
    c[axis] += along * size[axis];
    c[u] += right * size[u];
    c[v] += up * size[v];
    return point(c);
  };
  return {{at(0, 0, 1), at(0, 1, 0), at(0, 0, 0)},
          {at(1, 0, 0), at(1, 1, 0), at(1, 0, 1)},
          {at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0)},
          {at(0, 1, 0), at(0, 0, 1), at(1, 0, 1), at(1, 1, 0)},
          {at(0, 0, 1), at(0, 0, 0), at(1, 0, 0), at(1, 0, 1)}};
}

Polygons box(const Coordinates& low, const Coordinates& size) {
  Polygons polygons;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const bool far : {false, true}) {
      std::vector<GridPoint> face;
      for (const auto& [right, up] :
           {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
        Coordinates c = low;
        c[axis] += far ? size[axis] : 0;
        c[u] += right * size[u];
        c[v] += up * size[v];
        face.push_back(point(c));
      }
      if (!far) std::swap(face[1], face[3]);
      polygons.push_back(std::move(face));
    }
  }
  return polygons;
}

/// An octahedron half sunk into a face of the box round the polygons: its
/// square lies in that face, often with nothing else in common, and passes
/// through it.
Polygons sunk(const Polygons& polygons, const std::vector<int>& numbers) {
  Coordinates low{100, 100, 100}, high{-100, -100, -100};
  for (const auto& polygon : polygons) {
    for (const GridPoint& p : polygon) {
      const Coordinates c{p.x, p.y, p.z};
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], c[k]);
        high[k] = std::max(high[k], c[k]);
      }
    }
  }
  Coordinates centre;
  for (std::size_t k = 0; k < 3; ++k) centre[k] = (low[k] + high[k]) / 2;
  const auto axis = static_cast<std::size_t>(numbers[7] % 3);
  centre[axis] = numbers[0] % 2 == 0 ? high[axis] : low[axis];
  const std::int64_t radius = numbers[1] == 0 ? 2 : 1;
  return octahedron(centre, {radius, radius, radius});
}

/// A convex part by eight numbers below 4, `first` being there already.
Polygons part_of(const std::vector<int>& numbers, const Polygons& first) {
  const Coordinates low{numbers[0], numbers[1], numbers[2]};
  const Coordinates size{1 + numbers[3], 1 + numbers[4], 1 + numbers[5]};
  switch (numbers[6]) {
    case 0:
      return wedge(low, size, static_cast<std::size_t>(numbers[7] % 3));
    case 1:
      return octahedron(low, size);
    case 2:
      if (!first.empty()) return sunk(first, numbers);
      return box({0, 0, 0}, {4, 4, 4});
    default:
      return box(low, size);
  }
}

}  // namespace

rc::Gen<SceneFile> soups() {
  const auto number = gen::resize(rc::kNominalSize, gen::inRange(0, 4));
  const auto numbers = gen::container<std::vector<int>>(8, number);
  const auto count = gen::resize(rc::kNominalSize, gen::inRange(2, 5));
  const auto parts = gen::mapcat(count, [numbers](int drawn) {
    return gen::container<std::vector<std::vector<int>>>(
        static_cast<std::size_t>(drawn), numbers);
  });
  return gen::map(parts, [](const std::vector<std::vector<int>>& drawn) {
    Polygons all;
    std::vector<Rgb> colors;
    Polygons first;
    for (std::size_t k = 0; k < drawn.size(); ++k) {
      Polygons part = part_of(drawn[k], first);
      if (k == 0) first = part;
      for (auto& polygon : part) {
        all.push_back(std::move(polygon));
        colors.push_back({static_cast<std::uint8_t>(k), 0, 0});
      }
    }
    SceneData data = scene_of(all, {}).data();
    data.colors = colors;
    auto scene = make_scene(std::move(data));
    HALFSPACE_ASSERT(scene.has_value());
    return SceneFile{*std::move(scene), std::nullopt, {}};
  });
}

}  // namespace halfspace::generate
