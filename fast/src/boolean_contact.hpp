#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "boolean_parts.hpp"

namespace halfspace::fast {

/// Finds what a face of one operand has in common with a face of the other:
/// cuts and covers of the edges of both, and traces.
///
/// A line is met by a face in intervals. Seen from right beside the line, on
/// either side, the face begins and ends where an edge crosses that side; so a
/// vertex on the line or an edge along it needs no case of its own: it counts
/// on the side that it reaches.
class Contact {
 public:
  Contact(Operand& a, Operand& b, Space& space, std::vector<Trace>& traces)
      : operands_{&a, &b}, space_(space), traces_(traces) {}

  /// Whatever the two faces have in common is added to the operands' lists and
  /// to the traces. Exact: yes.
  void meet(std::int32_t face_a, std::int32_t face_b);

 private:
  /// A point on the line at which something happens to one of the faces.
  struct Mark {
    std::int32_t vertex = 0;
    std::array<std::int32_t, 2> edge{-1, -1};  ///< that crosses the line here
    std::array<bool, 2> present{};             ///< in that face
    /// Whether face `o` begins or ends here, beside the line: [o][side].
    std::array<std::array<bool, 2>, 2> toggle{};
    /// Whether it is there from here to the next mark.
    std::array<std::array<bool, 2>, 2> after{};
    std::array<bool, 2> along{};  ///< it has an edge from here to the next mark

    bool has(std::size_t o) const {
      return present[o] || after[o][0] || after[o][1];
    }
  };

  const Face& face(std::size_t o) const {
    return operands_[o]->face(faces_[o]);
  }
  bool find_sides(std::size_t o, std::int32_t plane);
  bool may_overlap(int axis) const;
  void add_marks(std::size_t o, std::int32_t across);
  void order_marks(int axis);
  std::array<std::array<bool, 2>, 2> far_away() const;
  void meet_across();
  void meet_in_plane(std::size_t o);
  void report_cuts();
  void report_along(std::size_t o, std::int32_t edge, bool positive_is_left);
  void cut(std::size_t o, std::int32_t edge, std::int32_t vertex, bool through);
  void put_on_other(std::size_t o, std::int32_t vertex);

  std::array<Operand*, 2> operands_;
  Space& space_;
  std::vector<Trace>& traces_;
  std::array<std::int32_t, 2> faces_{};
  /// The sides of the faces' edges' first ends against the plane that makes
  /// the line, and of their last ends.
  std::array<std::vector<std::array<std::int8_t, 2>>, 2> sides_;
  std::array<std::vector<std::int32_t>, 2> along_;  ///< edges on the line
  std::vector<Mark> marks_;
};

}  // namespace halfspace::fast
