#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "table/shared_table.hpp"

/// Half-faces round a segment, in radial order (WEI88).
namespace halfspace::fast {

/// A half-face: a face at a segment, on its left (turn 1) as seen against the
/// normal of the face's plane, or on its right (-1).
struct HalfFace {
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

/// The one of two planes through a line that is not `plane`; the first if
/// neither is.
inline std::int32_t other_than(std::int32_t plane,
                               const std::array<std::int32_t, 2>& planes) {
  return planes[0] != plane ? planes[0] : planes[1];
}

/// Where a half-face stands, counter-clockwise from the first one as seen
/// against the axis: 0, as the first one; 1, within half a turn; 2, opposite;
/// 3, beyond.
int part_of_turn(const HalfFace& first, const HalfFace& half_face, int axis,
                 const GeometryTable& table);

/// Sorts the half-faces by their angle round the axis, from the first one on.
void radial_sort(std::vector<HalfFace>& half_faces, int axis,
                 const GeometryTable& table);

/// Whether half_face `i` stands where the one before it does.
inline bool as_last(const std::vector<HalfFace>& half_faces, std::size_t i) {
  return i > 0 && half_faces[i].plane == half_faces[i - 1].plane &&
         half_faces[i].turn == half_faces[i - 1].turn;
}

/// Whether its operand ends at the half-face, going round the segment.
inline bool exits(const HalfFace& w) { return (w.turn > 0) != w.flipped; }

/// By how much the winding number changes at a half-face.
inline int change(const HalfFace& w) { return exits(w) ? -1 : 1; }

}  // namespace halfspace::fast
