#include "generate/random_solids.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "halfspace/assert.hpp"
#include "halfspace/fast/check_operand.hpp"
#include "halfspace/fast/solid.hpp"

namespace halfspace::agree {
namespace {

using Polygon = std::vector<GridPoint>;

GridSolid solid_of(const std::vector<Polygon>& polygons) {
  SceneData data;
  std::map<GridPoint, VertexId> ids;
  for (const Polygon& polygon : polygons) {
    for (const GridPoint& p : polygon) {
      const auto next = static_cast<VertexId>(data.vertices.size());
      const auto [at, is_new] = ids.try_emplace(p, next);
      if (is_new) data.vertices.push_back(p);
      data.corners.push_back(at->second);
    }
    data.first_corner.push_back(
        static_cast<std::uint32_t>(data.corners.size()));
    data.colors.push_back({});
  }
  data.grid_bits = grid_bits_for(data.vertices);
  auto scene = make_scene(std::move(data));
  HALFSPACE_ASSERT(scene.has_value());
  auto solid = make_solid(*std::move(scene));
  HALFSPACE_ASSERT(solid.has_value());
  return *std::move(solid);
}

/// The side of the unit cube at the origin that faces along `axis`.
Polygon cube_side(int axis, bool positive) {
  Polygon square;
  for (const auto& [u, v] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
    std::array<std::int64_t, 3> c{};
    c[static_cast<std::size_t>(axis)] = positive;
    c[static_cast<std::size_t>((axis + 1) % 3)] = u;
    c[static_cast<std::size_t>((axis + 2) % 3)] = v;
    square.push_back({c[0], c[1], c[2]});
  }
  if (!positive) std::reverse(square.begin(), square.end());
  return square;
}

/// The surface of random cubes of a block, in unit squares.
std::vector<Polygon> cubes(Draws& draws) {
  constexpr std::int64_t kSize = 3;
  std::array<std::array<std::array<bool, 5>, 5>, 5> full{};
  const std::int64_t share = draws.from_to(1, 3);
  for (std::size_t i = 1; i <= kSize; ++i) {
    for (std::size_t j = 1; j <= kSize; ++j) {
      for (std::size_t k = 1; k <= kSize; ++k)
        full[i][j][k] = draws.from_to(0, 3) < share;
    }
  }
  std::vector<Polygon> polygons;
  for (std::size_t i = 1; i <= kSize; ++i) {
    for (std::size_t j = 1; j <= kSize; ++j) {
      for (std::size_t k = 1; k <= kSize; ++k) {
        if (!full[i][j][k]) continue;
        const bool beside[3][2] = {{full[i - 1][j][k], full[i + 1][j][k]},
                                   {full[i][j - 1][k], full[i][j + 1][k]},
                                   {full[i][j][k - 1], full[i][j][k + 1]}};
        for (int axis = 0; axis < 3; ++axis) {
          for (const bool positive : {false, true}) {
            if (beside[axis][positive]) continue;
            Polygon square = cube_side(axis, positive);
            for (GridPoint& p : square) {
              p.x += static_cast<std::int64_t>(i);
              p.y += static_cast<std::int64_t>(j);
              p.z += static_cast<std::int64_t>(k);
            }
            polygons.push_back(square);
          }
        }
      }
    }
  }
  return polygons;
}

GridPoint random_point(Draws& draws) {
  const std::int64_t x = draws.from_to(0, 5);
  const std::int64_t y = draws.from_to(0, 5);
  return {x, y, draws.from_to(0, 5)};
}

std::int64_t determinant(const GridPoint& a, const GridPoint& b,
                         const GridPoint& c) {
  return a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) +
         a.z * (b.x * c.y - b.y * c.x);
}

void add_tetrahedron(std::int64_t shift, Draws& draws,
                     std::vector<Polygon>& polygons) {
  std::array<GridPoint, 4> p;
  std::int64_t volume = 0;
  while (volume == 0) {
    for (GridPoint& point : p) {
      point = random_point(draws);
      point.x += shift;
    }
    const auto from = [&](std::size_t i) {
      return GridPoint{p[i].x - p[0].x, p[i].y - p[0].y, p[i].z - p[0].z};
    };
    volume = determinant(from(1), from(2), from(3));
  }
  if (volume < 0) std::swap(p[0], p[1]);
  polygons.push_back({p[0], p[2], p[1]});
  polygons.push_back({p[0], p[1], p[3]});
  polygons.push_back({p[1], p[2], p[3]});
  polygons.push_back({p[0], p[3], p[2]});
}

/// A box between two corners; `halves`: some faces in two triangles.
void add_box(const GridPoint& low, const GridPoint& high, bool inwards,
             Draws* halves, std::vector<Polygon>& polygons) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool positive : {false, true}) {
      Polygon face = cube_side(axis, positive);
      for (GridPoint& p : face) {
        p = {p.x != 0 ? high.x : low.x, p.y != 0 ? high.y : low.y,
             p.z != 0 ? high.z : low.z};
      }
      if (inwards) std::reverse(face.begin(), face.end());
      if (halves != nullptr && halves->one_in(2)) {
        polygons.push_back({face[0], face[1], face[2]});
        polygons.push_back({face[0], face[2], face[3]});
      } else {
        polygons.push_back(face);
      }
    }
  }
}

