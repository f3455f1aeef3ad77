#include "halfspace/ref/build.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "halfspace/assert.hpp"
#include "halfspace/ref/split.hpp"
#include "halfspace/ref/splitter.hpp"

namespace halfspace::ref {
namespace {

/// A subtree still to be made.
struct Task {
  std::vector<Fragment> polygons;  ///< in id order
  std::uint64_t key;
  NodeId parent;
  Side side;  ///< of the parent
};

/// Makes `child` the child of `parent`, which may be none, on its `side`.
void link(BspTree& tree, NodeId parent, Side side, NodeId child) {
  if (parent == kNoNode) return;
  Node& node = tree.nodes[static_cast<std::size_t>(parent)];
  (side == Side::kPositive ? node.positive : node.negative) = child;
}

/// Divides `polygons` by the node's plane: into the node, and into the lists
/// for its two sides.
void distribute(std::vector<Fragment> polygons, Node& node,
                std::vector<Fragment>& positive,
                std::vector<Fragment>& negative) {
  for (Fragment& polygon : polygons) {
    switch (relation(polygon, node.plane)) {
      case Relation::kCoincident:
        node.coincident.push_back(std::move(polygon));
        break;
      case Relation::kPositive:
        positive.push_back(std::move(polygon));
        break;
      case Relation::kNegative:
        negative.push_back(std::move(polygon));
        break;
      case Relation::kSpanning: {
        SplitResult parts = split(polygon, node.plane, node.splitter);
        positive.push_back(std::move(parts.positive));
        negative.push_back(std::move(parts.negative));
        break;
      }
    }
  }
}

/// Puts `fragment` into the list, which is in id order.
void put(std::vector<Fragment>& coincident, Fragment fragment) {
  const auto place = std::upper_bound(
      coincident.begin(), coincident.end(), fragment,
      [](const Fragment& f, const Fragment& g) { return f.source < g.source; });
  coincident.insert(place, std::move(fragment));
}

}  // namespace

BspTree build(const Scene& scene, const BuildOptions& options) {
  std::vector<Fragment> polygons;
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    polygons.push_back(whole(scene, static_cast<PolygonId>(p)));
  }
  return build(planes_of(scene), std::move(polygons), options);
}

BspTree build(const std::vector<Plane>& planes, std::vector<Fragment> polygons,
              const BuildOptions& options) {
  HALFSPACE_ASSERT(options.candidates >= 1);
  BspTree tree;
  std::vector<Task> tasks;
  if (!polygons.empty()) {
    tasks.push_back(
        {std::move(polygons), root_key(options.seed), kNoNode, Side::kOn});
  }
  while (!tasks.empty()) {
    Task task = std::move(tasks.back());
    tasks.pop_back();

    // Step 1: choose the root; its plane is the node's.
    const std::size_t root =
        choose_root(planes, task.polygons, options, task.key);
    const PolygonId splitter = task.polygons[root].source;
    const auto id = static_cast<NodeId>(tree.nodes.size());
    tree.nodes.push_back(
        {splitter, planes[static_cast<std::size_t>(splitter)], {}});
    link(tree, task.parent, task.side, id);

    // Step 2: the polygons in that plane stay, the others go to its sides; the
    // parts of those that it cuts go to both.
    std::vector<Fragment> positive;
    std::vector<Fragment> negative;
    distribute(std::move(task.polygons), tree.nodes.back(), positive, negative);

    // Step 3: make the subtrees of the sides that are not empty; the last task
    // is next.
    if (!negative.empty()) {
      tasks.push_back(
          {std::move(negative), negative_key(task.key), id, Side::kNegative});
    }
    if (!positive.empty()) {
      tasks.push_back(
          {std::move(positive), positive_key(task.key), id, Side::kPositive});
    }
  }
  return tree;
}

void insert(BspTree& tree, Fragment polygon, const Plane& plane) {
  /// A part on its way down, at `node` or, if there is none, at that place.
  struct Part {
    Fragment fragment;
    NodeId node;
    NodeId parent;
    Side side;
  };
  std::vector<Part> parts;
  parts.push_back({std::move(polygon), tree.nodes.empty() ? kNoNode : 0,
                   kNoNode, Side::kOn});
  while (!parts.empty()) {
    Part part = std::move(parts.back());
    parts.pop_back();

    // Step 1: where there is no node, the fragment becomes one.
    if (part.node == kNoNode) {
      const PolygonId splitter = part.fragment.source;
      link(tree, part.parent, part.side,
           static_cast<NodeId>(tree.nodes.size()));
      tree.nodes.push_back({splitter, plane, {}});
      tree.nodes.back().coincident.push_back(std::move(part.fragment));
      continue;
    }

    // Step 2: else it stays here, goes to one side, or is split and goes to
    // both.
    Node& node = tree.nodes[static_cast<std::size_t>(part.node)];
    switch (relation(part.fragment, node.plane)) {
      case Relation::kCoincident:
        put(node.coincident, std::move(part.fragment));
        break;
      case Relation::kPositive:
        parts.push_back({std::move(part.fragment), node.positive, part.node,
                         Side::kPositive});
        break;
      case Relation::kNegative:
        parts.push_back({std::move(part.fragment), node.negative, part.node,
                         Side::kNegative});
        break;
      case Relation::kSpanning: {
        SplitResult cut = split(part.fragment, node.plane, node.splitter);
        parts.push_back({std::move(cut.negative), node.negative, part.node,
                         Side::kNegative});
        parts.push_back({std::move(cut.positive), node.positive, part.node,
                         Side::kPositive});
        break;
      }
    }
  }
}

