#pragma once

#include <cstdint>
#include <vector>

#include "box/bvh.hpp"
#include "halfspace/fast/solid.hpp"

namespace halfspace::fast {

/// A bounding volume hierarchy that faces enter and leave: static trees of
/// growing size, eight of a size merged into one (logarithmic method, BS80).
///
/// Cost: adding faces is n log n, amortised: each enters a new tree log n times
///       to the base of 8. A search visits up to 7 trees of each size.
class DynamicBvh {
 public:
  /// Adds the faces of the solid from number `first` on that are not gone.
  void add(const Solid& solid, std::int32_t first);
  /// Makes room to remove faces before any are added.
  void reserve(std::size_t count) { gone_.resize(count); }
  void remove(std::int32_t face) { gone_[static_cast<std::size_t>(face)] = 1; }
  bool is_gone(std::int32_t face) const {
    return gone_[static_cast<std::size_t>(face)] != 0;
  }

  /// Calls `found(face)` for the faces whose boxes overlap `box`.
  template <class Found>
  void find(const Box& box, Found&& found) const {
    for (const Layer& layer : layers_) {
      layer.tree.find(box, [&](std::int32_t face) {
        if (!is_gone(face)) found(face);
      });
    }
  }

  /// The tree that holds all faces, where they were added at once, and none has
  /// been removed; null if there are none.
  const BoxTree* whole() const {
    return layers_.empty() ? nullptr : &layers_.front().tree;
  }

 private:
  struct Layer {
    std::vector<std::int32_t> faces;
    int level = 0;  ///< how often layers were put together for it
    BoxTree tree;
  };
  static constexpr std::size_t kAlike = 8;

  std::vector<Layer> layers_;  ///< in each level less than kAlike, high to low
  std::vector<std::uint8_t> gone_;  ///< by face
};

}  // namespace halfspace::fast
