#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "halfspace/fast/build.hpp"
#include "scenes.hpp"

/// HEUR's theorems (S3), at sizes that the reference does not reach.
namespace halfspace::fast {
namespace {

constexpr RootRule kRules[] = {
    RootRule::kFirst, RootRule::kRandom, RootRule::kFewestCuts,
    RootRule::kH1,    RootRule::kH2,     RootRule::kH3,
    RootRule::kH4,    RootRule::kH5,     RootRule::kH6};

Scene theorem_1(std::int64_t m) {
  SceneData all;
  for (std::int64_t i = 1; i <= m; ++i) {
    add_polygon(all, {{0, 0, i}, {1, 0, i}, {1, m + 2, i}, {0, m + 2, i}});
  }
  for (std::int64_t j = 1; j <= m; ++j) {
    add_polygon(all, {{2, j, 0}, {3, j, 0}, {3, j, m + 1}, {2, j, m + 1}});
  }
  return made(std::move(all));
}

Scene theorem_2(std::int64_t m) {
  SceneData all;
  add_polygon(all, {{m + 1, 2 * m + 1, 0},
                    {m + 1, 2 * m + 1, 2 * m + 6},
                    {m - 1, 2 * m + 5, 2 * m + 6},
                    {m - 1, 2 * m + 5, 0}});
  for (std::int64_t j = 0; j < m; ++j) {
    const std::int64_t y = 2 * j + 2;
    const std::int64_t top = 2 * m + 2;
    add_polygon(
        all, {{2 * m, y, 0}, {3 * m, y, 0}, {3 * m, y, top}, {2 * m, y, top}});
  }
  const std::int64_t end = 2 * m - 1;
  add_polygon(all, {{0, 0, 1}, {m, 0, 1}, {m, end, 1}, {0, end, 1}});
  for (std::int64_t i = 0; i < m; ++i) {
    const std::int64_t z = 2 * i + 2;
    const std::int64_t far = 2 * m + 4;
    add_polygon(all, {{0, 0, z}, {m, 0, z}, {m, far, z}, {0, far, z}});
  }
  return made(std::move(all));
}

TEST(Heur, Theorem1HoldsForEveryRuleAndOrder) {
  std::mt19937_64 random(5);
  for (const std::size_t m : {1u, 2u, 7u, 25u}) {
    const Scene scene = theorem_1(static_cast<std::int64_t>(m));
    const std::size_t n = 2 * m;
    for (const RootRule rule : kRules) {
      EXPECT_EQ(stats(build(scene, {rule})).nodes, n * (n + 4) / 4)
          << "n = " << n << ", rule " << static_cast<int>(rule);
    }
    std::vector<PolygonId> order(n);
    std::iota(order.begin(), order.end(), 0);
    for (int round = 0; round < 3; ++round) {
      BspTree grown;
      for (const PolygonId p : order) insert(grown, scene, p);
      EXPECT_EQ(stats(grown).nodes, n * (n + 4) / 4) << "n = " << n;
      std::shuffle(order.begin(), order.end(), random);
    }
  }
}

TEST(Heur, Theorem2sInstanceIsLinearButNotForTheGreedy) {
  for (const std::size_t m : {2u, 5u, 20u, 50u}) {
    const Scene scene = theorem_2(static_cast<std::int64_t>(m));
    const TreeStats first = stats(build(scene, {RootRule::kFirst}));
    const TreeStats greedy = stats(build(scene, {RootRule::kFewestCuts}));
    EXPECT_EQ(first.nodes, 4 * m + 4) << "m = " << m;
    EXPECT_EQ(greedy.nodes, m * m + 4 * m + 1) << "m = " << m;
  }
}

/// A graph of which planes cut which polygons, grown by a polygon at a time
/// that leaves it without a cycle.
class Acyclic {
 public:
  /// Whether a polygon that is cut by `cut_by` and cuts `cuts` makes no cycle;
  /// adds it if so.
  bool add(const std::vector<std::size_t>& cut_by,
           const std::vector<std::size_t>& cuts) {
    for (const std::size_t from : cuts) {
      for (const std::size_t to : cut_by) {
        if (from == to || reaches_[from][to]) return false;
      }
    }
    const std::size_t self = reaches_.size();
    for (auto& row : reaches_) row.push_back(false);
    reaches_.emplace_back(self + 1, false);
    for (const std::size_t to : cuts) {
      reaches_[self][to] = true;
      for (std::size_t k = 0; k < self; ++k) {
        if (reaches_[to][k]) reaches_[self][k] = true;
      }
    }
    for (std::size_t from = 0; from < self; ++from) {
      bool leads = false;
      for (const std::size_t by : cut_by) {
        leads = leads || from == by || reaches_[from][by];
      }
      if (!leads) continue;
      for (std::size_t k = 0; k <= self; ++k) {
        if (k == self || reaches_[self][k]) reaches_[from][k] = true;
      }
    }
    edges_ += cuts.size() + cut_by.size();
    return true;
  }
  std::size_t edges() const { return edges_; }

 private:
  std::vector<std::vector<bool>> reaches_;
  std::size_t edges_ = 0;
};

TEST(Heur, WithoutCyclesH1AndH3MakeNoSplit) {
  std::mt19937_64 random(9);
  const auto coordinate = [&random](std::int64_t size) {
    return static_cast<std::int64_t>(random() %
                                     static_cast<std::uint64_t>(size));
  };
  SceneData all;
  for (int k = 0; k < 400; ++k) {
    const GridPoint p = {coordinate(1000), coordinate(1000), coordinate(1000)};
    add_polygon(all, {p,
                      {p.x + 90, p.y, p.z + coordinate(90)},
                      {p.x, p.y + 90, p.z + coordinate(90)}});
  }
  const Scene every = made(all);
  FilterStats decisions;
  Acyclic graph;
  std::vector<PolygonId> taken;
  SceneData some;
  for (PolygonId p = 0; p < 400; ++p) {
    std::vector<std::size_t> cut_by;
    std::vector<std::size_t> cuts;
    bool coplanar = false;
    for (std::size_t k = 0; k < taken.size(); ++k) {
      const Fragment here = whole(every, p);
      const Fragment there = whole(every, taken[k]);
      const Relation by = relation(every, here, taken[k], decisions);
      coplanar = coplanar || by == Relation::kCoincident;
      if (by == Relation::kSpanning) cut_by.push_back(k);
      if (relation(every, there, p, decisions) == Relation::kSpanning) {
        cuts.push_back(k);
      }
    }
    if (coplanar || !graph.add(cut_by, cuts)) continue;
    taken.push_back(p);
    std::vector<GridPoint> corners;
    for (const VertexId v : every.corners(p)) corners.push_back(every.point(v));
    add_polygon(some, corners);
  }
  EXPECT_GT(taken.size(), 15u);
  EXPECT_GT(graph.edges(), 50u);
  for (const RootRule rule : {RootRule::kH1, RootRule::kH3}) {
    const TreeStats found = stats(build(made(some), {rule}));
    EXPECT_EQ(found.nodes, taken.size());
    EXPECT_EQ(found.splits, 0u);
  }
}

}  // namespace
}  // namespace halfspace::fast
