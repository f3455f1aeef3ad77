#include "sah/cell_division.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include "scenes.hpp"

namespace halfspace::fast {
namespace {

/// Triangles of which many have sides in planes across axes, at few
/// coordinates: `step` apart.
Scene on_few_coordinates(int count, std::int64_t step, unsigned seed) {
  std::mt19937 random(seed);
  SceneData data;
  data.grid_bits = 54;
  const auto draw = [&](std::uint32_t below) {
    return static_cast<std::int64_t>(random() % below);
  };
  while (data.colors.size() < static_cast<std::size_t>(count)) {
    const GridPoint at = {step * draw(70), step * draw(70), step * draw(70)};
    const auto near = [&](std::int64_t x, std::int64_t y, std::int64_t z) {
      return GridPoint{at.x + x * step, at.y + y * step, at.z + z * step};
    };
    const std::int64_t w = 1 + draw(9);
    switch (draw(4)) {
      case 0:
        add_polygon(data, {near(0, 0, 0), near(0, w, 0), near(0, 0, w)});
        break;
      case 1:
        add_polygon(data, {near(0, 0, 0), near(w, 0, 0), near(0, 0, w)});
        break;
      case 2:
        add_polygon(data, {near(0, 0, 0), near(w, 0, 0), near(0, w, 0)});
        break;
      default:
        add_polygon(data, {near(0, 0, w), near(w, 0, 0), near(0, w, draw(5))});
    }
  }
  return made(std::move(data));
}

/// Whether a part of the polygon's box is the region's: what lies in a plane
/// belongs to its positive side.
bool reaches(const GridRange& range, const CellRegion& region) {
  for (std::size_t a = 0; a < 3; ++a) {
    if (range.low[a] >= region.high[a]) return false;
    if (range.high[a] <= region.low[a] && range.low[a] < region.low[a])
      return false;
  }
  return true;
}

GridRange range_of_all(const Scene& scene) {
  GridRange all = range_of(scene, 0);
  for (std::size_t p = 1; p < scene.polygon_count(); ++p) {
    const GridRange range = range_of(scene, static_cast<PolygonId>(p));
    for (std::size_t a = 0; a < 3; ++a) {
      all.low[a] = std::min(all.low[a], range.low[a]);
      all.high[a] = std::max(all.high[a], range.high[a]);
    }
  }
  return all;
}

/// The cells of a division have just those polygons of the list that reach
/// them, and their ranges hold what of these is in the cell.
void expect_divided(const Scene& scene, const CellList& list,
                    const DividedCells& divided) {
  std::vector<PolygonId> all = list.polygons;
  if (all.empty()) {
    all.resize(scene.polygon_count());
    std::iota(all.begin(), all.end(), 0);
  }
  for (const CellList& cell : divided.cells) {
    std::vector<PolygonId> expected;
    for (const PolygonId polygon : all) {
      const GridRange range = range_of(scene, polygon);
      if (!reaches(range, cell.region)) continue;
      expected.push_back(polygon);
      for (std::size_t a = 0; a < 3; ++a) {
        ASSERT_LE(cell.range.low[a],
                  std::max(range.low[a], cell.region.low[a]));
        ASSERT_GE(cell.range.high[a],
                  std::min(range.high[a], cell.region.high[a]));
      }
    }
    ASSERT_EQ(cell.polygons, expected);
    ASSERT_FALSE(cell.polygons.empty());
  }
  ASSERT_EQ(divided.tree.nodes.size(), divided.cell_of_node.size());
  ASSERT_EQ(divided.tree.boxes.size(), divided.cell_of_node.size());
  ASSERT_EQ(divided.cells.size() * 2 - 1, divided.tree.nodes.size());
}

TEST(CellDivision, CellsHaveThePolygonsThatReachThem) {
  std::size_t in_planes = 0;
  std::size_t again = 0;
  for (const std::int64_t step :
       {std::int64_t{1}, std::int64_t{3}, std::int64_t{1} << 20,
        (std::int64_t{1} << 45) + 1}) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
      const Scene scene = on_few_coordinates(900, step, seed);
      CellList list;
      list.range = range_of_all(scene);
      const auto divided = divide_into_cells(scene, list, 20, 10000, 1);
      ASSERT_TRUE(divided.has_value());
      expect_divided(scene, list, *divided);
      if (HasFatalFailure()) return;
      const auto same = divide_into_cells(scene, list, 20, 10000, 3);
      ASSERT_EQ(same->cells.size(), divided->cells.size());
      for (std::size_t c = 0; c < divided->cells.size(); ++c) {
        const CellList& cell = divided->cells[c];
        ASSERT_EQ(cell.polygons, same->cells[c].polygons);
        for (const PolygonId polygon : cell.polygons) {
          const GridRange range = range_of(scene, polygon);
          for (std::size_t a = 0; a < 3; ++a) {
            in_planes += range.low[a] == range.high[a] &&
                                 range.low[a] == cell.region.low[a]
                             ? 1u
                             : 0u;
          }
        }
        const auto inner = divide_into_cells(scene, cell, 3, 10000, 1);
        if (!inner) continue;
        ++again;
        expect_divided(scene, cell, *inner);
        if (HasFatalFailure()) return;
      }
    }
  }
  EXPECT_GT(in_planes, 300u);
  EXPECT_GT(again, 300u);
}

TEST(CellDivision, ListsAreBounded) {
  const Scene scene = on_few_coordinates(900, 5, 7);
  CellList list;
  list.range = range_of_all(scene);
  const auto named = [](const DividedCells& divided) {
    std::size_t count = 0;
    for (const CellList& cell : divided.cells) count += cell.polygons.size();
    return count;
  };
  const auto many = divide_into_cells(scene, list, 5, 100000, 1);
  const auto few = divide_into_cells(scene, list, 5, 1200, 1);
  EXPECT_GT(named(*many), 1200u);
  EXPECT_LE(named(*few), 1200u);
  EXPECT_LT(few->cells.size(), many->cells.size());
  EXPECT_FALSE(divide_into_cells(scene, list, 5, 899, 1).has_value());
  EXPECT_FALSE(divide_into_cells(scene, list, 900, 100000, 1).has_value());
}

TEST(CellDivision, PolygonsInOnePlaceAreNotDivided) {
  SceneData data;
  for (int k = 0; k < 50; ++k)
    add_polygon(data, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  const Scene scene = made(std::move(data));
  CellList list;
  list.range = range_of_all(scene);
  EXPECT_FALSE(divide_into_cells(scene, list, 5, 1000, 1).has_value());
}

}  // namespace
}  // namespace halfspace::fast
