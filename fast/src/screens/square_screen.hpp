#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "camera/edge_function.hpp"
#include "halfspace/fast/image/screens.hpp"

namespace halfspace::fast {

/// A quadtree over the image: squares of pixels that are lit, unlit or divided
/// into four.
class SquareScreen {
 public:
  SquareScreen(std::int32_t width, std::int32_t height)
      : width_(width), height_(height), nodes_(1) {
    while (size_ < width || size_ < height) size_ *= 2;
  }

  /// Lights the pixels whose samples all functions are positive at, of lines
  /// from `rows.first` up to `rows.end`. Calls paint(line, span) for what was
  /// unlit of them.
  ///
  /// An affine function that is not negative at the samples of a square's four
  /// corners is negative at none within it; one that is nowhere positive there
  /// is positive at none.
  template <class Line, class Paint>
  void light(std::span<const Line> lines, PixelRange rows, Paint&& paint) {
    tasks_.assign(1, {0, 0, 0, size_, true});
    while (!tasks_.empty()) {
      const Task task = tasks_.back();
      tasks_.pop_back();
      Node& node = at(task.node);
      if (!task.enter) {
        node.full = true;
        for (std::int32_t k = 0; k < 4; ++k)
          node.full = node.full && at(node.parts + k).full;
        continue;
      }
      if (node.full) continue;
      if (task.x >= width_ || task.y >= height_) {
        node.full = true;  // off the image
        continue;
      }
      if (task.y >= rows.end || task.y + task.size <= rows.first) continue;
      ++steps_;
      const Found found = compare(lines, task);
      if (found == Found::kNothing) continue;
      if (node.parts < 0 && found == Found::kAll) {
        node.full = true;
        const std::int32_t last = std::min(task.x + task.size, width_) - 1;
        for (std::int32_t j = task.y; j < std::min(task.y + task.size, height_);
             ++j)
          paint(j, Span{task.x, last});
        continue;
      }
      if (node.parts < 0) {
        const auto parts = static_cast<std::int32_t>(nodes_.size());
        nodes_.resize(nodes_.size() + 4);
        at(task.node).parts = parts;
      }
      const std::int32_t parts = at(task.node).parts;
      const std::int32_t half = task.size / 2;
      tasks_.push_back({task.node, 0, 0, 0, false});
      for (std::int32_t k = 3; k >= 0; --k) {
        tasks_.push_back({parts + k, task.x + (k % 2) * half,
                          task.y + (k / 2) * half, half, true});
      }
    }
  }
  bool full() const { return nodes_[0].full; }
  ScreenWork work() const { return {nodes_.size(), steps_}; }

 private:
  struct Node {
    std::int32_t parts = -1;  ///< the first of four neighbours
    bool full = false;
  };
  struct Task {
    std::int32_t node;
    std::int32_t x;
    std::int32_t y;
    std::int32_t size;
    bool enter;
  };
  enum class Found { kNothing, kSome, kAll };

  template <class Line>
  static Found compare(std::span<const Line> lines, const Task& task) {
    const std::int32_t right = task.x + task.size - 1;
    const std::int32_t bottom = task.y + task.size - 1;
    bool all = true;
    for (const Line& line : lines) {
      // The slopes say at which corners the function is greatest and least.
      const bool grows_right = !line.a.is_negative();
      const bool grows_down = !line.b.is_negative();
      if (line.sign_at_sample(grows_right ? right : task.x,
                              grows_down ? bottom : task.y) <= 0)
        return Found::kNothing;
      all = all && line.sign_at_sample(grows_right ? task.x : right,
                                       grows_down ? task.y : bottom) > 0;
    }
    return all ? Found::kAll : Found::kSome;
  }
  Node& at(std::int32_t node) { return nodes_[static_cast<std::size_t>(node)]; }

  std::int32_t width_;
  std::int32_t height_;
  std::int32_t size_ = 1;
  std::vector<Node> nodes_;
  std::vector<Task> tasks_;
  std::size_t steps_ = 0;
};

}  // namespace halfspace::fast
