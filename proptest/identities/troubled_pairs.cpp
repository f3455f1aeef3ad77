#include "troubled_pairs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "halfspace/assert.hpp"

namespace halfspace::identities {
namespace {

using agree::Draws;
using Polygon = std::vector<GridPoint>;
using Surface = std::vector<Polygon>;

constexpr std::int64_t kLarge = std::int64_t{1} << 20;

/// The tetrahedron of four points, outwards whatever their order. False if they
/// are in one plane.
bool add_tetrahedron(std::array<GridPoint, 4> p, Surface& surface) {
  const auto from = [&](std::size_t i) {
    return std::array<Int128, 3>{p[i].x - p[0].x, p[i].y - p[0].y,
                                 p[i].z - p[0].z};
  };
  const auto a = from(1), b = from(2), c = from(3);
  const Int128 volume = a[0] * (b[1] * c[2] - b[2] * c[1]) +
                        a[1] * (b[2] * c[0] - b[0] * c[2]) +
                        a[2] * (b[0] * c[1] - b[1] * c[0]);
  if (volume == 0) return false;
  if (volume < 0) std::swap(p[0], p[1]);
  for (const auto& [i, j, k] :
       {std::array{0u, 2u, 1u}, {0u, 1u, 3u}, {1u, 2u, 3u}, {0u, 3u, 2u}})
    surface.push_back({p[i], p[j], p[k]});
  return true;
}

/// A prism over a polygon, counterclockwise from above; its roof may be another
/// one, in triangles then.
void add_prism(const Polygon& floor, const Polygon& roof, bool in_triangles,
               Surface& surface) {
  surface.emplace_back(floor.rbegin(), floor.rend());
  const std::size_t n = floor.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    if (in_triangles) {
      surface.push_back({floor[i], floor[j], roof[j]});
      surface.push_back({floor[i], roof[j], roof[i]});
    } else {
      surface.push_back({floor[i], floor[j], roof[j], roof[i]});
    }
  }
  if (!in_triangles) {
    surface.push_back(roof);
    return;
  }
  for (std::size_t i = 2; i < n; ++i)
    surface.push_back({roof[0], roof[i - 1], roof[i]});
}

Polygon raised(Polygon polygon, std::int64_t by) {
  for (GridPoint& p : polygon) p.z += by;
  return polygon;
}

Polygon rectangle(std::int64_t x, std::int64_t y, std::int64_t width,
                  std::int64_t depth, std::int64_t z) {
  return {{x, y, z},
          {x + width, y, z},
          {x + width, y + depth, z},
          {x, y + depth, z}};
}

Surface nearly_in_plane(Draws& draws) {
  const Polygon floor =
      rectangle(draws.from_to(0, 2) * kLarge / 2,
                draws.from_to(0, 1) * kLarge / 2, kLarge, kLarge, 0);
  Polygon roof = raised(floor, kLarge);
  for (GridPoint& p : roof) p.z += draws.from_to(-1, 1);
  Surface surface;
  add_prism(floor, roof, true, surface);
  return surface;
}

/// A regular prism but for rounding, turned by `angle`.
Surface turned(std::size_t corners, double angle, std::int64_t z) {
  Polygon floor;
  for (std::size_t i = 0; i < corners; ++i) {
    const double at = angle + 2 * std::numbers::pi * static_cast<double>(i) /
                                  static_cast<double>(corners);
    floor.push_back({std::llround(16.0 * kLarge * std::cos(at)),
                     std::llround(16.0 * kLarge * std::sin(at)), z});
  }
  Surface surface;
  add_prism(floor, raised(floor, kLarge), false, surface);
  return surface;
}

Surface round_an_edge(Draws& draws) {
  constexpr std::array<std::array<std::int64_t, 2>, 8> kRing = {
      {{2, 0}, {2, 2}, {0, 2}, {-2, 2}, {-2, 0}, {-2, -2}, {0, -2}, {2, -2}}};
  const std::int64_t low = draws.from_to(-1, 1), high = draws.from_to(3, 5);
  Surface surface;
  // No two side by side: their common face would be a wall.
  const std::size_t first = draws.one_in(2) ? 1 : 0;
  for (std::size_t i = first; i < 8; i += 2) {
    if (i != first && draws.one_in(3)) continue;
    const auto& p = kRing[i];
    const auto& q = kRing[(i + 1) % 8];
    const std::int64_t z = draws.from_to(low, high);
    add_tetrahedron(
        {{{0, 0, low}, {0, 0, high}, {p[0], p[1], z}, {q[0], q[1], z}}},
        surface);
  }
  return surface;
}

Surface at_a_point(Draws& draws) {
  Surface surface;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const std::int64_t sign : {-1, 1}) {
      if (!surface.empty() && draws.one_in(3)) continue;
      const std::int64_t far = draws.from_to(3, 5) * sign;
      std::array<GridPoint, 4> base;
      for (std::size_t i = 0; i < 4; ++i) {
        std::array<std::int64_t, 3> c{};
        c[axis] = far;
        c[(axis + 1) % 3] = i == 0 || i == 3 ? -2 : 2;
        c[(axis + 2) % 3] = i < 2 ? -2 : 2;
        base[i] = {c[0], c[1], c[2]};
      }
      if (sign < 0) std::reverse(base.begin(), base.end());
      const GridPoint tip{0, 0, 0};
      surface.emplace_back(base.begin(), base.end());
      for (std::size_t i = 0; i < 4; ++i)
        surface.push_back({base[(i + 1) % 4], base[i], tip});
    }
  }
  return surface;
}

