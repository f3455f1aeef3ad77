#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "adapters/both.hpp"
#include "adapters/scenes.hpp"
#include "definition/definition.hpp"
#include "generate/shapes.hpp"
#include "laws/law.hpp"

namespace halfspace {
namespace {

template <class Impl>
class S3Tree : public ::testing::Test {};
TYPED_TEST_SUITE(S3Tree, Implementations);

/// Trees of several nodes must come up for these laws to mean something.
constexpr int kTreeViews = 150;

/// All rules, some of them with several settings.
std::vector<BuildOptions> all_options() {
  std::vector<BuildOptions> all;
  for (int rule = 0; rule < 9; ++rule)
    all.push_back({static_cast<RootRule>(rule), 5, 1, 75});
  for (const std::uint32_t candidates : {1u, 2u, 3u}) {
    for (const std::uint64_t seed : {std::uint64_t{2}, ~std::uint64_t{0}})
      all.push_back({RootRule::kRandom, candidates, seed, 75});
  }
  for (const std::uint32_t weight : {0u, 1u, 2u, 100u})
    all.push_back({RootRule::kH6, 5, 1, weight});
  return all;
}

/// The tree of the polygons, inserted in this order.
template <class Impl>
typename Impl::Tree inserted(const Scene& scene,
                             const std::vector<PolygonId>& order) {
  auto tree = Impl::build(Scene(), {});
  for (const PolygonId id : order) Impl::insert(tree, scene, id);
  return tree;
}

/// Some orders of the ids: descending, and mixed in different ways.
std::vector<std::vector<PolygonId>> some_orders(const Scene& scene) {
  std::vector<std::vector<PolygonId>> orders;
  for (const PolygonId stride : {-1, 3, 5}) {
    auto ids = ids_of(scene);
    std::stable_sort(ids.begin(), ids.end(), [&](PolygonId a, PolygonId b) {
      const auto key = [&](PolygonId id) {
        return stride < 0 ? -id : id * stride % 7;
      };
      return key(a) < key(b);
    });
    orders.push_back(ids);
  }
  return orders;
}

/// S3.L1: the fragments of each polygon have its vector area.
void expect_areas(const Scene& scene, const TreeName& tree) {
  std::map<PolygonId, definition::Area> areas;
  for (const NodeName& node : tree) {
    for (const FragmentName& fragment : node.coincident) {
      auto& area = areas[fragment.source];
      area = area + definition::area_of(definition::points_of(scene, fragment));
    }
  }
  for (const PolygonId p : ids_of(scene)) {
    HALFSPACE_LAW(areas[p] == definition::area_of(definition::points_of(
                                  scene, definition::whole(scene, p))));
  }
}

/// The nodes of a subtree, its root among them.
std::vector<NodeId> nodes_below(const TreeName& tree, NodeId root) {
  std::vector<NodeId> nodes;
  std::vector<NodeId> ahead = {root};
  while (!ahead.empty()) {
    const NodeId id = ahead.back();
    ahead.pop_back();
    if (id == kNoNode) continue;
    nodes.push_back(id);
    ahead.push_back(tree[static_cast<std::size_t>(id)].positive);
    ahead.push_back(tree[static_cast<std::size_t>(id)].negative);
  }
  return nodes;
}

/// That every fragment of a subtree has this relation to the plane.
void expect_relation(const Scene& scene, const TreeName& tree, NodeId root,
                     const definition::Plane& plane, Relation expected) {
  for (const NodeId id : nodes_below(tree, root)) {
    const auto& node = tree[static_cast<std::size_t>(id)];
    for (const FragmentName& fragment : node.coincident) {
      HALFSPACE_LAW(definition::relation(definition::points_of(scene, fragment),
                                         plane) == expected);
    }
  }
}

/// S3.L2: what is where in a tree.
void expect_sides(const Scene& scene, const TreeName& tree) {
  for (const NodeName& node : tree) {
    const auto plane = definition::plane_of(scene, node.splitter);
    expect_relation(scene, tree, node.positive, plane, Relation::kPositive);
    expect_relation(scene, tree, node.negative, plane, Relation::kNegative);
    bool has_splitter = false;
    for (std::size_t k = 0; k < node.coincident.size(); ++k) {
      const FragmentName& fragment = node.coincident[k];
      has_splitter = has_splitter || fragment.source == node.splitter;
      HALFSPACE_LAW(k == 0 || node.coincident[k - 1].source < fragment.source);
      HALFSPACE_LAW(definition::relation(definition::points_of(scene, fragment),
                                         plane) == Relation::kCoincident);
    }
    HALFSPACE_LAW(has_splitter);
  }
}

TYPED_TEST(S3Tree, L1TheAreasOfAPolygonsFragmentsAddUp) {
  std::size_t splits = 0;
  law::for_all_views(
      [&](const SceneFile& view) {
        for (const BuildOptions& options :
             {all_options()[0], all_options()[3], all_options()[6]}) {
          const auto tree = TypeParam::build(view.scene, options);
          expect_areas(view.scene, TypeParam::name_of(tree));
          splits += TypeParam::stats(tree).splits;
        }
      },
      kTreeViews);
  EXPECT_GT(splits, 500u);
}

TYPED_TEST(S3Tree, L2EveryFragmentIsOnItsSideOfEveryNodeAbove) {
  law::for_all_views(
      [&](const SceneFile& view) {
        for (const BuildOptions& options : all_options()) {
          expect_sides(view.scene, TypeParam::name_of(
                                       TypeParam::build(view.scene, options)));
        }
      },
      kTreeViews);
}

TYPED_TEST(S3Tree, L3TheSizeAgreesWithTheName) {
  std::size_t height = 0;
  law::for_all_views([&](const SceneFile& view) {
    for (const BuildOptions& options : all_options()) {
      const auto tree = TypeParam::build(view.scene, options);
      const TreeName name = TypeParam::name_of(tree);
      TreeStats expected;
      expected.nodes = name.size();
      // A child comes after its parent in the list.
      std::vector<std::size_t> depth(name.size(), 1);
      for (std::size_t id = 0; id < name.size(); ++id) {
        for (const NodeId child : {name[id].positive, name[id].negative}) {
          if (child == kNoNode) continue;
          HALFSPACE_LAW(static_cast<std::size_t>(child) > id);
          depth[static_cast<std::size_t>(child)] = depth[id] + 1;
        }
        expected.height = std::max(expected.height, depth[id]);
        expected.fragments += name[id].coincident.size();
      }
      expected.splits = expected.fragments - view.scene.polygon_count();
      HALFSPACE_LAW(TypeParam::stats(tree) == expected);
      height = std::max(height, expected.height);
    }
  });
  EXPECT_GT(height, 5u);
}

TYPED_TEST(S3Tree, L4TheRootIsTheOneThatTheRuleNames) {
  std::map<RootRule, std::set<PolygonId>> roots;
  law::for_all_views(
      [&](const SceneFile& view) {
        if (view.scene.polygon_count() == 0) return;
        for (const BuildOptions& options : all_options()) {
          const auto tree =
              TypeParam::name_of(TypeParam::build(view.scene, options));
          const PolygonId expected =
              definition::build(view.scene, options).front().splitter;
          HALFSPACE_LAW(tree.front().splitter == expected);
          roots[options.rule].insert(expected);
        }
      },
      kTreeViews);
  for (const auto& [rule, ids] : roots) {
    if (rule == RootRule::kFirst) continue;
    EXPECT_GT(ids.size(), 3u) << "rule " << static_cast<int>(rule);
  }
}

TYPED_TEST(S3Tree, L5TheSameSceneRuleAndSeedGiveTheSameTree) {
  std::map<RootRule, std::size_t> not_first;
  law::for_all_views(
      [&](const SceneFile& view) {
        TreeName first;
        for (const BuildOptions& options : all_options()) {
          const auto tree =
              TypeParam::name_of(TypeParam::build(view.scene, options));
          HALFSPACE_LAW(tree == TypeParam::name_of(
                                    TypeParam::build(view.scene, options)));
          // In the definition each subtree is that of its own list and key.
          HALFSPACE_LAW(tree == definition::build(view.scene, options));
          if (options.rule == RootRule::kFirst) first = tree;
          if (tree != first) ++not_first[options.rule];
        }
      },
      kTreeViews);
  for (int rule = 1; rule < 9; ++rule)
    EXPECT_GT(not_first[static_cast<RootRule>(rule)], 20u) << "rule " << rule;
}

TYPED_TEST(S3Tree, L6AllCandidatesMakeFewestCutsOfAnyRandomRule) {
  law::for_all_views([&](const SceneFile& view) {
    const auto tree_by = [&](RootRule rule, std::uint32_t candidates) {
      return TypeParam::name_of(
          TypeParam::build(view.scene, {rule, candidates, 4, 75}));
    };
    const TreeName fewest = tree_by(RootRule::kFewestCuts, 1);
    HALFSPACE_LAW(tree_by(RootRule::kH1, 1) == fewest);
    const auto all = static_cast<std::uint32_t>(
        std::max<std::size_t>(1, view.scene.polygon_count()));
    HALFSPACE_LAW(tree_by(RootRule::kRandom, all) == fewest);
    HALFSPACE_LAW(tree_by(RootRule::kRandom, 4000000000u) == fewest);
  });
}

/// The rectangles of S3's Theorem 1, for n = 2m.
Scene theorem_1(std::int64_t m) {
  generate::Polygons rectangles;
  for (std::int64_t i = 0; i < m; ++i) {
    rectangles.push_back(
        {{0, 0, i + 1}, {1, 0, i + 1}, {1, m + 2, i + 1}, {0, m + 2, i + 1}});
  }
  for (std::int64_t j = 0; j < m; ++j) {
    rectangles.push_back(
        {{2, j + 1, 0}, {3, j + 1, 0}, {3, j + 1, m + 1}, {2, j + 1, m + 1}});
  }
  return generate::scene_of(rectangles, {});
}

TYPED_TEST(S3Tree, L7Theorem1HoldsForEveryRuleAndOrder) {
  for (std::size_t m = 1; m <= 6; ++m) {
    const Scene scene = theorem_1(static_cast<std::int64_t>(m));
    const std::size_t n = 2 * m;
    for (const BuildOptions& options : all_options()) {
      const auto tree = TypeParam::build(scene, options);
      EXPECT_EQ(TypeParam::stats(tree).nodes, n * (n + 4) / 4)
          << "n = " << n << ", rule " << static_cast<int>(options.rule);
    }
    for (const auto& order : some_orders(scene)) {
      const auto tree = inserted<TypeParam>(scene, order);
      EXPECT_EQ(TypeParam::stats(tree).nodes, n * (n + 4) / 4);
    }
  }
}

/// The polygons of S3's Theorem 2.
Scene theorem_2(std::int64_t m) {
  generate::Polygons polygons = {{{m + 1, 2 * m + 1, 0},
                                  {m + 1, 2 * m + 1, 2 * m + 6},
                                  {m - 1, 2 * m + 5, 2 * m + 6},
                                  {m - 1, 2 * m + 5, 0}}};
  for (std::int64_t j = 0; j < m; ++j) {
    polygons.push_back({{2 * m, 2 * j + 2, 0},
                        {3 * m, 2 * j + 2, 0},
                        {3 * m, 2 * j + 2, 2 * m + 2},
                        {2 * m, 2 * j + 2, 2 * m + 2}});
  }
  polygons.push_back(
      {{0, 0, 1}, {m, 0, 1}, {m, 2 * m - 1, 1}, {0, 2 * m - 1, 1}});
  for (std::int64_t i = 0; i < m; ++i) {
    polygons.push_back({{0, 0, 2 * i + 2},
                        {m, 0, 2 * i + 2},
                        {m, 2 * m + 4, 2 * i + 2},
                        {0, 2 * m + 4, 2 * i + 2}});
  }
  return generate::scene_of(polygons, {});
}

TYPED_TEST(S3Tree, L8Theorem2sInstanceIsLinearButNotForTheGreedy) {
  for (std::size_t m = 2; m <= 6; ++m) {
    const Scene scene = theorem_2(static_cast<std::int64_t>(m));
    const auto first = TypeParam::build(scene, {RootRule::kFirst});
    const auto greedy = TypeParam::build(scene, {RootRule::kFewestCuts});
    EXPECT_EQ(TypeParam::stats(first).nodes, 4 * m + 4) << "m = " << m;
    EXPECT_EQ(TypeParam::stats(greedy).nodes, m * m + 4 * m + 1) << "m = " << m;
  }
}

/// HEUR's graph G(I) of a scene: which planes cut which polygons.
std::vector<std::vector<bool>> graph_of(const Scene& scene) {
  std::vector<std::vector<bool>> cuts;
  for (const PolygonId a : ids_of(scene)) {
    cuts.emplace_back();
    for (const PolygonId b : ids_of(scene)) {
      const auto points =
          definition::points_of(scene, definition::whole(scene, b));
      cuts.back().push_back(
          definition::relation(points, definition::plane_of(scene, a)) ==
          Relation::kSpanning);
    }
  }
  return cuts;
}

bool has_cycle(std::vector<std::vector<bool>> graph) {
  const std::size_t n = graph.size();
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        if (graph[i][k] && graph[k][j]) graph[i][j] = true;
      }
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (graph[i][i]) return true;
  }
  return false;
}

