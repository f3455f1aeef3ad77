#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "boxes.hpp"

namespace halfspace::fast {

inline bool overlap(const Box& a, const Box& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (a.low[k] > b.high[k] || b.low[k] > a.high[k]) return false;
  }
  return true;
}

/// A tree of boxes, to find those that overlap another one.
class BoxTree {
 public:
  /// `items` are the numbers of the boxes that take part.
  template <class BoxOf>
  BoxTree(BoxOf&& box_of, const std::vector<std::int32_t>& items) {
    items_.reserve(items.size());
    for (const std::int32_t item : items)
      items_.push_back({box_of(item), item});
    build();
  }

  /// Calls `found(item)` for the items whose boxes overlap `box`.
  template <class Found>
  void find(const Box& box, Found&& found) const {
    if (nodes_.empty()) return;
    // Halves of halves: no deeper than items have bits in their number, and
    // at each depth no more than one waits.
    std::array<std::int32_t, 40> stack;
    std::size_t waiting = 0;
    stack[waiting++] = 0;
    while (waiting > 0) {
      const Node& node = nodes_[static_cast<std::size_t>(stack[--waiting])];
      if (!overlap(node.box, box)) continue;
      if (node.second >= 0) {
        stack[waiting++] = node.second;
        stack[waiting++] = node.first;
        continue;
      }
      for (std::int32_t i = 0; i < node.count; ++i) {
        const auto at = static_cast<std::size_t>(node.first + i);
        if (overlap(items_[at].box, box)) found(items_[at].number);
      }
    }
  }

 private:
  /// Of a leaf the items from `first` on; else the two children.
  struct Node {
    Box box;
    std::int32_t first = 0;
    std::int32_t second = -1;
    std::int32_t count = 0;
  };

  struct Item {
    Box box;
    std::int32_t number = 0;
  };

  void sort_items();
  void build();

  std::vector<Item> items_;
  std::vector<Node> nodes_;
};

}  // namespace halfspace::fast
