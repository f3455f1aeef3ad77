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
class Emitter {
 public:
  Emitter(Arrangement& arrangement, Classifier& classifier)
      : common_(arrangement),
        classifier_(classifier),
        operands_(arrangement.operands),
        table_(arrangement.table) {}

  /// In no order; all of one face of the result have one bucket.
  List<DirectedEdge> run();

 private:
  void emit_edges(std::size_t o);
  void emit_whole(std::size_t o, std::int32_t edge);
  void emit_parts(std::size_t o, std::int32_t edge);
  void emit_intersection_segments();
  void emit(const Segment& segment, const std::array<bool, 2>& member);
  bool is_before_inside(std::size_t o, bool member) const;
  const HalfFace& source_of(std::size_t first, std::size_t last) const;
  void find_covered(std::size_t o, std::int32_t edge,
                    const std::vector<std::int32_t>& points);
  HalfFace half_face_of(std::size_t o, std::int32_t face, int turn) const;

  Arrangement& common_;
  Classifier& classifier_;
  std::array<Operand, 2>& operands_;
  GeometryTable& table_;
  List<DirectedEdge> pieces_;
  /// Parts of an edge, and covers of it that they lie in, in order.
  std::vector<std::pair<std::size_t, std::size_t>> covered_;
  std::vector<HalfFace> half_faces_;
};

}  // namespace halfspace::fast