Surface shell_in_shell(Draws& draws) {
  Surface surface;
  bool inwards = false;
  for (std::int64_t at = 0; at < 9; ++at) {
    if (at != 0 && draws.one_in(3)) continue;
    Surface shell;
    const Polygon floor = rectangle(at, at, 20 - 2 * at, 20 - 2 * at, at);
    add_prism(floor, raised(floor, 20 - 2 * at), draws.one_in(2), shell);
    for (Polygon& polygon : shell) {
      if (inwards) std::reverse(polygon.begin(), polygon.end());
      surface.push_back(polygon);
    }
    inwards = !inwards;
  }
  return surface;
}

/// Hills on a board: the heights are the same for all, but for a few.
Surface hills(Draws& draws) {
  constexpr std::int64_t kSide = 4;
  const auto at = [](std::int64_t i, std::int64_t j) {
    return static_cast<std::size_t>(i * (kSide + 1) + j);
  };
  std::array<std::int64_t, (kSide + 1) * (kSide + 1)> height;
  for (std::int64_t i = 0; i <= kSide; ++i) {
    for (std::int64_t j = 0; j <= kSide; ++j) {
      const bool is_border = i % kSide == 0 || j % kSide == 0;
      height[at(i, j)] = is_border         ? 4
                         : draws.one_in(4) ? draws.from_to(1, 6)
                                           : 4 + (i * j) % 3;
    }
  }
  const auto point = [&](std::int64_t i, std::int64_t j) {
    return GridPoint{i, j, height[at(i, j)]};
  };
  Surface surface;
  for (std::int64_t i = 0; i < kSide; ++i) {
    for (std::int64_t j = 0; j < kSide; ++j) {
      const std::array<GridPoint, 4> p{point(i, j), point(i + 1, j),
                                       point(i + 1, j + 1), point(i, j + 1)};
      const std::size_t first = draws.one_in(2) ? 1 : 0;
      surface.push_back({p[first], p[first + 1], p[first + 2]});
      surface.push_back({p[first], p[first + 2], p[(first + 3) % 4]});
    }
  }
  const Polygon floor = rectangle(0, 0, kSide, kSide, 0);
  surface.emplace_back(floor.rbegin(), floor.rend());
  for (std::size_t i = 0; i < 4; ++i) {
    const GridPoint& a = floor[i];
    const GridPoint& b = floor[(i + 1) % 4];
    Polygon wall{a, b};
    for (std::int64_t k = kSide; k >= 0; --k) {
      wall.push_back(
          {a.x + (b.x - a.x) * k / kSide, a.y + (b.y - a.y) * k / kSide, 4});
    }
    surface.push_back(wall);
  }
  return surface;
}

