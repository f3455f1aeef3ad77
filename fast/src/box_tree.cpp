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

BoxTree::BoxTree(const std::vector<Box>& boxes, std::vector<std::int32_t> items)
    : items_(std::move(items)) {
  const auto box_of = [&](std::int32_t item) -> const Box& {
    return boxes[static_cast<std::size_t>(item)];
  };
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
      const Box& of = box_of(items_[static_cast<std::size_t>(i)]);
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
    const auto less = [&](std::int32_t a, std::int32_t b) {
      const float u = box_of(a).low[axis] + box_of(a).high[axis];
      const float v = box_of(b).low[axis] + box_of(b).high[axis];
      return u != v ? u < v : a < b;
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
  boxes_.reserve(items_.size());
  for (const std::int32_t item : items_) boxes_.push_back(box_of(item));
}

}  // namespace halfspace::fast