bool has_coplanar(const Scene& scene) {
  for (const PolygonId p : ids_of(scene)) {
    const auto points =
        definition::points_of(scene, definition::whole(scene, p));
    for (PolygonId q = 0; q < p; ++q) {
      if (definition::relation(points, definition::plane_of(scene, q)) ==
          Relation::kCoincident)
        return true;
    }
  }
  return false;
}

TYPED_TEST(S3Tree, L9WithoutCyclesH1AndH3MakeNoSplit) {
  std::size_t edges = 0, largest = 0;
  law::for_all_views(
      [&](const SceneFile& view) {
        // As many polygons of the scene as go without cycle.
        std::vector<PolygonId> ids;
        for (const PolygonId p : ids_of(view.scene)) {
          ids.push_back(p);
          const Scene more = chosen(view.scene, ids);
          if (has_cycle(graph_of(more)) || has_coplanar(more)) ids.pop_back();
        }
        const Scene scene = chosen(view.scene, ids);
        for (const RootRule rule : {RootRule::kH1, RootRule::kH3}) {
          const TreeStats stats =
              TypeParam::stats(TypeParam::build(scene, {rule}));
          HALFSPACE_LAW(stats.nodes == ids.size());
          HALFSPACE_LAW(stats.splits == 0);
        }
        for (const auto& row : graph_of(scene))
          edges += static_cast<std::size_t>(
              std::count(row.begin(), row.end(), true));
        largest = std::max(largest, ids.size());
      },
      kTreeViews);
  EXPECT_GT(edges, 100u);
  EXPECT_GT(largest, 5u);
}

