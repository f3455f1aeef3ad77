#pragma once

#include <algorithm>
#include <vector>

#include "ray/ray_line.hpp"
#include "tree/tree_access.hpp"

namespace halfspace::fast {

/// Walks the tree along a ray (S8.3): near subtree, node, far subtree, a ray
/// that may run along a splitter taking both.
///
/// Calls visit(fragment) for all that can be hit, some of them without need,
/// and leaves out what begins beyond `limit()`.
template <class Limit, class Visit>
void walk_ray(const TreeReader& reader, const RayLine& line, Limit&& limit,
              Visit&& visit) {
  struct Step {
    NodeId node;
    ParameterRange range;
  };
  const BspTree& tree = reader.tree();
  const bool has_boxes = tree.boxes.size() == tree.nodes.size();
  std::vector<Step> steps;
  const auto push = [&](NodeId id, ParameterRange range) {
    if (id == kNoNode) return;
    if (has_boxes)
      range = line.clipped(range, tree.boxes[static_cast<std::size_t>(id)]);
    if (range.first <= range.last) steps.push_back({id, range});
  };
  if (!tree.nodes.empty()) push(0, line.range());
  while (!steps.empty()) {
    const Step step = steps.back();
    steps.pop_back();
    if (step.range.first > limit()) continue;
    const Node& node = node_at(tree, step.node);
    const auto visit_own = [&] {
      for_fragments(tree, node, [&](const TreeFragment& fragment) {
        visit(fragment);
        return true;
      });
    };
    if (node.splitter == kNoPlane) {
      visit_own();
      continue;
    }
    const FilterPlane plane = filter_plane(node.plane);
    const int begin = filtered_sign(line.value_at(plane, step.range.first));
    const int end = filtered_sign(line.value_at(plane, step.range.last));
    if (begin != 0 && begin == end) {
      push(begin > 0 ? node.positive : node.negative, step.range);
      continue;
    }
    visit_own();
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

}  // namespace halfspace::fast
