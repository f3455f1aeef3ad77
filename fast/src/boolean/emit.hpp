#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "boolean/classify.hpp"
#include "intersect/radial_order.hpp"
#include "solid/loops.hpp"

namespace halfspace::fast {

/// Step 2 of a boolean: finds the directed edges of the result's faces near the
/// places where the operands meet.
///
/// The result is made of segments, not of fragments: every segment of its edges
/// is one of an operand's edge, cut where it meets the other surface, or an
/// intersection segment. Round a segment the half-faces of both surfaces, in
/// radial order (WEI88), part space into wedges, each inside or outside of
/// either solid. A half-face of the result stands between two wedges of which
/// just one is in it (S6.4). So no cut is made that does not bound the result,
/// and coincident faces are half-faces that coincide.
///
/// Threads share blocks of edges and of segments. What needs a ray, which finds
/// out something that is kept for others, is left until they are done.
class Emitter {
 public:
  /// Lists of directed edges, in an order that does not depend on threads. All
  /// of one face of the result have one bucket.
  static std::vector<List<DirectedEdge>> run(Arrangement& arrangement,
                                             Classifier& classifier,
                                             int threads);

 private:
  /// Edges or segments in a row, and the directed edges that they give.
  struct Block {
    std::size_t kind = 0;  ///< 0, 1: edges of that operand; 2: segments
    std::size_t first = 0;
    std::size_t last = 0;
    /// Edges of which a thread cannot tell alone whether they are inside, and
    /// before which of the others they come.
    std::vector<std::pair<std::size_t, std::int32_t>> left;
  };

  /// `is_shared`: others work on other blocks at the same time.
  Emitter(Arrangement& arrangement, Classifier& classifier, bool is_shared)
      : is_shared_(is_shared),
        common_(arrangement),
        classifier_(classifier),
        operands_(arrangement.operands),
        table_(arrangement.table) {}

  static std::vector<Block> blocks_of(const Arrangement& arrangement);
  static void find_planes(Arrangement& arrangement);
  void emit_block(Block& block);
  void emit_left(const Block& block, List<DirectedEdge>& pieces);
  bool emit_edge(std::size_t o, std::int32_t edge);
  bool emit_whole(std::size_t o, std::int32_t edge);
  bool emit_parts(std::size_t o, std::int32_t edge);
  void emit_segment(const IntersectionSegment& trace);
  void emit(const Segment& segment, const std::array<bool, 2>& member);
  bool is_before_inside(std::size_t o, bool member) const;
  const HalfFace& source_of(std::size_t first, std::size_t last) const;
  void find_covered(std::size_t o, std::int32_t edge,
                    const std::vector<std::int32_t>& points);
  HalfFace half_face_of(std::size_t o, std::int32_t face, int turn) const;

  bool is_shared_;
  Arrangement& common_;
  Classifier& classifier_;
  std::array<Operand, 2>& operands_;
  GeometryTable& table_;
  List<DirectedEdge> pieces_;
  std::vector<std::int32_t> points_;  ///< on an edge
  /// Parts of an edge, and covers of it that they lie in, in order.
  std::vector<std::pair<std::size_t, std::size_t>> covered_;
  std::vector<HalfFace> half_faces_;
};

}  // namespace halfspace::fast