TYPED_TEST(S3Tree, L10InsertionInOrderIsTheTreeOfTheFirstRule) {
  std::size_t different = 0;
  law::for_all_views(
      [&](const SceneFile& view) {
        const Scene& scene = view.scene;
        const TreeName first =
            TypeParam::name_of(TypeParam::build(scene, {RootRule::kFirst}));
        HALFSPACE_LAW(TypeParam::name_of(
                          inserted<TypeParam>(scene, ids_of(scene))) == first);
        for (const auto& order : some_orders(scene)) {
          const TreeName tree =
              TypeParam::name_of(inserted<TypeParam>(scene, order));
          expect_areas(scene, tree);
          expect_sides(scene, tree);
          if (tree != first) ++different;
        }
      },
      kTreeViews);
  EXPECT_GT(different, 50u);
}

/// The fragments of a tree in the order of the walk that takes positive
/// subtrees first, but for those of some polygons.
std::vector<FragmentName> fragments_left(const TreeName& tree,
                                         const std::set<PolygonId>& gone) {
  std::vector<FragmentName> fragments;
  std::vector<std::pair<NodeId, bool>> ahead;  // and whether it is to be shown
  if (!tree.empty()) ahead.push_back({0, false});
  while (!ahead.empty()) {
    const auto [id, show] = ahead.back();
    ahead.pop_back();
    if (id == kNoNode) continue;
    const NodeName& node = tree[static_cast<std::size_t>(id)];
    if (!show) {
      ahead.push_back({node.negative, false});
      ahead.push_back({id, true});
      ahead.push_back({node.positive, false});
      continue;
    }
    for (const FragmentName& fragment : node.coincident) {
      if (!gone.contains(fragment.source)) fragments.push_back(fragment);
    }
  }
  return fragments;
}

