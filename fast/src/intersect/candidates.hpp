#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "base/epoch_array.hpp"
#include "box/box.hpp"
#include "halfspace/fast/solid.hpp"
#include "solid/dynamic_bvh.hpp"
#include "solid/edge_packets.hpp"
#include "table/shared_table.hpp"

/// What a boolean works on: which faces of the operands are near each other,
/// where their edges are cut, and what else they have in common.
namespace halfspace::fast {

/// An edge of an operand without direction, from `low` to `high` along `axis`.
struct LineEdge {
  std::int32_t low = 0;
  std::int32_t high = 0;
  std::int32_t axis = 0;
  std::int32_t plane = 0;   ///< of its first face
  std::int32_t other = -1;  ///< a second plane through it; -1: not known yet
  std::int32_t owner = 0;   ///< its first face, which reports what it meets
  std::uint32_t first_edge = 0;  ///< of the solid: the face's
  std::uint32_t first_use = 0;
  std::uint32_t use_count = 0;
  /// The planes that it was cut by last, and where.
  std::array<std::int32_t, 2> cut_by{-1, -1};
  std::array<std::int32_t, 2> cut_at{};
};

/// A face at an edge. `forward`: it has the edge from low to high.
struct EdgeUse {
  std::int32_t face = 0;
  bool forward = false;
};

/// A point at which an edge meets a face of the other operand.
struct Cut {
  std::int32_t edge = 0;
  std::int32_t vertex = 0;
  std::int32_t face = 0;
};

/// A part of an edge that lies in a face of the other operand.
struct Cover {
  std::int32_t edge = 0;
  std::int32_t low = 0;
  std::int32_t high = 0;
  std::int32_t face = 0;
  bool left = false;     ///< the face is there on the left of the edge, as seen
  bool right = false;    ///< against its plane's normal; on the right
  bool on_edge = false;  ///< it has an edge there
};

/// A segment in the interiors of a face of either operand.
struct Trace {
  std::int32_t first = 0;   ///< the first operand's face
  std::int32_t second = 0;  ///< the second's
  std::int32_t low = 0;
  std::int32_t high = 0;
  std::int32_t axis = 0;
};

/// Scratch arrays by vertex: of both operands', or of either's.
struct BooleanScratch {
  EpochArray<std::uint8_t> on_other;
  std::array<SparseDisjointSets, 2> sets;
  std::array<EpochArray<std::uint8_t>, 2> member;
  EpochArray<std::uint8_t> kept;
};

/// An operand of a boolean at work.
///
/// Of a large solid it may be no more than the faces near the other operand.
/// An edge that the other's box does not meet is far: it is not among `edges`,
/// for nothing can happen to it.
struct Operand {
  const Solid* solid = nullptr;
  /// The whole of it, if `solid` is not, and where its faces are.
  const Solid* whole = nullptr;
  const FaceIndex* index = nullptr;
  std::shared_ptr<const EdgeBlocks> blocks;  ///< of `solid`
  std::shared_ptr<const EdgeBlocks> whole_blocks;
  Box extent = kEmptyBox;               ///< of the whole
  Box reach = kEmptyBox;                ///< the other operand's extent
  std::vector<std::int32_t> active;     ///< faces whose boxes meet other faces'
  std::vector<std::uint8_t> is_active;  ///< by face
  std::vector<std::uint8_t> touched;    ///< by face: it meets another
  std::vector<LineEdge> edges;          ///< of the active faces, near ones
  std::vector<EdgeUse> uses;            ///< by edge
  std::vector<std::int32_t> edge_of;    ///< by edge of the solid; -1: not here
  std::vector<Cut> cuts;
  std::vector<Cover> covers;
  /// By vertex: on both operands' surfaces.
  EpochArray<std::uint8_t>* on_other = nullptr;

