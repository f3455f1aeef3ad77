#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "intersect/candidates.hpp"

namespace halfspace::fast {

/// How an edge from one side of a line to another changes whether the face is
/// there right beside the line, on either side of it.
inline void toggle(std::array<bool, 2>& on, int from, int to) {
  on[0] = on[0] != ((from > 0) != (to > 0));
  on[1] = on[1] != ((from < 0) != (to < 0));
}

/// Intersects a face of one operand with a face of the other: cuts and covers
/// of the edges of both, and intersection segments.
///
/// A face meets a line in intervals. Seen from right beside the line, on either
/// side, the face begins and ends where an edge crosses that side. So a vertex
/// on the line, or an edge along it, needs no case of its own: it counts on the
/// side that it reaches. Events before the other face begins or after it ends
/// need no exact point.
class FaceIntersector {
 public:
  FaceIntersector(Operand& a, Operand& b, GeometryTable& table,
                  std::vector<IntersectionSegment>& segments)
      : operands_{&a, &b}, table_(table), segments_(segments) {}

  /// Whatever the two faces have in common is added to the operands' lists and
  /// to the segments. Exact: yes.
  void meet(std::int32_t face_a, std::int32_t face_b);

  /// Whether meet() may find anything: false for most faces that are near each
  /// other. Changes nothing but this object, so other threads may call it on
  /// theirs.
  bool may_meet(std::int32_t face_a, std::int32_t face_b);

 private:
  /// A point on the line at which something happens to one of the faces.
  struct SweepEvent {
    std::int32_t vertex = 0;
    std::array<std::int32_t, 2> edge{-1, -1};  ///< that crosses the line here
    std::array<bool, 2> present{};             ///< in that face
    /// Whether face `o` begins or ends here, beside the line: [o][side].
    std::array<std::array<bool, 2>, 2> toggle{};
    /// Whether it is there from here to the next event.
    std::array<std::array<bool, 2>, 2> after{};
    std::array<bool, 2>
        along{};  ///< it has an edge from here to the next event
    /// How many of its edges along the line begin here, less those that end.
    std::array<std::int32_t, 2> begun{};

    bool has(std::size_t o) const {
      return present[o] || after[o][0] || after[o][1];
    }
  };

  /// An edge of a face that meets the plane that makes the line: the sides of
  /// its first end and its last, and from where to where it is on the line,
  /// in doubles.
  struct EdgeCrossing {
    std::uint32_t edge = 0;
    std::int8_t from = 0;
    std::int8_t to = 0;
    double low = 0;
    double high = 0;
  };
  /// By face and side of the line.
  using State = std::array<std::array<bool, 2>, 2>;

  const Face& face(std::size_t o) const {
    return operands_[o]->face(faces_[o]);
  }
  const PacketList* blocks_of(std::size_t o) const {
    return operands_[o]->blocks->of(faces_[o]);
  }
  bool find_crossings(std::size_t o, std::int32_t plane, const Box& near);
  bool find_near_crossings(std::size_t o, std::int32_t plane,
                           const PacketList& list, const Box& near);
  void find_crossings(std::size_t o, std::int32_t plane, std::uint32_t first,
                      std::uint32_t last);
  void measure(std::size_t o, std::int32_t plane);
  void add_events(std::size_t o, std::int32_t across);
  std::int32_t cut_of(std::size_t o, OperandEdge& edge, std::int32_t across);
  void add_event(std::size_t o, const EdgeCrossing& crossing,
                 std::int32_t across);
  void begin_line();
  void order_events();
  std::pair<std::size_t, std::size_t> events_at(const OperandEdge& edge) const;
  void meet_across();
  void meet_in_plane(std::size_t o);
  void meet_edge(std::size_t o, std::int32_t edge);
  void report_cuts();
  void report_along(std::size_t o, std::int32_t edge, bool positive_is_left);
  void cut(std::size_t o, std::int32_t edge, std::int32_t vertex);
  void put_on_other(std::size_t o, std::int32_t vertex);

  std::array<Operand*, 2> operands_;
  GeometryTable& table_;
  std::vector<IntersectionSegment>& segments_;
  std::array<std::int32_t, 2> faces_{};
  int axis_ = 0;  ///< along the current line
  std::array<std::vector<EdgeCrossing>, 2> crossings_;
  bool positive_ = false, negative_ = false;  ///< sides that a face reaches
  /// By face and side, whether it is there before all crossings.
  State before_{};
  /// From where to where either face is on the line, in doubles.
  std::array<double, 2> low_{}, high_{};
  State start_{};                                   ///< before the first event
  std::array<std::vector<std::int32_t>, 2> along_;  ///< edges on the line
  std::array<EpochArray<std::uint8_t>, 2> is_along_;  ///< by edge
  std::vector<SweepEvent> events_;
};

}  // namespace halfspace::fast
