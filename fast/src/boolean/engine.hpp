#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "boolean/conform.hpp"
#include "intersect/candidates.hpp"
#include "intersect/radial_order.hpp"
#include "solid/loops.hpp"
#include "table/shared_table.hpp"

namespace halfspace::fast {

/// Carries out one boolean.
///
/// The result is made of segments, not of fragments. Every segment of the
/// result's edges is one of an edge of either operand, cut where it meets the
/// other's surface, or of a trace. Round a segment the half-planes of both
/// surfaces part space into wedges, each inside or outside of either solid; the
/// result's half-planes stand between wedges of which just one is in it (S6.4),
/// and tell on which side of the segment which faces lie. All segments of a
/// face together are the boundary of what is left of it. So a cut that serves
/// no end of its own is never made, and coincident faces are half-planes that
/// coincide.
class Engine {
 public:
  /// A solid of which an operand is only the faces that are near the other
  /// operand, where its faces are found, if there is an index, and its box; and
  /// the blocks of either's edges.
  struct Whole {
    const Solid* solid = nullptr;
    const FaceIndex* index = nullptr;
    Box extent = kEmptyBox;
    std::shared_ptr<const EdgeBlocks> blocks;
    std::shared_ptr<const EdgeBlocks> part_blocks;
  };

  Engine(BooleanOp operation, const Solid& a, const Solid& b, TableLease& lease,
         int threads = 1);
  /// Likewise if `a` is only a part.
  Engine(BooleanOp operation, const Solid& a, const Solid& b, TableLease& lease,
         const Whole& whole);
  /// Finds what the operands have in common.
  void find_contacts();
  /// Whether an operand has no part of an edge but at edges, where it meets the
  /// other one (add_nodes()).
  /// Requires: find_contacts() was called.
  bool has_nodes(std::size_t o) const { return has_nodes_[o]; }
  /// The faces of the result, of one source each.
  /// Requires: likewise, and both operands have nodes; else it may be wrong.
  Solid run();
  /// Of the result's edges.
  EdgeBlocks& blocks() { return result_blocks_; }
  /// Whether the first operand's face has nothing in common with the other.
  bool is_untouched(std::int32_t face) const {
    return operands_[0].touched[static_cast<std::size_t>(face)] == 0;
  }

 private:
  /// Of what is joined, in the other operand.
  enum Member : std::uint8_t { kUnknown, kOutside, kInside };

  /// A part of an edge that is inside the other operand or not.
  struct KnownPart {
    std::size_t part = 0;
    bool inside = false;
  };

  void drop_apart(std::vector<std::pair<std::int32_t, std::int32_t>>& pairs);
  Solid result();
  void sort_records(std::size_t o);
  void mark_touched(std::size_t o);
  void join_vertices(std::size_t o);
  void note_members(std::size_t o);
  void emit_edges(std::size_t o);
  void emit_whole(std::size_t o, std::int32_t edge);
  void emit_parts(std::size_t o, std::int32_t edge);
  void emit_traces();
  void emit(const Segment& segment, const std::array<bool, 2>& member);
  bool is_before_inside(std::size_t o, bool member) const;
  const Wing& source_of(std::size_t first, std::size_t last) const;
  void begin_face(std::size_t o, std::int32_t face, bool flipped,
                  Solid& result) const;
  void copy_untouched(std::size_t o, Solid& result);
  void copy_whole(std::size_t o, std::int32_t face, bool is_near,
                  Solid& result);
  bool is_far(std::size_t o, std::int32_t face) const;
  std::int32_t copy_far(std::size_t o, std::int32_t first, Solid& result);
  void copy_row(std::size_t o, std::int32_t first, std::int32_t last,
                Solid& result);
  void add_runs(std::size_t o);
  void add_run(std::size_t o, std::int32_t face, bool beyond,
               const FarRows::Row& row);
  void add_edge(const Piece& piece, Solid& result);
  void end_face(Solid& result);
  Wing wing_of(std::size_t o, std::int32_t face, int turn) const;

  std::span<const Cut> cuts_of(std::size_t o, std::int32_t edge) const;
  std::span<const Cut> cuts_at(std::size_t o, std::int32_t edge,
                               std::int32_t vertex) const;
  std::span<const Cover> covers_of(std::size_t o, std::int32_t edge) const;
  /// The ends of an edge and the points between that cut it, in order.
  void find_points(std::size_t o, std::int32_t edge);
  /// Which covers the parts between those points lie in.
  void find_covered(std::size_t o, std::int32_t edge);
  std::optional<bool> crossing_tells(std::size_t o, std::int32_t edge,
                                     std::int32_t at,
                                     std::int32_t towards) const;
  bool is_inside(std::size_t o, std::int32_t vertex);
  bool is_part_inside(std::size_t o, std::int32_t edge, std::int32_t low,
                      std::int32_t high);
  std::optional<bool> told_inside(std::size_t o, std::int32_t edge,
                                  std::int32_t low, std::int32_t high);
  std::optional<bool> carried_inside(std::size_t o, std::int32_t edge,
                                     const KnownPart& before, std::size_t part);
  const Locator& locator(std::size_t o);
  bool is_beyond_other(std::size_t o, std::int32_t vertex) const {
    return is_beyond(operands_[o].reach, table_.vertex(vertex).approximate);
  }
  /// The root of a vertex's set, of `vertex + 1`: 0 for vertices beyond the
  /// other operand's box, all of which are on one side of it.
  std::int32_t root(std::size_t o, std::int32_t vertex) {
    const SparseParents& parents = scratch_.sets[o].parents();
    const std::int32_t up = parents.get(vertex + 1, -1);
    // Nearly always, and short enough to be inlined.
    if (up >= 0 && parents.get(up) == up) return up;
    return find_root(o, vertex);
  }
  std::int32_t find_root(std::size_t o, std::int32_t vertex);
  bool is_joined(std::size_t o, const SolidEdge* edges) const;
  void join(std::size_t o, std::int32_t u, std::int32_t v);
  std::int32_t join_root(std::size_t o, std::int32_t r, std::int32_t v);
  void touch_faces_at(std::size_t o, const LineEdge& edge);
  bool apply(std::size_t o, bool own, bool other) const {
    return o == 0 ? is_member(operation_, own, other)
                  : is_member(operation_, other, own);
  }

  BooleanOp operation_;
  int threads_;
  GeometryTable& table_;
  BooleanScratch& scratch_;
  std::array<Operand, 2> operands_;
  std::array<bool, 2> is_conforming_{};  ///< known to be, all over
  std::array<bool, 2> has_nodes_{};      ///< where the operands meet
  std::vector<Trace> traces_;
  /// By edge: where its cuts and covers begin.
  std::array<std::vector<std::uint32_t>, 2> first_cut_, first_cover_;
  std::array<std::optional<Locator>, 2> locators_;
  /// Of the operands' near faces only.
  std::array<std::optional<Locator>, 2> near_locators_;
  List<Piece> pieces_;
  std::vector<std::int32_t> points_;
  /// Parts of an edge, and covers of it that they lie in, in order.
  std::vector<std::pair<std::size_t, std::size_t>> covered_;
  std::vector<Wing> wings_;
  EdgeBlocks result_blocks_;
  /// Those of the face at work that are known.
  std::vector<EdgeBlock> known_blocks_;
};

}  // namespace halfspace::fast
