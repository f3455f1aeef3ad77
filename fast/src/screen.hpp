#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "halfspace/fast/render.hpp"
#include "kernel.hpp"

namespace halfspace::fast {

/// The tiles of one thread's lines, and the canvas over them.
class Screen {
 public:
  /// All pixels of `rectangle` within `lines` unlit, all others lit.
  /// The images that `result` has are of the rectangle's size.
  Screen(const Rectangle& rectangle, PixelRange lines, Rendering& result,
         bool with_leaves);
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  Canvas& canvas() { return canvas_; }

  /// From here to leave_leaf() fragments may hide each other in any order.
  void enter_leaf();
  void leave_leaf();

 private:
  Canvas canvas_;
  std::vector<std::uint32_t> lit_;
  std::vector<std::uint64_t> open_;
  std::vector<std::uint32_t> leaf_of_;
  std::vector<std::uint32_t> before_;
  std::vector<std::int32_t> full_;
  std::vector<std::uint32_t> slot_of_;
  std::unique_ptr<std::int32_t[]> slots_;
};

}  // namespace halfspace::fast