/// S3.L18: what is left of a tree.
void expect_left(const TreeName& before, const TreeName& after,
                 const std::set<PolygonId>& gone) {
  HALFSPACE_LAW(fragments_left(after, {}) == fragments_left(before, gone));
  for (const NodeName& node : after) {
    HALFSPACE_LAW(!node.coincident.empty() ||
                  (node.positive != kNoNode && node.negative != kNoNode));
  }
}

/// The image of the scene without some polygons, with the ids of all.
Image image_without(const SceneFile& view, const std::set<PolygonId>& gone) {
  std::vector<PolygonId> ids;
  for (const PolygonId id : ids_of(view.scene)) {
    if (!gone.contains(id)) ids.push_back(id);
  }
  Image image =
      oracle::zbuffer(chosen(view.scene, ids), *view.camera, view.options);
  for (PolygonId& item : image.items.pixels) {
    if (item != kBackground) item = ids[static_cast<std::size_t>(item)];
  }
  return image;
}

TYPED_TEST(S3Tree, L18RemovalLeavesTheOtherPolygonsAsTheyWere) {
  std::size_t bare = 0;  // nodes without fragments
  law::for_all_views(
      [&](const SceneFile& with_clips) {
        SceneFile view = with_clips;
        view.options.clips.clear();
        view.options.caps = std::nullopt;
        const Scene& scene = view.scene;
        for (const PolygonId one_of : {2, 3}) {
          std::set<PolygonId> gone;
          std::vector<PolygonId> last;
          for (const PolygonId id : ids_of(scene)) {
            if (id % one_of == 0) gone.insert(id);
            if (id % one_of == 0) last.push_back(id);
          }
          auto tree = TypeParam::build(scene, {RootRule::kRandom, 2, 5, 75});
          const TreeName before = TypeParam::name_of(tree);
          TypeParam::remove(tree, last);
          const TreeName after = TypeParam::name_of(tree);
          expect_left(before, after, gone);
          bare += static_cast<std::size_t>(std::count_if(
              after.begin(), after.end(),
              [](const auto& node) { return node.coincident.empty(); }));
          const Image expected = image_without(view, gone);
          const Image image =
              TypeParam::render(scene, tree, *view.camera, view.options);
          HALFSPACE_LAW(image.items == expected.items);
          HALFSPACE_LAW(image.colors == expected.colors);
          // They come again, and go again.
          for (const PolygonId id : last) TypeParam::insert(tree, scene, id);
          expect_areas(scene, TypeParam::name_of(tree));
          TypeParam::remove(tree, last);
          HALFSPACE_LAW(TypeParam::name_of(tree) == after);
        }
        auto tree = TypeParam::build(scene, {});
        TypeParam::remove(tree, ids_of(scene));
        HALFSPACE_LAW(TypeParam::name_of(tree).empty());
      },
      kTreeViews);
  EXPECT_GT(bare, 50u);
}

}  // namespace
}  // namespace halfspace