Surface sliver(Draws& draws) {
  Surface surface;
  const auto point = [&] {
    return GridPoint{draws.from_to(0, 3) * kLarge + draws.from_to(-1, 1),
                     draws.from_to(0, 2), draws.from_to(0, 2)};
  };
  while (surface.empty())
    add_tetrahedron({point(), point(), point(), point()}, surface);
  return surface;
}

/// A cube, or a rod along one of its diagonals, through corners or edges.
Surface rod(bool is_cube, Draws& draws) {
  Surface surface;
  if (is_cube) {
    const Polygon floor = rectangle(0, 0, 6, 6, 0);
    add_prism(floor, raised(floor, 6), draws.one_in(2), surface);
    return surface;
  }
  const std::int64_t lift = draws.from_to(-1, 1), size = draws.from_to(1, 3);
  const std::int64_t slant = draws.from_to(0, 2);
  Polygon low{{-size, 0, 0}, {0, -size, 0}, {size, 0, 0}, {0, size, 0}};
  for (GridPoint& p : low) p = {p.x - 3, p.y - 3 * slant / 2, lift - 3};
  Polygon high = low;
  for (GridPoint& p : high) p = {p.x + 12, p.y + 6 * slant, p.z + 12};
  add_prism(low, high, false, surface);
  return surface;
}

GridSolid solid_of(const Surface& surface, const GridPoint& by, int grid_bits) {
  SceneData data;
  std::map<GridPoint, VertexId> ids;
  for (const Polygon& polygon : surface) {
    for (const GridPoint& p : polygon) {
      const auto next = static_cast<VertexId>(data.vertices.size());
      const auto [at, is_new] = ids.try_emplace(p, next);
      if (is_new) data.vertices.push_back({p.x + by.x, p.y + by.y, p.z + by.z});
      data.corners.push_back(at->second);
    }
    data.first_corner.push_back(
        static_cast<std::uint32_t>(data.corners.size()));
    data.colors.push_back({});
  }
  data.grid_bits = grid_bits;
  auto scene = make_scene(std::move(data));
  HALFSPACE_ASSERT(scene.has_value());
  auto solid = make_solid(*std::move(scene));
  HALFSPACE_ASSERT(solid.has_value());
  return *std::move(solid);
}

Surface surface_of(Trouble trouble, bool is_first, Draws& draws) {
  switch (trouble) {
    case Trouble::kNearlyInPlane:
      return nearly_in_plane(draws);
    case Trouble::kTurnedABit: {
      // A step at the rim is an angle of 6e-8.
      const double angle =
          is_first ? 0 : 1e-7 * static_cast<double>(draws.from_to(1, 20));
      return turned(static_cast<std::size_t>(draws.from_to(3, 9)), angle,
                    draws.from_to(0, 1) * draws.from_to(0, 2));
    }
    case Trouble::kRoundAnEdge:
      return round_an_edge(draws);
    case Trouble::kAtAPoint:
      return at_a_point(draws);
    case Trouble::kShellInShell:
      return shell_in_shell(draws);
    case Trouble::kCutOtherwise:
      return hills(draws);
    case Trouble::kSlivers:
      return sliver(draws);
    case Trouble::kThroughCorners:
      break;
  }
  return rod(is_first, draws);
}

}  // namespace

const char* name_of(Trouble trouble) {
  constexpr const char* kNames[] = {
      "nearly in plane", "turned a bit",  "round an edge", "at a point",
      "shell in shell",  "cut otherwise", "slivers",       "through corners"};
  return kNames[static_cast<std::size_t>(trouble)];
}

std::pair<GridSolid, GridSolid> troubled_pair(Trouble trouble, Draws& draws) {
  const Surface first = surface_of(trouble, true, draws);
  const Surface second = surface_of(trouble, false, draws);
  const std::array<std::pair<int, std::int64_t>, 3> places{
      {{26, 0}, {40, std::int64_t{1} << 37}, {54, std::int64_t{1} << 52}}};
  const auto [bits, far] =
      places[static_cast<std::size_t>(draws.from_to(0, 2))];
  const GridPoint by{far - far / 3, -far / 5, far - far / 7};
  return {solid_of(first, by, bits), solid_of(second, by, bits)};
}

}  // namespace halfspace::identities