/// A wedge between two corners, of one edge of which nothing is left but where
/// it stands, at `foot` along the axis after the next one.
void add_wedge(const GridPoint& low, const GridPoint& high, int axis,
               std::int64_t foot, std::vector<Polygon>& polygons) {
  const auto at = [&](int end, int corner) {
    std::array<std::int64_t, 3> l{low.x, low.y, low.z};
    std::array<std::int64_t, 3> h{high.x, high.y, high.z};
    const auto k = static_cast<std::size_t>(axis);
    const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
    std::array<std::int64_t, 3> c{};
    c[k] = end == 0 ? l[k] : h[k];
    c[u] = corner == 0 ? l[u] : h[u];
    c[v] = corner == 0 ? foot : corner == 1 ? l[v] : h[v];
    return GridPoint{c[0], c[1], c[2]};
  };
  polygons.push_back({at(0, 2), at(0, 1), at(0, 0)});
  polygons.push_back({at(1, 0), at(1, 1), at(1, 2)});
  for (int corner = 0; corner < 3; ++corner) {
    const int next = (corner + 1) % 3;
    polygons.push_back(
        {at(0, corner), at(0, next), at(1, next), at(1, corner)});
  }
}

/// Boxes and wedges that do not overlap (S6.2), and so touch here and there.
std::vector<Polygon> touching(Draws& draws) {
  std::vector<Polygon> polygons;
  const auto corner = [&] {
    const std::int64_t x = draws.from_to(0, 3);
    const std::int64_t y = draws.from_to(0, 3);
    return GridPoint{x, y, draws.from_to(0, 3)};
  };
  for (int left = 2; left > 0;) {
    const GridPoint low = corner();
    const GridPoint high{low.x + draws.from_to(1, 3),
                         low.y + draws.from_to(1, 3),
                         low.z + draws.from_to(1, 3)};
    std::vector<Polygon> more = polygons;
    if (draws.one_in(2)) {
      add_box(low, high, false, nullptr, more);
    } else {
      const int axis = static_cast<int>(draws.from_to(0, 2));
      const std::int64_t from = axis == 0 ? low.z : axis == 1 ? low.x : low.y;
      add_wedge(low, high, axis, from + draws.from_to(0, 1), more);
    }
    if (!fast::check_operand(fast::to_solid(solid_of(more)))) continue;
    polygons = more;
    --left;
  }
  return polygons;
}

}  // namespace

GridSolid random_solid(SolidKind kind, std::int64_t scale, Draws& draws) {
  std::vector<Polygon> polygons;
  const GridPoint low = random_point(draws);
  const std::int64_t size = draws.from_to(1, 4);
  const GridPoint high{low.x + size, low.y + draws.from_to(1, 4),
                       low.z + draws.from_to(1, 4)};
  switch (kind) {
    case SolidKind::kCubes:
    case SolidKind::kSkewed:
      polygons = cubes(draws);
      break;
    case SolidKind::kTetrahedra:
      add_tetrahedron(0, draws, polygons);
      if (draws.one_in(2)) add_tetrahedron(6, draws, polygons);
      break;
    case SolidKind::kBox:
      add_box(low, high, false, &draws, polygons);
      break;
    case SolidKind::kTouching:
      polygons = touching(draws);
      break;
    case SolidKind::kHollow:
      add_box({-1, -1, -1}, {draws.from_to(5, 7), 6, 7}, false, &draws,
              polygons);
      add_box({low.x / 2, low.y / 2, low.z / 2}, {3, 4, 4}, true, &draws,
              polygons);
      break;
  }
  const bool skewed = kind == SolidKind::kSkewed;
  const std::int64_t s = skewed ? draws.from_to(-1, 1) : 0;
  const std::int64_t t = skewed ? draws.from_to(-1, 1) : 0;
  const std::int64_t u = skewed ? draws.from_to(-1, 1) : 0;
  for (Polygon& polygon : polygons) {
    for (GridPoint& p : polygon) {
      const std::int64_t x = p.x + s * p.y + t * p.z;
      const std::int64_t y = p.y + u * p.z;
      p = {scale * x, scale * y, scale * p.z};
    }
  }
  return solid_of(polygons);
}

}  // namespace halfspace::agree
