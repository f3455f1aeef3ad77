#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "halfspace/fast/image/screens.hpp"
#include "halfspace/span.hpp"

namespace halfspace::fast {

/// F2B's lists of unlit segments (S4.8), one a line, as vectors.
class ListLines {
 public:
  ListLines(std::int32_t width, std::int32_t height)
      : lines_(static_cast<std::size_t>(height), {Span{0, width - 1}}),
        open_(height) {}

  /// Calls paint(span) for what is unlit of the object segment, which is lit
  /// then: the cases of S4.7 for one object segment.
  template <class Paint>
  void light(std::int32_t line, Span object, Paint&& paint) {
    std::vector<Span>& unlit = lines_[static_cast<std::size_t>(line)];
    // Case 8 of all before.
    auto at = std::lower_bound(
        unlit.begin(), unlit.end(), object.first,
        [](const Span& s, std::int32_t first) { return s.last < first; });
    const auto from = at;
    Span left{0, -1};
    Span right{0, -1};
    for (; at != unlit.end() && at->first <= object.last; ++at) {
      ++steps_;
      paint(Span{std::max(at->first, object.first),
                 std::min(at->last, object.last)});
      if (at->first < object.first) left = {at->first, object.first - 1};
      if (at->last > object.last) right = {object.last + 1, at->last};
    }
    if (from == at) return;
    const auto place = unlit.erase(from, at) - unlit.begin();
    if (right.first <= right.last) unlit.insert(unlit.begin() + place, right);
    if (left.first <= left.last) unlit.insert(unlit.begin() + place, left);
    if (unlit.empty()) --open_;
  }
  bool full() const { return open_ == 0; }
  bool full(std::int32_t line) const {
    return lines_[static_cast<std::size_t>(line)].empty();
  }
  ScreenWork work() const {
    ScreenWork all{0, steps_};
    for (const auto& line : lines_) all.parts += line.size();
    return all;
  }

 private:
  std::vector<std::vector<Span>> lines_;
  std::int32_t open_;
  std::size_t steps_ = 0;
};

/// The unlit pixels of each line as a 1-D BSP tree (FAQ): a node divides its
/// pixels where an object segment ended; leaves are lit or unlit.
class TreeLines {
 public:
  TreeLines(std::int32_t width, std::int32_t height)
      : nodes_(static_cast<std::size_t>(height)),
        width_(width),
        open_(height) {}

  template <class Paint>
  void light(std::int32_t line, Span object, Paint&& paint) {
    const std::int32_t end = object.last + 1;
    tasks_.assign(1, {line, 0, width_, true});
    while (!tasks_.empty()) {
      const Task task = tasks_.back();
      tasks_.pop_back();
      if (!task.enter) {
        // The children are done.
        Node& node = at(task.node);
        node.full = at(node.lower).full && at(node.lower + 1).full;
        if (node.full && task.node < height()) --open_;
        continue;
      }
      if (at(task.node).full || end <= task.low || task.high <= object.first)
        continue;
      ++steps_;
      if (at(task.node).lower < 0) {
        if (object.first <= task.low && task.high <= end) {
          at(task.node).full = true;
          if (task.node < height()) --open_;
          paint(Span{task.low, task.high - 1});
          continue;
        }
        const auto lower = static_cast<std::int32_t>(nodes_.size());
        nodes_.resize(nodes_.size() + 2);
        at(task.node).lower = lower;
        at(task.node).split = task.low < object.first ? object.first : end;
      }
      const Node& node = at(task.node);
      tasks_.push_back({task.node, 0, 0, false});
      tasks_.push_back({node.lower + 1, node.split, task.high, true});
      tasks_.push_back({node.lower, task.low, node.split, true});
    }
  }
  bool full() const { return open_ == 0; }
  bool full(std::int32_t line) const {
    return nodes_[static_cast<std::size_t>(line)].full;
  }
  ScreenWork work() const { return {nodes_.size(), steps_}; }

 private:
  /// The first nodes are the roots of the lines; children are neighbours.
  struct Node {
    std::int32_t lower = -1;
    std::int32_t split = 0;
    bool full = false;
  };
  struct Task {
    std::int32_t node;
    std::int32_t low;
    std::int32_t high;
    bool enter;
  };
  Node& at(std::int32_t node) { return nodes_[static_cast<std::size_t>(node)]; }
  std::int32_t height() const { return height_; }

  std::vector<Node> nodes_;
  std::int32_t width_;
  std::int32_t height_ = static_cast<std::int32_t>(nodes_.size());
  std::int32_t open_;
  std::vector<Task> tasks_;
  std::size_t steps_ = 0;
};

}  // namespace halfspace::fast
