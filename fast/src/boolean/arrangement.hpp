#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "intersect/candidates.hpp"
#include "table/shared_table.hpp"

namespace halfspace::fast {

/// Two operands and what their surfaces have in common: the input of the three
/// steps of a boolean, Classifier, Emitter and Assembler.
///
/// Order of calls: find_contacts(), then, if both operands conform, index().
class Arrangement {
 public:
  /// The solid of which operand 0 holds only the faces near operand 1: all its
  /// faces, their BVH if there is one, their box, and the edge packets of the
  /// whole and of the part.
  struct Whole {
    const Solid* solid = nullptr;
    const DynamicBvh* index = nullptr;
    Box extent = kEmptyBox;
    std::shared_ptr<const EdgePackets> blocks;
    std::shared_ptr<const EdgePackets> part_blocks;
  };

  /// Requires: both solids are in the lease's table.
  Arrangement(BooleanOp operation, const Solid& a, const Solid& b,
              TableLease& lease, int threads = 1);
  Arrangement(BooleanOp operation, const Solid& a, const Solid& b,
              TableLease& lease, const Whole& whole);
  Arrangement(const Arrangement&) = delete;
  Arrangement& operator=(const Arrangement&) = delete;

  /// Intersects the operands' faces, two by two.
  void find_contacts();
  /// Whether operand `o` is a conforming mesh wherever it meets the other one
  /// (conform_contacts()). Requires: find_contacts().
  bool conforms(std::size_t o) const { return conforms_[o]; }
  /// Known to conform everywhere, before any work.
  bool is_conforming(std::size_t o) const { return is_conforming_[o]; }
  /// Sorts cuts and covers by edge and marks the faces that they touch.
  void index();

  /// The cuts of an edge of operand `o`; those at one vertex; its covers.
  /// Requires: index().
  std::span<const EdgeFaceIntersection> cuts_of(std::size_t o,
                                                std::int32_t edge) const;
  std::span<const EdgeFaceIntersection> cuts_at(std::size_t o,
                                                std::int32_t edge,
                                                std::int32_t vertex) const;
  std::span<const EdgeInFace> covers_of(std::size_t o, std::int32_t edge) const;
  /// How many threads may work on it.
  int threads() const { return threads_; }
  /// Whether operand `o`'s face meets the other operand.
  bool is_touched(std::size_t o, std::int32_t face) const {
    return operands[o].touched[static_cast<std::size_t>(face)] != 0;
  }
  /// Whether a vertex is surely outside the other operand's box.
  bool is_beyond_other(std::size_t o, std::int32_t vertex) const {
    return is_beyond(operands[o].reach, table.vertex(vertex).approximate);
  }
  /// Membership in the result, by that in operand `o` and in the other one.
  bool is_in_result(std::size_t o, bool own, bool other) const {
    return o == 0 ? is_member(operation, own, other)
                  : is_member(operation, other, own);
  }

  const BooleanOp operation;
  GeometryTable& table;
  BooleanScratch& scratch;
  std::array<Operand, 2> operands;
  List<IntersectionSegment> segments;

 private:
  void sort_records(std::size_t o);
  void mark_touched(std::size_t o);
  void touch_faces_at(std::size_t o, const OperandEdge& edge);

  int threads_;
  std::array<bool, 2> is_conforming_{};
  std::array<bool, 2> conforms_{};
  /// By edge: where its cuts and covers begin.
  std::array<std::vector<std::uint32_t>, 2> first_cut_, first_cover_;
};

}  // namespace halfspace::fast
