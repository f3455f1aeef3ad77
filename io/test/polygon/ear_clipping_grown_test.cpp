#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <random>
#include <vector>

#include "halfspace/int128.hpp"
#include "polygon/polygons.hpp"
#include "polygon/tiling.hpp"

namespace halfspace::io {
namespace {

using samples::draw;
using samples::expect_tiles;
using samples::Polygon;
using samples::twice_area;
using Tile = std::array<GridPoint, 3>;

/// Whether a side of the first, which turns left, has all of the second to its
/// right.
bool has_beside(const Tile& tile, const Tile& other) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::all_of(other.begin(), other.end(), [&](const GridPoint& p) {
          return twice_area(tile[i], tile[(i + 1) % 3], p) <= 0;
        }))
      return true;
  }
  return false;
}

bool goes_back(const GridPoint& p, const GridPoint& q, const GridPoint& r) {
  return twice_area(p, q, r) == 0 &&
         (q.x - p.x) * (r.x - q.x) + (q.y - p.y) * (r.y - q.y) < 0;
}

/// Triangles, each grown on an edge of those before, or of the last one: they
/// touch anyhow and do not overlap, so their outline is weakly simple.
Polygon grown(std::mt19937& random, bool in_a_row) {
  std::vector<Tile> tiles = {{{{3, 3, 0}, {4, 3, 0}, {3, 4, 0}}}};
  Polygon polygon(tiles[0].begin(), tiles[0].end());
  std::int64_t newest = 1;
  for (int i = 0; i < 300; ++i) {
    const std::int64_t n = std::ssize(polygon);
    const std::int64_t edge =
        in_a_row ? newest + n - draw(random, 2) : draw(random, n);
    const auto corner = [&](std::int64_t k) {
      return polygon[static_cast<std::size_t>((edge + k + n) % n)];
    };
    const Tile tile = {
        {corner(0), {draw(random, 7), draw(random, 7), 0}, corner(1)}};
    if (twice_area(tile[0], tile[1], tile[2]) <= 0 ||
        goes_back(corner(-1), tile[0], tile[1]) ||
        goes_back(tile[1], tile[2], corner(2)) ||
        !std::all_of(tiles.begin(), tiles.end(), [&](const Tile& other) {
          return has_beside(tile, other) || has_beside(other, tile);
        }))
      continue;
    tiles.push_back(tile);
    newest = edge % n + 1;
    polygon.insert(polygon.begin() + newest, tile[1]);
  }
  return polygon;
}

TEST(Triangulate, TilesWhatGrowsTriangleByTriangle) {
  std::mt19937 random(3);
  std::size_t corners = 0;
  for (int i = 0; i < 400; ++i) {
    const Polygon polygon = grown(random, i % 2 == 0);
    corners += polygon.size();
    expect_tiles(polygon);
  }
  EXPECT_GT(corners, 400u * 12);
}

}  // namespace
}  // namespace halfspace::io
