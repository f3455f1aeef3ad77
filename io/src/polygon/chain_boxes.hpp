#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "halfspace/int128.hpp"

namespace halfspace::io {

/// A point of a projection.
struct Flat {
  std::int64_t u = 0;
  std::int64_t v = 0;
  friend bool operator==(const Flat&, const Flat&) = default;
};

/// Positive where a, b, c turn left.
inline Int128 turn(const Flat& a, const Flat& b, const Flat& c) {
  return (Int128{b.u} - a.u) * (Int128{c.v} - a.v) -
         (Int128{b.v} - a.v) * (Int128{c.u} - a.u);
}

/// The boxes of the edges of a closed chain, of every two neighbours together,
/// of every four and so on: what is near a triangle is found without looking at
/// each edge.
class ChainBoxes {
 public:
  /// Room for `count` edges, none of which is there yet.
  explicit ChainBoxes(std::size_t count) {
    while (leaves_ < count) leaves_ *= 2;
    boxes_.resize(2 * leaves_);
  }

  /// The edge with this number is that from p to q.
  void set(std::size_t edge, const Flat& p, const Flat& q) {
    put(edge, {std::min(p.u, q.u), std::min(p.v, q.v), std::max(p.u, q.u),
               std::max(p.v, q.v)});
  }
  void remove(std::size_t edge) { put(edge, {}); }

  /// Whether `matches(edge)` for an edge that may have a point within `margin`
  /// of a triangle that turns left. It may make the margin less.
  template <class Matches>
  bool any(const std::array<Flat, 3>& triangle, const std::int64_t& margin,
           const Matches& matches) const {
    std::array<std::size_t, 128> open;  // two for each of up to 64 levels
    std::size_t count = 0;
    open[count++] = 1;
    while (count > 0) {
      const std::size_t at = open[--count];
      if (is_apart(boxes_[at], triangle, margin)) continue;
      if (at >= leaves_) {
        if (matches(at - leaves_)) return true;
        continue;
      }
      open[count++] = 2 * at + 1;
      open[count++] = 2 * at;
    }
    return false;
  }

 private:
  /// As it is, of nothing.
  struct Box {
    std::int64_t low_u = std::numeric_limits<std::int64_t>::max();
    std::int64_t low_v = std::numeric_limits<std::int64_t>::max();
    std::int64_t high_u = std::numeric_limits<std::int64_t>::min();
    std::int64_t high_v = std::numeric_limits<std::int64_t>::min();
    friend bool operator==(const Box&, const Box&) = default;
  };

  void put(std::size_t edge, const Box& box) {
    std::size_t at = leaves_ + edge;
    boxes_[at] = box;
    while (at > 1) {
      at /= 2;
      const Box& a = boxes_[2 * at];
      const Box& b = boxes_[2 * at + 1];
      const Box both{std::min(a.low_u, b.low_u), std::min(a.low_v, b.low_v),
                     std::max(a.high_u, b.high_u),
                     std::max(a.high_v, b.high_v)};
      if (both == boxes_[at]) return;
      boxes_[at] = both;
    }
  }

  /// Whether the box, grown by `margin`, is beyond the triangle's own box, or
  /// beyond one of its sides: then so is the corner that is farthest to the
  /// left of that.
  static bool is_apart(Box box, const std::array<Flat, 3>& triangle,
                       std::int64_t margin) {
    if (box.low_u > box.high_u) return true;
    box = {box.low_u - margin, box.low_v - margin, box.high_u + margin,
           box.high_v + margin};
    const auto [a, b, c] = triangle;
    if (box.high_u < std::min({a.u, b.u, c.u}) ||
        box.low_u > std::max({a.u, b.u, c.u}) ||
        box.high_v < std::min({a.v, b.v, c.v}) ||
        box.low_v > std::max({a.v, b.v, c.v}))
      return true;
    for (std::size_t i = 0; i < 3; ++i) {
      const Flat& from = triangle[i];
      const Flat& to = triangle[(i + 1) % 3];
      const Flat farthest{to.v > from.v ? box.low_u : box.high_u,
                          to.u > from.u ? box.high_v : box.low_v};
      if (turn(from, to, farthest) < 0) return true;
    }
    return false;
  }

  std::size_t leaves_ = 1;
  std::vector<Box> boxes_;  ///< the root is 1, the halves of `i` 2i and 2i + 1
};

}  // namespace halfspace::io