  const Face& face(std::int32_t f) const {
    return solid->faces[static_cast<std::size_t>(f)];
  }
  const SolidEdge* edges_of(std::int32_t f) const {
    return solid->edges.data() + face(f).first_edge;
  }
  LineEdge& edge(std::int32_t e) { return edges[static_cast<std::size_t>(e)]; }
  bool is_on_other(std::int32_t v) const { return on_other->get(v, 0) != 0; }
  void put_on_other(std::int32_t v) { on_other->set(v, 1); }
};

/// Whether a point is surely not in the box.
inline bool is_beyond(const Box& box, const Vertex& v) {
  const double at[3] = {v.x, v.y, v.z};
  for (std::size_t k = 0; k < 3; ++k) {
    if (at[k] + v.error < double{box.low[k]} ||
        at[k] - v.error > double{box.high[k]})
      return true;
  }
  return false;
}

/// Whether a segment is surely not in the box.
inline bool is_beyond(const Box& box, const Vertex& u, const Vertex& v) {
  const double p[3] = {u.x, u.y, u.z};
  const double q[3] = {v.x, v.y, v.z};
  for (std::size_t k = 0; k < 3; ++k) {
    if ((p[k] + u.error < double{box.low[k]} &&
         q[k] + v.error < double{box.low[k]}) ||
        (p[k] - u.error > double{box.high[k]} &&
         q[k] - v.error > double{box.high[k]}))
      return true;
  }
  return false;
}

/// Makes room, makes blocks of edges where there are none yet, and finds how
/// far either operand reaches.
void prepare(Operand& a, Operand& b, BooleanScratch& scratch);

/// The pairs of faces whose boxes overlap; fills in `active`.
std::vector<std::pair<std::int32_t, std::int32_t>> near_pairs(Operand& a,
                                                              Operand& b,
                                                              int threads = 1);

/// Fills in the near edges of the active faces.
void add_edges(Operand& operand, const GeometryTable& table);

/// The far edges of a face, in rows each of which goes on from edge to edge; or
/// of whole loops, if the face has many edges.
class FarRows {
 public:
  /// The face's edges from the first to before the last.
  struct Row {
    std::uint32_t first = 0;
    std::uint32_t last = 0;
  };

  FarRows(const Operand& operand, std::int32_t face)
      : operand_(operand),
        face_(operand.face(face)),
        edges_(operand.edges_of(face)),
        list_(operand.blocks->of(face)) {}
  /// The next one, or nothing.
  std::optional<Row> next();

 private:
  std::uint32_t far_from(std::uint32_t edge, std::uint32_t& loop);
  bool goes_on(std::uint32_t edge) const {
    return edges_[edge - 1].to == edges_[edge].from;
  }

  const Operand& operand_;
  const Face& face_;
  const SolidEdge* edges_;
  const BlockList* list_;
  std::size_t block_ = 0;
  std::uint32_t at_ = 0;
  Row rest_;  ///< found with the last row, and comes after it
};

/// A plane through the edge other than its first face's.
std::int32_t second_plane(LineEdge& edge, const Operand& operand,
                          GeometryTable& table);

/// Likewise, of an edge of which nothing is known but its ends and its face.
std::int32_t plane_athwart(const SolidEdge& edge, const Face& face,
                           GeometryTable& table);

/// Whether a point off the operand's surface is inside: the vertex, or where
/// that does not tell, right beside it in the direction of `towards` (S6.2).
class Locator {
 public:
  Locator(const Operand& operand, const GeometryTable& table);
  /// Without `blocks` all edges of a face are looked at.
  Locator(const Solid& solid, const GeometryTable& table,
          const FaceIndex* index, const EdgeBlocks* blocks);
  bool is_inside(std::int32_t vertex, std::int32_t towards) const {
    return winding(vertex, towards) > 0;
  }
  /// How often the surface winds round the point. On the surface: round one
  /// right beside it, along the first axis, by far less along the last, and by
  /// far less still along the second.
  int winding(std::int32_t vertex, std::int32_t towards) const;
  /// What one face adds to that, or to the like for another axis in place of
  /// the first one.
  /// Requires: it has edges.
  int share(int axis, std::int32_t face, std::int32_t vertex,
            std::int32_t towards) const;

 private:
  template <class Found>
  void find(const Box& ray, Found&& found) const;
  bool is_above(int axis, std::int32_t face, std::int32_t vertex,
                std::int32_t towards) const;
  bool is_right(int right, std::int32_t v, std::int32_t vertex,
                std::int32_t towards) const;
  bool passes_over(int axis, const Face& face, std::uint32_t first,
                   std::uint32_t last, std::int32_t vertex,
                   std::int32_t towards) const;

  const Solid& solid_;
  const GeometryTable& table_;
  const FaceIndex* index_;
  const EdgeBlocks* blocks_;
  /// The first few questions are not worth an index of its own.
  mutable std::optional<FaceIndex> own_;
  mutable int asked_ = 0;
};

}  // namespace halfspace::fast
