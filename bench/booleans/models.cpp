#include "booleans/models.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "halfspace/assert.hpp"

namespace halfspace::bench {

using Point = std::array<double, 3>;

/// By Rodrigues' formula.
Point turned(const Point& p, double angle, const Point& axis) {
  const double length = std::hypot(axis[0], axis[1], axis[2]);
  const Point k{axis[0] / length, axis[1] / length, axis[2] / length};
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const double along = k[0] * p[0] + k[1] * p[1] + k[2] * p[2];
  Point q;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t l = (i + 2) % 3;
    const double across = k[j] * p[l] - k[l] * p[j];
    q[i] = p[i] * c + across * s + k[i] * along * (1 - c);
  }
  return q;
}

namespace {

GridPoint placed(const Point& unit, const Placement& placement) {
  const Point p = turned(unit, placement.turn, placement.axis);
  const auto at = [&](std::size_t i) {
    return std::llround(placement.centre[i] + placement.radius * p[i]);
  };
  return {at(0), at(1), at(2)};
}

}  // namespace

int bands_for(int triangles) {
  int bands = 3;
  while (4 * bands * (bands - 1) < triangles) ++bands;
  return bands;
}

Triangles sphere(int bands, const Placement& placement) {
  Triangles result;
  const int around = 2 * bands;
  result.points.push_back(placed({0, 0, 1}, placement));
  for (int i = 1; i < bands; ++i) {
    const double polar = std::numbers::pi * i / bands;
    for (int j = 0; j < around; ++j) {
      const double angle = 2 * std::numbers::pi * j / around;
      result.points.push_back(
          placed({std::sin(polar) * std::cos(angle),
                  std::sin(polar) * std::sin(angle), std::cos(polar)},
                 placement));
    }
  }
  const auto last = static_cast<VertexId>(result.points.size());
  result.points.push_back(placed({0, 0, -1}, placement));
  const auto at = [&](int i, int j) {
    return static_cast<VertexId>(1 + (i - 1) * around + j % around);
  };
  for (int j = 0; j < around; ++j) {
    result.corners.push_back({0, at(1, j), at(1, j + 1)});
    for (int i = 1; i + 1 < bands; ++i) {
      result.corners.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      result.corners.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
    result.corners.push_back({at(bands - 1, j), last, at(bands - 1, j + 1)});
  }
  return result;
}

Triangles block(const GridPoint& low, const GridPoint& high) {
  Triangles result;
  for (const std::int64_t z : {low.z, high.z}) {
    result.points.push_back({low.x, low.y, z});
    result.points.push_back({high.x, low.y, z});
    result.points.push_back({high.x, high.y, z});
    result.points.push_back({low.x, high.y, z});
  }
  result.corners = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7},
                    {0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5},
                    {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  return result;
}

Triangles prism(int corners, const GridPoint& base, std::int64_t radius,
                std::int64_t height) {
  Triangles result;
  for (const std::int64_t z : {base.z, base.z + height}) {
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * std::numbers::pi * i / corners;
      const auto r = static_cast<double>(radius);
      result.points.push_back({base.x + std::llround(r * std::cos(angle)),
                               base.y + std::llround(r * std::sin(angle)), z});
    }
  }
  const auto low = [&](int i) { return static_cast<VertexId>(i % corners); };
  const auto high = [&](int i) { return low(i) + corners; };
  for (int i = 0; i < corners; ++i) {
    result.corners.push_back({low(i), low(i + 1), high(i + 1)});
    result.corners.push_back({low(i), high(i + 1), high(i)});
    if (i == 0 || i + 1 == corners) continue;
    result.corners.push_back({low(0), low(i + 1), low(i)});
    result.corners.push_back({high(0), high(i), high(i + 1)});
  }
  return result;
}

Triangles pyramid(std::int64_t side, const GridPoint& tip) {
  return {{{0, 0, 0}, {side, 0, 0}, {side, side, 0}, {0, side, 0}, tip},
          {{0, 2, 1}, {0, 3, 2}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
}

std::vector<Triangles> menger_bars(int level, std::int64_t scale) {
  std::vector<Triangles> bars;
  std::int64_t size = scale;
  for (int l = 0; l < level; ++l) size *= 3;
  std::int64_t cell = size;
  for (int l = 0; l < level; ++l, cell /= 3) {
    for (int axis = 0; axis < 3; ++axis) {
      for (std::int64_t u = 0; u < size; u += cell) {
        for (std::int64_t v = 0; v < size; v += cell) {
          // A bar within a coarser one has nothing to take away.
          bool is_new = true;
          for (std::int64_t c = 3 * cell; c <= size && is_new; c *= 3) {
            is_new = u % c / (c / 3) != 1 || v % c / (c / 3) != 1;
          }
          if (!is_new) continue;
          const std::array<std::int64_t, 2> from{u + cell / 3, v + cell / 3};
          const auto at = [&](std::int64_t along, std::int64_t add) {
            std::array<std::int64_t, 3> p;
            p[static_cast<std::size_t>(axis)] = along;
            p[static_cast<std::size_t>(axis + 1) % 3] = from[0] + add;
            p[static_cast<std::size_t>(axis + 2) % 3] = from[1] + add;
            return GridPoint{p[0], p[1], p[2]};
          };
          bars.push_back(block(at(0, 0), at(size, cell / 3)));
        }
      }
    }
  }
  return bars;
}

double volume6_of(const Triangles& triangles) {
  double sum = 0;
  for (const auto& corners : triangles.corners) {
    const auto at = [&](std::size_t i) {
      const GridPoint& p =
          triangles.points[static_cast<std::size_t>(corners[i])];
      return Point{static_cast<double>(p.x), static_cast<double>(p.y),
                   static_cast<double>(p.z)};
    };
    const Point p = at(0), q = at(1), r = at(2);
    sum += p[0] * (q[1] * r[2] - q[2] * r[1]) +
           p[1] * (q[2] * r[0] - q[0] * r[2]) +
           p[2] * (q[0] * r[1] - q[1] * r[0]);
  }
  return sum;
}

GridSolid solid_of(const Triangles& triangles) {
  SceneData data;
  data.vertices = triangles.points;
  data.grid_bits = grid_bits_for(data.vertices);
  data.corners.reserve(3 * triangles.corners.size());
  data.first_corner.reserve(triangles.corners.size() + 1);
  for (const auto& corners : triangles.corners) {
    data.corners.insert(data.corners.end(), corners.begin(), corners.end());
    data.first_corner.push_back(
        static_cast<std::uint32_t>(data.corners.size()));
  }
  data.colors.assign(triangles.corners.size(), Rgb{});
  auto scene = make_scene(std::move(data));
  HALFSPACE_ASSERT(scene.has_value());
  auto solid = make_solid(*std::move(scene));
  HALFSPACE_ASSERT(solid.has_value());
  return *std::move(solid);
}

}  // namespace halfspace::bench
