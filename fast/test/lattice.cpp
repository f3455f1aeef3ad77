#include "lattice.hpp"

#include <algorithm>
#include <utility>

#include "halfspace/assert.hpp"
#include "halfspace/bsp_tree.hpp"

namespace halfspace::lattice {
namespace {

using Place = std::array<int, 3>;

/// Grid points along an axis.
constexpr int kPoints = kSize + 1;
constexpr std::size_t kSteps = 3 * kPoints * 2 * 2 * kPoints * kSize;

std::size_t number(int i, int j, int k) {
  return static_cast<std::size_t>((i * kSize + j) * kSize + k);
}

bool at(const Cubes& cubes, const Place& p) {
  return cubes.at(p[0], p[1], p[2]);
}

/// Calls `found(corners, axis, positive)` for all squares.
template <class Found>
void for_squares(const Cubes& cubes, Found&& found) {
  for (int n = 0; n < kSize * kSize * kSize; ++n) {
    const Place p{n / kSize / kSize, n / kSize % kSize, n % kSize};
    if (!at(cubes, p)) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const bool positive : {false, true}) {
        Place beside = p;
        beside[axis] += positive ? 1 : -1;
        if (at(cubes, beside)) continue;
        std::array<Place, 4> corners;
        for (std::size_t c = 0; c < 4; ++c) {
          corners[c] = p;
          corners[c][axis] += positive;
          corners[c][(axis + 1) % 3] += c == 1 || c == 2;
          corners[c][(axis + 2) % 3] += c >= 2;
        }
        if (!positive) std::reverse(corners.begin(), corners.end());
        found(corners, static_cast<int>(axis), positive);
      }
    }
  }
}

/// Counts the steps from one place to another, as against steps back.
void add_edge(int axis, bool positive, const Place& from, const Place& to,
              Outline& outline) {
  const auto across = static_cast<std::size_t>(axis);
  const bool second = from[(across + 1) % 3] == to[(across + 1) % 3];
  const std::size_t along = (across + (second ? 2 : 1)) % 3;
  const std::size_t beside = (across + (second ? 1 : 2)) % 3;
  const int row =
      ((axis * kPoints + from[across]) * 2 + (positive ? 1 : 0)) * 2 +
      (second ? 1 : 0);
  std::int8_t* steps = outline.data() + (row * kPoints + from[beside]) * kSize;
  for (int i = from[along]; i < to[along]; ++i) ++steps[i];
  for (int i = to[along]; i < from[along]; ++i) --steps[i];
}

Place place_of(const fast::Solid& solid, std::int32_t v) {
  const GridPoint p = fast::vertex_at(solid, v).point;
  return {static_cast<int>(p.x), static_cast<int>(p.y), static_cast<int>(p.z)};
}

bool is_in_block(const Place& p) {
  return std::all_of(p.begin(), p.end(),
                     [](int c) { return 0 <= c && c <= kSize; });
}

std::size_t point_number(const Place& p) {
  return static_cast<std::size_t>((p[0] * kPoints + p[1]) * kPoints + p[2]);
}

/// Whether the vertices are on the block's grid and the edges along it.
bool is_on_grid(const fast::Solid& solid) {
  return std::all_of(
      solid.edges.begin(), solid.edges.end(), [&](const fast::SolidEdge& e) {
        if (!fast::vertex_at(solid, e.from).is_grid ||
            !fast::vertex_at(solid, e.to).is_grid)
          return false;
        const Place p = place_of(solid, e.from);
        const Place q = place_of(solid, e.to);
        return is_in_block(p) && is_in_block(q) &&
               (p[0] == q[0]) + (p[1] == q[1]) + (p[2] == q[2]) == 2;
      });
}

}  // namespace

bool Cubes::at(int i, int j, int k) const {
  const auto out = [](int c) { return c < 0 || c >= kSize; };
  return !out(i) && !out(j) && !out(k) && full[number(i, j, k)];
}

