#include "intersect/line_section.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "halfspace/bsp_tree.hpp"

namespace halfspace::fast {
namespace {

/// A face of some squares of a board, which is askew in space.
constexpr int kSize = 4;
using Board = std::array<std::array<bool, kSize>, kSize>;

/// The board's point, twice as fine as its squares.
GridPoint point_at(int u, int v) { return {u + v, 2 * v, 3 * u - v}; }

bool is_full(const Board& board, int i, int j) {
  return i >= 0 && j >= 0 && i < kSize && j < kSize &&
         board[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
}

/// The edges between the squares that there are and those that there are not.
std::vector<SolidEdge> edges_of(const Board& board, GeometryTable& table) {
  std::vector<SolidEdge> edges;
  const auto add = [&](int u, int v, int to_u, int to_v) {
    edges.push_back({table.add_point(point_at(2 * u, 2 * v)),
                     table.add_point(point_at(2 * to_u, 2 * to_v))});
  };
  for (int i = 0; i < kSize; ++i) {
    for (int j = 0; j < kSize; ++j) {
      if (!is_full(board, i, j)) continue;
      if (!is_full(board, i, j - 1)) add(i, j, i + 1, j);
      if (!is_full(board, i + 1, j)) add(i + 1, j, i + 1, j + 1);
      if (!is_full(board, i, j + 1)) add(i + 1, j + 1, i, j + 1);
      if (!is_full(board, i - 1, j)) add(i, j + 1, i, j);
    }
  }
  return edges;
}

/// Whether one of the squares holds the point, with its edges.
bool holds(const Board& board, int u, int v) {
  if (u < 0 || v < 0) return false;
  for (const int i : {(u + 1) / 2 - 1, u / 2}) {
    for (const int j : {(v + 1) / 2 - 1, v / 2}) {
      if (is_full(board, i, j)) return true;
    }
  }
  return false;
}

/// Checks which points of the line, step by step, the face has. How many.
int check_line(const Board& board, const std::array<int, 2>& from,
               const std::array<int, 2>& step, GeometryTable& table,
               LineFaceSection& section, int& axis_count) {
  const auto at = [&](int k) {
    return point_at(from[0] + k * step[0], from[1] + k * step[1]);
  };
  const std::int32_t plane =
      table.add_plane({point_at(0, 0), point_at(2, 0), point_at(0, 2)}).plane;
  const GridPoint p = at(0), q = at(1);
  const std::int32_t across =
      table.add_plane({p, q, GridPoint{p.x + 5, p.y - 7, p.z + 1}}).plane;
  int axis = 0;
  EXPECT_TRUE(table.line_axis(plane, across, axis));
  axis_count |= 1 << axis;
  Face face;
  face.plane = plane;
  const std::vector<SolidEdge> edges = edges_of(board, table);
  section.find(face, edges, across, axis);
  int count = 0;
  constexpr int kLong = 5 * kSize;
  for (int k = -kLong; k <= kLong; ++k) {
    const int u = from[0] + k * step[0];
    const int v = from[1] + k * step[1];
    const std::int32_t id = table.add_point(at(k));
    const bool is_there = std::any_of(
        section.parts().begin(), section.parts().end(), [&](const auto& part) {
          return table.compare(axis, part.first, id) <= 0 &&
                 table.compare(axis, id, part.second) <= 0;
        });
    EXPECT_EQ(is_there, holds(board, u, v)) << u << ", " << v;
    count += is_there ? 1 : 0;
  }
  return count;
}

TEST(Section, IsWhatTheFaceAndTheLineHaveInCommon) {
  std::uint64_t state = 3;
  int points = 0, axes = 0;
  for (int round = 0; round < 60; ++round) {
    GeometryTable table(26);
    LineFaceSection section(table);
    Board board;
    for (auto& row : board) {
      for (bool& square : row) square = mix(++state) % 2 == 0;
    }
    SCOPED_TRACE("round " + std::to_string(round));
    for (int start = 0; start <= 2 * kSize; ++start) {
      // Along edges, through squares, and through corners.
      points += check_line(board, {start, 0}, {0, 1}, table, section, axes);
      points += check_line(board, {0, start}, {-1, 0}, table, section, axes);
      points += check_line(board, {start, 0}, {1, 1}, table, section, axes);
      points += check_line(board, {start, 0}, {-1, 1}, table, section, axes);
      points += check_line(board, {start, 0}, {1, -2}, table, section, axes);
      points +=
          check_line(board, {start, 2 * kSize}, {3, -1}, table, section, axes);
    }
    if (::testing::Test::HasFailure()) return;
  }
  EXPECT_GT(points, 10000);
  EXPECT_GT(axes & (axes - 1), 0);
}

TEST(Section, OfAnOpenFaceEndsSomewhere) {
  GeometryTable table(26);
  const std::int32_t p = table.add_point({0, 0, 0});
  const std::int32_t q = table.add_point({4, 2, 0});
  Face face;
  face.plane = table.add_plane({{{0, 0, 0}, {4, 2, 0}, {1, 3, 0}}}).plane;
  const std::int32_t across =
      table.add_plane({{{2, 0, 0}, {2, 1, 0}, {2, 0, 1}}}).plane;
  const std::vector<SolidEdge> edges{{p, q}};
  LineFaceSection section(table);
  section.find(face, edges, across, 1);
  ASSERT_EQ(section.parts().size(), 1u);
  EXPECT_EQ(section.parts()[0].first, section.parts()[0].second);
}

}  // namespace
}  // namespace halfspace::fast
