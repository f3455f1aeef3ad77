#include <algorithm>
#include <tuple>
#include <utility>

#include "definition/definition.hpp"

namespace halfspace::definition {
namespace {

/// A fragment in a list from which a root is chosen, and its vertices.
struct Member {
  FragmentName name;
  std::vector<Point> points;
  Plane plane;
};

Member member_of(const Scene& scene, const FragmentName& name) {
  return {name, points_of(scene, name), plane_of(scene, name.source)};
}

/// How a list lies against the plane of one of its members (S3.3), as far as
/// the rule asks for it.
struct Degrees {
  std::int64_t cuts = 0;
  std::int64_t cut_by = 0;
  std::int64_t difference = 0;  ///< |IN - OUT|
};

Degrees degrees_of(const std::vector<Member>& list, const Member& member,
                   RootRule rule) {
  Degrees degrees;
  if (rule == RootRule::kFirst) return degrees;
  const bool asks_who_cuts = rule == RootRule::kH2 || rule == RootRule::kH3;
  for (const Member& other : list) {
    const Relation seen = relation(other.points, member.plane);
    degrees.cuts += seen == Relation::kSpanning ? 1 : 0;
    degrees.difference += seen == Relation::kPositive ? 1 : 0;
    degrees.difference -= seen == Relation::kNegative ? 1 : 0;
    if (asks_who_cuts &&
        relation(member.points, other.plane) == Relation::kSpanning) {
      ++degrees.cut_by;
    }
  }
  degrees.difference = std::abs(degrees.difference);
  return degrees;
}

/// What the rule wants to be least, in order; the id decides ties.
using Score = std::tuple<std::int64_t, std::int64_t, PolygonId>;

Score score_of(const Degrees& d, const BuildOptions& options, PolygonId id) {
  switch (options.rule) {
    case RootRule::kFirst:
      break;
    case RootRule::kRandom:
    case RootRule::kFewestCuts:
    case RootRule::kH1:
      return {d.cuts, 0, id};
    case RootRule::kH2:
      return {-d.cut_by, 0, id};
    case RootRule::kH3:
      return {d.cuts, -d.cut_by, id};
    case RootRule::kH4:
      return {d.difference, 0, id};
    case RootRule::kH5:
      return {d.cuts * d.difference, 0, id};
    case RootRule::kH6:
      return {options.cut_weight * d.cuts + d.difference, 0, id};
  }
  return {0, 0, id};
}

/// Which members may become the root (S3.4).
std::vector<std::size_t> candidates_of(std::size_t count,
                                       const BuildOptions& options,
                                       std::uint64_t key) {
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < count; ++i) left.push_back(i);
  if (options.rule != RootRule::kRandom || count <= options.candidates)
    return left;
  for (std::size_t drawn = 0; drawn < options.candidates; ++drawn)
    std::swap(left[drawn], left[drawn + draw(key, drawn, count - drawn)]);
  left.resize(options.candidates);
  return left;
}

const Member& root_of(const std::vector<Member>& list,
                      const BuildOptions& options, std::uint64_t key) {
  const Member* best = nullptr;
  Score least;
  for (const std::size_t i : candidates_of(list.size(), options, key)) {
    const Score score = score_of(degrees_of(list, list[i], options.rule),
                                 options, list[i].name.source);
    if (best != nullptr && !(score < least)) continue;
    best = &list[i];
    least = score;
  }
  return *best;
}

/// A subtree to be built, and whose child it will be.
struct Task {
  std::vector<Member> list;
  std::uint64_t key;
  NodeId parent;
  bool positive;
};

/// Divides the list by the plane of its root.
void divide(const Scene& scene, const Task& task, const Member& root,
            NodeName& node, Task& positive, Task& negative) {
  node.splitter = root.name.source;
  for (const Member& member : task.list) {
    switch (relation(member.points, root.plane)) {
      case Relation::kCoincident:
        node.coincident.push_back(member.name);
        break;
      case Relation::kPositive:
        positive.list.push_back(member);
        break;
      case Relation::kNegative:
        negative.list.push_back(member);
        break;
      case Relation::kSpanning: {
        const Parts parts = split(scene, member.name, node.splitter);
        positive.list.push_back(member_of(scene, parts.positive));
        negative.list.push_back(member_of(scene, parts.negative));
        break;
      }
    }
  }
}

/// A node's part in a traversal: its subtree, or its own fragments.
struct Step {
  NodeId node;
  bool whole_subtree;
};

std::vector<FragmentName> traverse(const Scene& scene, const TreeName& tree,
                                   const Camera& camera, bool near_first) {
  std::vector<FragmentName> order;
  std::vector<Step> steps;
  if (!tree.empty()) steps.push_back({0, true});
  while (!steps.empty()) {
    const Step step = steps.back();
    steps.pop_back();
    if (step.node == kNoNode) continue;
    const NodeName& node = tree[static_cast<std::size_t>(step.node)];
    const int eye = side_of_eye(plane_of(scene, node.splitter), camera);
    if (!step.whole_subtree) {
      auto own = node.coincident;
      if (!near_first) std::reverse(own.begin(), own.end());
      if (eye != 0) order.insert(order.end(), own.begin(), own.end());
      continue;
    }
    NodeId first = eye < 0 ? node.negative : node.positive;
    NodeId last = eye < 0 ? node.positive : node.negative;
    if (!near_first) std::swap(first, last);
    steps.push_back({last, true});
    steps.push_back({step.node, false});
    steps.push_back({first, true});
  }
  return order;
}

}  // namespace

TreeName build(const Scene& scene, const BuildOptions& options) {
  TreeName tree;
  Task all{{}, root_key(options.seed), kNoNode, false};
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    all.list.push_back(
        member_of(scene, whole(scene, static_cast<PolygonId>(p))));
  }
  std::vector<Task> tasks{std::move(all)};
  while (!tasks.empty()) {
    const Task task = std::move(tasks.back());
    tasks.pop_back();
    if (task.list.empty()) continue;
    const auto id = static_cast<NodeId>(tree.size());
    tree.emplace_back();
    if (task.parent != kNoNode) {
      NodeName& parent = tree[static_cast<std::size_t>(task.parent)];
      (task.positive ? parent.positive : parent.negative) = id;
    }
    Task positive{{}, positive_key(task.key), id, true};
    Task negative{{}, negative_key(task.key), id, false};
    divide(scene, task, root_of(task.list, options, task.key), tree.back(),
           positive, negative);
    tasks.push_back(std::move(negative));
    tasks.push_back(std::move(positive));
  }
  return tree;
}

std::vector<FragmentName> back_to_front(const Scene& scene,
                                        const TreeName& tree,
                                        const Camera& camera) {
  return traverse(scene, tree, camera, false);
}

std::vector<FragmentName> front_to_back(const Scene& scene,
                                        const TreeName& tree,
                                        const Camera& camera) {
  return traverse(scene, tree, camera, true);
}

}  // namespace halfspace::definition
