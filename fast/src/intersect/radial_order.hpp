#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "table/shared_table.hpp"

/// What is round a segment of a surface's edges.
namespace halfspace::fast {

/// A face at a segment: on the left of it (turn 1), as seen against its
/// plane's normal, or on the right (-1).
struct Wing {
  std::int32_t operand;
  std::int32_t face;
  std::int32_t plane;
  int turn;
  bool flipped;
};

/// A segment, from low to high along the axis, in two planes.
struct Segment {
  std::int32_t low;
  std::int32_t high;
  std::int32_t axis;
  std::array<std::int32_t, 2> planes;
};

/// Of two planes through a line, one that is not `plane`.
inline std::int32_t other_than(std::int32_t plane,
                               const std::array<std::int32_t, 2>& planes) {
  return planes[0] != plane ? planes[0] : planes[1];
}

/// Where the wing stands, from the first one on counter-clockwise as the axis
/// has it: 0, as the first one; 1, within half a turn; 2, opposite; 3, beyond.
int part_of_turn(const Wing& first, const Wing& wing, int axis,
                 const GeometryTable& table);

/// Sorts the wings by their angle round the axis, from the first one on.
void sort_wings(std::vector<Wing>& wings, int axis, const GeometryTable& table);

/// Whether wing `i` stands where the one before it does.
inline bool as_last(const std::vector<Wing>& wings, std::size_t i) {
  return i > 0 && wings[i].plane == wings[i - 1].plane &&
         wings[i].turn == wings[i - 1].turn;
}

/// Whether its operand ends there, round the segment, or begins.
inline bool leaves(const Wing& w) { return (w.turn > 0) != w.flipped; }

/// What a wing adds to how often its surface winds round what is there.
inline int change(const Wing& w) { return leaves(w) ? -1 : 1; }

}  // namespace halfspace::fast
