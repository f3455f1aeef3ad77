#pragma once

#include <algorithm>
#include <vector>

#include "ray/ray_line.hpp"
#include "sah/lazy_cells.hpp"
#include "tree/tree_access.hpp"

namespace halfspace::fast {

/// Walks a tree along a part of a ray (S8.3): near subtree, node, far subtree,
/// a ray that may run along a splitter taking both.
///
/// Calls visit(node, part of the ray) for all nodes and leaves in which
/// something can be hit, for some of them without need, and leaves out what
/// begins beyond `limit()`.
template <class Limit, class Visit>
void walk_nodes(const BspTree& tree, const RayLine& line, ParameterRange range,
                Limit&& limit, Visit&& visit) {
  struct Step {
    NodeId node;
    ParameterRange range;
  };
  const bool has_boxes = tree.boxes.size() == tree.nodes.size();
  std::vector<Step> steps;
  const auto push = [&](NodeId id, ParameterRange part) {
    if (id == kNoNode) return;
    if (has_boxes)
      part = line.clipped(part, tree.boxes[static_cast<std::size_t>(id)]);
    if (part.first <= part.last) steps.push_back({id, part});
  };
  if (!tree.nodes.empty()) push(0, range);
  while (!steps.empty()) {
    const Step step = steps.back();
    steps.pop_back();
    if (step.range.first > limit()) continue;
    const Node& node = node_at(tree, step.node);
    if (node.splitter == kNoPlane) {
      visit(node, step.range);
      continue;
    }
    const FilterPlane plane = filter_plane(node.plane);
    const int begin = filtered_sign(line.value_at(plane, step.range.first));
    const int end = filtered_sign(line.value_at(plane, step.range.last));
    if (begin != 0 && begin == end) {
      push(begin > 0 ? node.positive : node.negative, step.range);
      continue;
    }
    visit(node, step.range);
    const auto at = line.meet(plane);
    const int direction = line.direction_sign(plane);
    const bool from_negative = direction != 0 ? direction > 0 : begin < 0;
    ParameterRange near = step.range;
    ParameterRange far = step.range;
    if (at && direction != 0) {
      near.last = std::min(near.last, at->last);
      far.first = std::max(far.first, at->first);
    }
    push(from_negative ? node.positive : node.negative, far);
    push(from_negative ? node.negative : node.positive, near);
  }
}

/// A tree that was built at once, as rays go through it.
class BuiltTree {
 public:
  BuiltTree(const Scene& scene, const BspTree& tree) : reader_(scene, tree) {}

  /// Knows the planes of the scene's polygons.
  const TreeReader& reader() const { return reader_; }

  /// Calls visit(reader, fragment) for all that the ray can hit, some of it
  /// without need, near ones first, and leaves out what begins beyond
  /// `limit()`.
  template <class Limit, class Visit>
  void walk(const RayLine& line, Limit&& limit, Visit&& visit) const {
    walk_nodes(reader_.tree(), line, line.range(), limit,
               [&](const Node& node, const ParameterRange&) {
                 visit_fragments(reader_, node, visit);
               });
  }

  template <class Visit>
  static void visit_fragments(const TreeReader& reader, const Node& node,
                              Visit&& visit) {
    for_fragments(reader.tree(), node, [&](const TreeFragment& fragment) {
      visit(reader, fragment);
      return true;
    });
  }

 private:
  TreeReader reader_;
};

/// A lazy tree, the same way: the cells that a ray comes to are built (S3.12).
class OpenedTree {
 public:
  explicit OpenedTree(const LazyTree& tree)
      : state_(tree.state()), reader_(tree.scene(), state_.root.tree) {}

  const TreeReader& reader() const { return reader_; }

  template <class Limit, class Visit>
  void walk(const RayLine& line, Limit&& limit, Visit&& visit) const {
    walk(state_.root, line, line.range(), limit, visit);
  }

 private:
  /// Recurses into cells that were divided again, of which there are at most
  /// some in each other.
  template <class Limit, class Visit>
  void walk(const LazyPart& part, const RayLine& line, ParameterRange range,
            Limit& limit, Visit& visit) const {
    const TreeReader reader(reader_.scene(), part.tree);
    walk_nodes(part.tree, line, range, limit,
               [&](const Node& node, const ParameterRange& here) {
                 if (!part.has_cells()) {
                   BuiltTree::visit_fragments(reader, node, visit);
                 } else if (node.splitter == kNoPlane) {
                   const auto leaf =
                       static_cast<NodeId>(&node - part.tree.nodes.data());
                   walk(state_.part_at(part, leaf), line, here, limit, visit);
                 }
               });
  }

  const LazyTree::State& state_;
  TreeReader reader_;
};

}  // namespace halfspace::fast
