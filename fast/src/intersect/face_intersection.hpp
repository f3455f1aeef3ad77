#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/threads.hpp"
#include "intersect/candidates.hpp"
#include "intersect/pending_lines.hpp"

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
                  List<IntersectionSegment>& segments)
      : operands_{&a, &b}, table_(table), segments_(segments) {}

  /// Whatever the two faces have in common is added to the operands' lists and
  /// to the segments. Exact: yes.
  void meet(std::int32_t face_a, std::int32_t face_b);

  /// Whether meet() may find anything: false for most faces that are near each
  /// other. Changes nothing but this object, so other threads may call it on
  /// theirs.
  bool may_meet(std::int32_t face_a, std::int32_t face_b);

  /// meet() in two steps, with equal results. Both may run in several threads
  /// on an object each, while nothing extends the table; PairMeeter calls them.
  ///
  /// Step 1: begin_block() for each `pending`, then begin_meet() for pairs.
  void begin_block(PendingLines& pending);
  void begin_meet(std::int32_t face_a, std::int32_t face_b);
  /// Step 2, when ids are known: line number `i`, which is not left to meet().
  void end_meet(const PendingLines& pending, std::size_t i,
                ContactRecords& records);
  /// From here on what is found is added to these instead; nullptr: no longer.
  void record_in(ContactRecords* records) { records_ = records; }

 private:
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
  using State = SweepState;
  /// What was asked for where an edge meets a plane, and whether it still
  /// holds.
  struct AskedCut {
    std::size_t o = 0;
    std::int32_t edge = -1;
    std::int32_t across = -1;
    std::int32_t vertex = 0;
  };

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
  std::int32_t cut_of(OperandEdge& edge, std::int32_t across);
  void add_event(std::size_t o, const EdgeCrossing& crossing,
                 std::int32_t across);
  std::int32_t asked_cut(std::size_t o, std::int32_t edge, std::int32_t across);
  std::int32_t ask(std::int32_t p, std::int32_t q, std::int32_t r,
                   bool computes);
  void leave() { is_left_ = true; }
  bool is_pending() const { return kManyThreads && pending_ != nullptr; }
  bool has_records() const { return kManyThreads && records_ != nullptr; }
  void begin_line();
  void end_line(std::size_t o, std::int32_t edge);
  void report_across();
  void report_in_plane(std::size_t o, std::int32_t edge);
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
  List<IntersectionSegment>& segments_;
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
  ContactRecords* records_ = nullptr;
  PendingLines* pending_ = nullptr;  ///< in step 1
  bool is_left_ = false;             ///< the pair is left to meet()
  /// The last answers in this block, by a hash: few, to stay in the cache.
  std::vector<AskedCut> asked_cuts_;
};

}  // namespace halfspace::fast
