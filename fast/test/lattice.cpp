#include "lattice.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "halfspace/assert.hpp"
#include "halfspace/bsp_tree.hpp"

namespace halfspace::lattice {
namespace {

using Place = std::array<int, 3>;
using Uses = std::map<Step, int>;

std::size_t number(int i, int j, int k) {
  return static_cast<std::size_t>((i * kSize + j) * kSize + k);
}

bool at(const Cubes& cubes, const Place& p) {
  return cubes.at(p[0], p[1], p[2]);
}

/// Calls `found(corners, axis, plane, positive)` for all squares.
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
        found(corners, static_cast<int>(axis), corners[0][axis], positive);
      }
    }
  }
}

/// Counts the steps from one place to another, as against steps back.
void add_edge(int axis, int plane, bool positive, const Place& from,
              const Place& to, Uses& uses) {
  std::size_t along = 0;
  while (from[along] == to[along]) ++along;
  const bool up = from[along] < to[along];
  Place place = up ? from : to;
  const int last = up ? to[along] : from[along];
  for (; place[along] < last; ++place[along]) {
    const Step step{axis, plane, positive, static_cast<int>(along), place, up};
    Step back = step;
    std::get<5>(back) = !up;
    const auto opposite = uses.find(back);
    if (opposite == uses.end()) {
      ++uses[step];
    } else if (--opposite->second == 0) {
      uses.erase(opposite);
    }
  }
}

std::vector<Step> steps_of(const Uses& uses) {
  std::vector<Step> steps;
  for (const auto& [step, count] : uses) {
    for (int i = 0; i < count; ++i) steps.push_back(step);
  }
  return steps;
}

Place place_of(const fast::Solid& solid, std::int32_t v) {
  const GridPoint p = fast::vertex_at(solid, v).point;
  return {static_cast<int>(p.x), static_cast<int>(p.y), static_cast<int>(p.z)};
}

/// Whether the vertices are on the grid and the edges along it.
bool is_on_grid(const fast::Solid& solid) {
  return std::all_of(
      solid.edges.begin(), solid.edges.end(), [&](const fast::SolidEdge& e) {
        if (!fast::vertex_at(solid, e.from).is_grid ||
            !fast::vertex_at(solid, e.to).is_grid)
          return false;
        const Place p = place_of(solid, e.from);
        const Place q = place_of(solid, e.to);
        return (p[0] == q[0]) + (p[1] == q[1]) + (p[2] == q[2]) == 2;
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

Solid surface(const Cubes& cubes) {
  SceneData data;
  std::map<Place, VertexId> ids;
  for_squares(cubes, [&](const std::array<Place, 4>& corners, int, int, bool) {
    for (const Place& p : corners) {
      const auto next = static_cast<VertexId>(data.vertices.size());
      const auto [known, is_new] = ids.try_emplace(p, next);
      if (is_new) data.vertices.push_back({p[0], p[1], p[2]});
      data.corners.push_back(known->second);
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

std::vector<Step> outline(const Cubes& cubes) {
  Uses uses;
  for_squares(cubes, [&](const std::array<Place, 4>& corners, int axis,
                         int plane, bool positive) {
    for (std::size_t c = 0; c < 4; ++c)
      add_edge(axis, plane, positive, corners[c], corners[(c + 1) % 4], uses);
  });
  return steps_of(uses);
}

std::vector<Step> outline(const fast::Solid& solid, bool& whole) {
  whole = is_on_grid(solid);
  if (!whole) return {};
  Uses uses;
  for (const fast::Face& face : solid.faces) {
    const auto plane = fast::plane_at(solid, face.plane);
    int axis = 0;
    while (plane.normal[static_cast<std::size_t>(axis)] == 0) ++axis;
    for (std::uint32_t i = 0; i < face.edge_count; ++i) {
      const auto& edge = solid.edges[face.first_edge + i];
      const Place from = place_of(solid, edge.from);
      add_edge(axis, from[static_cast<std::size_t>(axis)], !face.turned, from,
               place_of(solid, edge.to), uses);
    }
  }
  return steps_of(uses);
}

bool is_least(const fast::Solid& solid) {
  std::map<Place, std::set<int>> axes;
  for (const fast::SolidEdge& edge : solid.edges) {
    axes[place_of(solid, edge.from)];
    axes[place_of(solid, edge.to)];
  }
  for (const fast::SolidEdge& edge : solid.edges) {
    const Place from = place_of(solid, edge.from);
    const Place to = place_of(solid, edge.to);
    std::size_t along = 0;
    while (from[along] == to[along]) ++along;
    axes[from].insert(static_cast<int>(along));
    axes[to].insert(static_cast<int>(along));
    Place place = from;
    const int step = from[along] < to[along] ? 1 : -1;
    for (place[along] += step; place != to; place[along] += step) {
      if (axes.count(place) != 0) return false;
    }
  }
  return std::all_of(axes.begin(), axes.end(), [](const auto& vertex) {
    return vertex.second.size() > 1;
  });
}

}  // namespace halfspace::lattice
