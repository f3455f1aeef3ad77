#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "base/epoch_array.hpp"
#include "box/box.hpp"
#include "halfspace/fast/solid.hpp"
#include "solid/dynamic_bvh.hpp"
#include "solid/edge_packets.hpp"
#include "table/shared_table.hpp"

/// An operand of a boolean, and the records of what its surface has in common
/// with the other operand's.
namespace halfspace::fast {

/// An edge of an operand without direction, from `low` to `high` along `axis`.
struct OperandEdge {
  std::int32_t low = 0;
  std::int32_t high = 0;
  std::int32_t axis = 0;
  std::int32_t plane = 0;  ///< of its first face
  /// A second plane through it; -1: not known yet, as all its faces are in one.
  std::int32_t other = -1;
  std::int32_t owner = 0;  ///< its first face, which reports what it meets
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
struct EdgeFaceIntersection {
  std::int32_t edge = 0;
  std::int32_t vertex = 0;
  std::int32_t face = 0;
};

/// A part of an edge that lies in a face of the other operand.
struct EdgeInFace {
  std::int32_t edge = 0;
  std::int32_t low = 0;
  std::int32_t high = 0;
  std::int32_t face = 0;
  bool left = false;     ///< the face is there on the left of the edge, as seen
  bool right = false;    ///< against its plane's normal; on the right
  bool on_edge = false;  ///< it has an edge there
};

/// A segment in the interiors of a face of either operand.
struct IntersectionSegment {
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
  /// By plane: whether an operand has faces there.
  EpochArray<std::uint8_t> planes;
};

/// An operand of a boolean.
///
/// May hold only those faces of a large solid that are near the other operand.
/// Edges outside the other operand's box are far: they are not in `edges`, for
/// nothing meets them.
struct Operand {
  const Solid* solid = nullptr;
  /// The whole of it, if `solid` is not, and where its faces are.
  const Solid* whole = nullptr;
  const DynamicBvh* index = nullptr;
  std::shared_ptr<const EdgePackets> blocks;  ///< of `solid`
  std::shared_ptr<const EdgePackets> whole_blocks;
  Box extent = kEmptyBox;               ///< of the whole
  Box reach = kEmptyBox;                ///< the other operand's extent
  std::vector<std::int32_t> active;     ///< faces whose boxes meet other faces'
  std::vector<std::uint8_t> is_active;  ///< by face
  std::vector<std::uint8_t> touched;    ///< by face: it meets another
  /// By face whether the other operand has it, too (find_common_faces());
  /// empty: none.
  enum Common : std::uint8_t { kNotCommon, kSame, kOpposite };
  std::vector<Common> common;
  List<OperandEdge> edges;     ///< of the active faces, near ones
  List<EdgeUse> uses;          ///< by edge
  List<std::int32_t> edge_of;  ///< by edge of the solid; -1: not here
  List<EdgeFaceIntersection> cuts;
  List<EdgeInFace> covers;
  /// By vertex: on both operands' surfaces.
  EpochArray<std::uint8_t>* on_other = nullptr;

  const Face& face(std::int32_t f) const {
    return solid->faces[static_cast<std::size_t>(f)];
  }
  const SolidEdge* edges_of(std::int32_t f) const {
    return solid->edges.data() + face(f).first_edge;
  }
  Common common_at(std::int32_t f) const {
    return common.empty() ? kNotCommon : common[static_cast<std::size_t>(f)];
  }
  OperandEdge& edge(std::int32_t e) {
    return edges[static_cast<std::size_t>(e)];
  }
  /// Other threads may touch faces at the same time.
  void touch(std::int32_t f) {
    std::atomic_ref(touched[static_cast<std::size_t>(f)])
        .store(1, std::memory_order_relaxed);
  }
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

}  // namespace halfspace::fast
