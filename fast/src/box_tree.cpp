#include "box_tree.hpp"

#include <algorithm>

namespace halfspace::fast {
namespace {

constexpr std::int32_t kLeafSize = 4;

/// A part of the items that is to become the subtree of `node`.
struct Task {
  std::int32_t begin;
  std::int32_t end;
  std::int32_t node;
};

}  // namespace

void BoxTree::build() {
  std::vector<Task> tasks;
  if (!items_.empty()) {
    nodes_.emplace_back();
    tasks.push_back({0, static_cast<std::int32_t>(items_.size()), 0});
  }
  while (!tasks.empty()) {
    const Task task = tasks.back();
    tasks.pop_back();
    Box box = kEmptyBox;
    std::array<float, 3> low = kEmptyBox.low;
    std::array<float, 3> high = kEmptyBox.high;
    for (std::int32_t i = task.begin; i < task.end; ++i) {
      const Box& of = items_[static_cast<std::size_t>(i)].box;
      extend(box, of);
      for (std::size_t k = 0; k < 3; ++k) {
        const float middle = of.low[k] + of.high[k];
        low[k] = std::min(low[k], middle);
        high[k] = std::max(high[k], middle);
      }
    }
    Node& node = nodes_[static_cast<std::size_t>(task.node)];
    node.box = box;
    node.first = task.begin;
    node.count = task.end - task.begin;
    if (node.count <= kLeafSize) continue;
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k) {
      if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
    }
    const std::int32_t half = task.begin + node.count / 2;
    const auto less = [axis](const Item& a, const Item& b) {
      const float u = a.box.low[axis] + a.box.high[axis];
      const float v = b.box.low[axis] + b.box.high[axis];
      return u != v ? u < v : a.number < b.number;
    };
    std::nth_element(items_.begin() + task.begin, items_.begin() + half,
                     items_.begin() + task.end, less);
    const auto child = static_cast<std::int32_t>(nodes_.size());
    node.first = child;
    node.second = child + 1;
    tasks.push_back({half, task.end, child + 1});
    tasks.push_back({task.begin, half, child});
    nodes_.resize(nodes_.size() + 2);
  }
}

}  // namespace halfspace::fast