void remove(BspTree& tree, std::span<const PolygonId> polygons) {
  // Step 1: the fragments leave the nodes.
  const std::set<PolygonId> gone(polygons.begin(), polygons.end());
  for (Node& node : tree.nodes) {
    std::erase_if(node.coincident, [&](const Fragment& fragment) {
      return gone.contains(fragment.source);
    });
  }
  // Step 2: which node takes whose place, children before their parents.
  std::vector<NodeId> order;
  std::vector<NodeId> ahead;
  if (!tree.nodes.empty()) ahead.push_back(0);
  while (!ahead.empty()) {
    const NodeId id = ahead.back();
    ahead.pop_back();
    if (id == kNoNode) continue;
    order.push_back(id);
    ahead.push_back(tree.nodes[static_cast<std::size_t>(id)].positive);
    ahead.push_back(tree.nodes[static_cast<std::size_t>(id)].negative);
  }
  std::vector<NodeId> in_place_of(tree.nodes.size(), kNoNode);
  const auto standing = [&](NodeId id) {
    return id == kNoNode ? id : in_place_of[static_cast<std::size_t>(id)];
  };
  for (auto id = order.rbegin(); id != order.rend(); ++id) {
    Node& node = tree.nodes[static_cast<std::size_t>(*id)];
    node.positive = standing(node.positive);
    node.negative = standing(node.negative);
    const bool has_both = node.positive != kNoNode && node.negative != kNoNode;
    in_place_of[static_cast<std::size_t>(*id)] =
        has_both || !node.coincident.empty() ? *id
        : node.positive != kNoNode           ? node.positive
                                             : node.negative;
  }
  // Step 3: the nodes that are left.
  BspTree left;
  std::vector<std::pair<NodeId, std::pair<NodeId, Side>>> tasks;
  if (!tree.nodes.empty()) tasks.push_back({standing(0), {kNoNode, Side::kOn}});
  while (!tasks.empty()) {
    const auto [id, place] = tasks.back();
    tasks.pop_back();
    if (id == kNoNode) continue;
    const auto now = static_cast<NodeId>(left.nodes.size());
    link(left, place.first, place.second, now);
    left.nodes.push_back(std::move(tree.nodes[static_cast<std::size_t>(id)]));
    Node& node = left.nodes.back();
    tasks.push_back({node.negative, {now, Side::kNegative}});
    tasks.push_back({node.positive, {now, Side::kPositive}});
    node.positive = node.negative = kNoNode;
  }
  tree = std::move(left);
}

TreeStats stats(const BspTree& tree) {
  TreeStats result;
  std::set<PolygonId> polygons;
  std::vector<std::pair<NodeId, std::size_t>> ahead;  // nodes and their depths
  if (!tree.nodes.empty()) ahead.push_back({0, 1});
  while (!ahead.empty()) {
    const auto [id, depth] = ahead.back();
    ahead.pop_back();
    if (id == kNoNode) continue;
    const Node& node = tree.nodes[static_cast<std::size_t>(id)];
    ++result.nodes;
    result.height = std::max(result.height, depth);
    result.fragments += node.coincident.size();
    for (const Fragment& fragment : node.coincident) {
      polygons.insert(fragment.source);
    }
    ahead.push_back({node.positive, depth + 1});
    ahead.push_back({node.negative, depth + 1});
  }
  result.splits = result.fragments - polygons.size();
  return result;
}

TreeName name_of(const BspTree& tree) {
  /// A node to be named, and the place of its parent's name.
  struct Task {
    NodeId node;
    NodeId parent;
    Side side;
  };
  TreeName name;
  std::vector<Task> tasks;
  if (!tree.nodes.empty()) tasks.push_back({0, kNoNode, Side::kOn});
  while (!tasks.empty()) {
    const Task task = tasks.back();
    tasks.pop_back();
    if (task.node == kNoNode) continue;
    const Node& node = tree.nodes[static_cast<std::size_t>(task.node)];
    const auto id = static_cast<NodeId>(name.size());
    if (task.parent != kNoNode) {
      NodeName& parent = name[static_cast<std::size_t>(task.parent)];
      (task.side == Side::kPositive ? parent.positive : parent.negative) = id;
    }
    name.push_back({node.splitter, {}});
    for (const Fragment& fragment : node.coincident) {
      name.back().coincident.push_back(name_of(fragment));
    }
    tasks.push_back({node.negative, id, Side::kNegative});
    tasks.push_back({node.positive, id, Side::kPositive});
  }
  return name;
}

}  // namespace halfspace::ref
