#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "halfspace/boolean.hpp"
#include "halfspace/bsp_tree.hpp"
#include "halfspace/fast/solid.hpp"

namespace halfspace::fast {

/// Corners are on a coarse grid of few points, so that much coincides.
constexpr std::int64_t kStep = 3;

constexpr std::int64_t kPoints = 4;

/// A closed surface in the making.
class Surface {
 public:
  explicit Surface(std::uint64_t seed) : state_(seed << 32) {}

  std::int64_t draw(std::int64_t count) {
    return static_cast<std::int64_t>(mix(++state_) %
                                     static_cast<std::uint64_t>(count));
  }
  GridPoint point() { return {coordinate(), coordinate(), coordinate()}; }
  VertexId vertex(const GridPoint& point) {
    const auto [at, is_new] =
        ids_.try_emplace(point, static_cast<VertexId>(data_.vertices.size()));
    if (is_new) data_.vertices.push_back(point);
    return at->second;
  }
  void add(const std::vector<GridPoint>& corners) {
    for (const GridPoint& p : corners) data_.corners.push_back(vertex(p));
    data_.first_corner.push_back(
        static_cast<std::uint32_t>(data_.corners.size()));
    data_.colors.push_back({});
  }
  Solid solid(const Solid* with) {
    auto scene = make_scene(std::move(data_));
    EXPECT_TRUE(scene.has_value());
    auto made = make_solid(*std::move(scene));
    EXPECT_TRUE(made.has_value());
    return with != nullptr ? to_solid(*made, *with) : to_solid(*made);
  }

 private:
  std::int64_t coordinate() { return kStep * draw(kPoints); }

  std::uint64_t state_;
  SceneData data_;
  std::map<GridPoint, VertexId> ids_;
};

inline bool on_line(const GridPoint& p, const GridPoint& q,
                    const GridPoint& r) {
  const std::array<std::int64_t, 3> u{q.x - p.x, q.y - p.y, q.z - p.z};
  const std::array<std::int64_t, 3> v{r.x - p.x, r.y - p.y, r.z - p.z};
  return u[1] * v[2] == u[2] * v[1] && u[2] * v[0] == u[0] * v[2] &&
         u[0] * v[1] == u[1] * v[0];
}

/// A box between two corners, inside out in one case of four. Boxes side by
/// side have walls of no thickness between them.
inline void add_box(Surface& surface) {
  const GridPoint p = surface.point();
  GridPoint q = p;
  for (std::int64_t* c : {&q.x, &q.y, &q.z})
    *c += kStep * (1 + surface.draw(2));
  const bool turned = surface.draw(4) == 0;
  const auto at = [&](int i) {
    return GridPoint{i & 1 ? q.x : p.x, i & 2 ? q.y : p.y, i & 4 ? q.z : p.z};
  };
  constexpr int kFaces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& face : kFaces) {
    std::vector<GridPoint> corners;
    for (const int i : face) corners.push_back(at(i));
    if (turned) std::reverse(corners.begin(), corners.end());
    surface.add(corners);
  }
}

/// Two fans over one row of corners that comes back to its first: a
/// tetrahedron, a triangle seen from both sides, or what crosses itself.
inline void add_fans(Surface& surface, std::int64_t count) {
  const std::array<GridPoint, 2> tips{surface.point(), surface.point()};
  std::vector<GridPoint> row;
  for (std::int64_t i = 0; i < count; ++i) row.push_back(surface.point());
  if (tips[0] == tips[1]) return;
  for (std::size_t i = 0; i < row.size(); ++i) {
    const GridPoint& next = row[(i + 1) % row.size()];
    if (on_line(tips[0], row[i], next) || on_line(tips[1], row[i], next))
      return;
  }
  for (std::size_t i = 0; i < row.size(); ++i) {
    const GridPoint& next = row[(i + 1) % row.size()];
    surface.add({tips[0], row[i], next});
    surface.add({tips[1], next, row[i]});
  }
}

/// A triangle and the same seen from behind.
inline void add_wall(Surface& surface) {
  const GridPoint p = surface.point(), q = surface.point(), r = surface.point();
  if (on_line(p, q, r)) return;
  surface.add({p, q, r});
  surface.add({p, r, q});
}

inline Solid nonsense(std::uint64_t seed, const Solid* with = nullptr) {
  Surface surface(seed);
  const std::int64_t kind = surface.draw(4);
  for (std::int64_t n = 1 + surface.draw(6); n > 0; --n) {
    if (kind == 0) add_box(surface);
    if (kind == 1) add_wall(surface);
    if (kind >= 2) add_fans(surface, kind == 2 ? 3 : 3 + surface.draw(5));
  }
  if (kind == 1 && surface.draw(2) == 0) add_box(surface);
  return surface.solid(with);
}

}  // namespace halfspace::fast
