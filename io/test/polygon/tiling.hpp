#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "halfspace/int128.hpp"
#include "polygon/ear_clipping.hpp"
#include "polygon/polygons.hpp"

/// Whether triangles tile a polygon.
namespace halfspace::io::samples {

using Triangles = std::vector<std::array<std::size_t, 3>>;

inline Int128 twice_area(const GridPoint& a, const GridPoint& b,
                         const GridPoint& c) {
  return Int128{b.x - a.x} * (c.y - a.y) - Int128{b.y - a.y} * (c.x - a.x);
}

/// How often each directed edge is used more than its reverse.
using Chain = std::map<std::pair<GridPoint, GridPoint>, int>;

inline void add_edge(Chain& chain, const GridPoint& a, const GridPoint& b) {
  if (a == b) return;
  if (b < a) {
    if (--chain[{b, a}] == 0) chain.erase({b, a});
  } else {
    if (++chain[{a, b}] == 0) chain.erase({a, b});
  }
}

inline Chain boundary_of(const Polygon& polygon) {
  Chain chain;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    add_edge(chain, polygon[i], polygon[(i + 1) % polygon.size()]);
  }
  return chain;
}

inline Chain boundary_of(const Polygon& polygon, const Triangles& triangles) {
  Chain chain;
  for (const auto& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      add_edge(chain, polygon[t[i]], polygon[t[(i + 1) % 3]]);
    }
  }
  return chain;
}

/// In a plane z = constant, counterclockwise: triangles that all turn left and
/// whose boundaries add up to the polygon's cover each point as often as the
/// polygon goes round it, which is once inside and never outside.
inline void expect_tiles(const Polygon& polygon) {
  const Triangles triangles = triangulate(polygon);
  EXPECT_FALSE(triangles.empty());
  for (const auto& [a, b, c] : triangles) {
    EXPECT_TRUE(twice_area(polygon[a], polygon[b], polygon[c]) > 0);
  }
  EXPECT_EQ(boundary_of(polygon), boundary_of(polygon, triangles));
}

}  // namespace halfspace::io::samples
