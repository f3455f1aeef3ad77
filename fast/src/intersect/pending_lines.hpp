#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "intersect/operand.hpp"

/// Intersections of faces in two steps: threads share the work before points
/// get their ids, and the work after that.
namespace halfspace::fast {

/// A point on the line at which something happens to one of two faces.
struct SweepEvent {
  /// If it is negative, the point has no id yet: it is number `-1 - vertex`
  /// of PendingLines::asked.
  std::int32_t vertex = 0;
  std::array<std::int32_t, 2> edge{-1, -1};  ///< that crosses the line here
  std::array<bool, 2> present{};             ///< in that face
  /// Whether face `o` begins or ends here, beside the line: [o][side].
  std::array<std::array<bool, 2>, 2> toggle{};
  /// Whether it is there from here to the next event.
  std::array<std::array<bool, 2>, 2> after{};
  std::array<bool, 2> along{};  ///< it has an edge from here to the next event
  /// How many of its edges along the line begin here, less those that end.
  std::array<std::int32_t, 2> begun{};

  bool has(std::size_t o) const {
    return present[o] || after[o][0] || after[o][1];
  }
};

/// By face and side of the line, whether the face is there.
using SweepState = std::array<std::array<bool, 2>, 2>;

/// A line on which the events of two faces are known, but for points' ids.
struct PendingLine {
  std::array<std::int32_t, 2> faces{};
  /// If not -1: the faces are in one plane, and this is an edge of operand
  /// `operand`'s face.
  std::int32_t edge = -1;
  std::int8_t operand = 0;
  std::int8_t axis = 0;
  /// The pair asks for new planes, so that all of it is left to be done.
  bool is_left = false;
  SweepState start{};  ///< before the first event
  /// Where what belongs to it ends; it begins where that of the line before
  /// does.
  std::uint32_t event_end = 0;
  std::array<std::uint32_t, 2> along_end{};
  std::uint32_t asked_end = 0;
};

/// Lines in the order in which FaceIntersector::meet() comes upon them.
struct PendingLines {
  std::vector<PendingLine> lines;
  std::vector<SweepEvent> events;
  std::array<std::vector<std::int32_t>, 2> along;  ///< edges on the line
  std::vector<AskedMeet> asked;
  std::vector<std::uint64_t> words;  ///< coordinates of what is asked for
  std::vector<std::int32_t> ids;     ///< of what is asked for, once known

  void clear() {
    lines.clear();
    events.clear();
    for (auto& edges : along) edges.clear();
    asked.clear();
    words.clear();
    ids.clear();
  }
  PendingLine ends() const {
    PendingLine line;
    line.event_end = static_cast<std::uint32_t>(events.size());
    for (std::size_t o = 0; o < 2; ++o)
      line.along_end[o] = static_cast<std::uint32_t>(along[o].size());
    line.asked_end = static_cast<std::uint32_t>(asked.size());
    return line;
  }
  /// Takes back the lines from number `count` on, but not what was asked.
  void shrink(std::size_t count) {
    lines.resize(count);
    const PendingLine last = count == 0 ? PendingLine{} : lines.back();
    events.resize(last.event_end);
    for (std::size_t o = 0; o < 2; ++o) along[o].resize(last.along_end[o]);
  }
};

/// What pairs of faces have in common, in the order in which it is found.
struct ContactRecords {
  std::array<List<EdgeFaceIntersection>, 2> cuts;
  std::array<List<EdgeInFace>, 2> covers;
  std::array<std::vector<std::int32_t>, 2> on_other;
  List<IntersectionSegment> segments;

  void clear() {
    for (std::size_t o = 0; o < 2; ++o) {
      cuts[o].clear();
      covers[o].clear();
      on_other[o].clear();
    }
    segments.clear();
  }
};

}  // namespace halfspace::fast