Cubes random_cubes(int lump, std::uint64_t& state) {
  const auto next = [&state] { return mix(++state); };
  const std::uint64_t share = 1 + next() % 7;
  const std::uint64_t key = next();
  Cubes cubes;
  for (int i = 0; i < kSize; ++i) {
    for (int j = 0; j < kSize; ++j) {
      for (int k = 0; k < kSize; ++k) {
        const std::size_t of = number(i / lump, j / lump, k / lump);
        cubes.full[number(i, j, k)] = mix(key + of) % 8 < share;
      }
    }
  }
  return cubes;
}

GridSolid surface(const Cubes& cubes) {
  SceneData data;
  std::vector<VertexId> ids(kPoints * kPoints * kPoints, -1);
  for_squares(cubes, [&](const std::array<Place, 4>& corners, int, bool) {
    for (const Place& p : corners) {
      VertexId& id = ids[point_number(p)];
      if (id < 0) {
        id = static_cast<VertexId>(data.vertices.size());
        data.vertices.push_back({p[0], p[1], p[2]});
      }
      data.corners.push_back(id);
    }
    data.first_corner.push_back(
        static_cast<std::uint32_t>(data.corners.size()));
    data.colors.push_back({});
  });
  auto scene = make_scene(std::move(data));
  HALFSPACE_ASSERT(scene.has_value());
  auto solid = make_solid(*std::move(scene));
  HALFSPACE_ASSERT(solid.has_value());
  return *std::move(solid);
}

Outline outline(const Cubes& cubes) {
  Outline result(kSteps);
  for_squares(
      cubes, [&](const std::array<Place, 4>& corners, int axis, bool positive) {
        for (std::size_t c = 0; c < 4; ++c)
          add_edge(axis, positive, corners[c], corners[(c + 1) % 4], result);
      });
  return result;
}

Outline outline(const fast::Solid& solid, bool& whole) {
  whole = is_on_grid(solid);
  if (!whole) return {};
  Outline result(kSteps);
  for (const fast::Face& face : solid.faces) {
    const auto plane = fast::plane_at(solid, face.plane);
    int axis = 0;
    while (plane.normal[static_cast<std::size_t>(axis)] == 0) ++axis;
    for (std::uint32_t i = 0; i < face.edge_count; ++i) {
      const auto& edge = solid.edges[face.first_edge + i];
      const Place from = place_of(solid, edge.from);
      const Place to = place_of(solid, edge.to);
      whole = whole && from[static_cast<std::size_t>(axis)] ==
                           to[static_cast<std::size_t>(axis)];
      add_edge(axis, !face.flipped, from, to, result);
    }
  }
  return result;
}

bool is_least(const fast::Solid& solid) {
  // By point: 8 for a vertex, and the axes along which edges go from it.
  std::vector<std::uint8_t> marks(kPoints * kPoints * kPoints);
  for (const fast::SolidEdge& edge : solid.edges) {
    const Place from = place_of(solid, edge.from);
    const Place to = place_of(solid, edge.to);
    std::size_t along = 0;
    while (from[along] == to[along]) ++along;
    for (const Place& end : {from, to}) {
      std::uint8_t& mark = marks[point_number(end)];
      mark = static_cast<std::uint8_t>(mark | 8 | 1 << along);
    }
  }
  for (const fast::SolidEdge& edge : solid.edges) {
    Place place = place_of(solid, edge.from);
    const Place to = place_of(solid, edge.to);
    std::size_t along = 0;
    while (place[along] == to[along]) ++along;
    const int step = place[along] < to[along] ? 1 : -1;
    for (place[along] += step; place != to; place[along] += step) {
      if (marks[point_number(place)] != 0) return false;
    }
  }
  // At a vertex with edges along one axis nothing turns.
  return std::none_of(marks.begin(), marks.end(), [](std::uint8_t mark) {
    return mark == 9 || mark == 10 || mark == 12;
  });
}

}  // namespace halfspace::lattice
