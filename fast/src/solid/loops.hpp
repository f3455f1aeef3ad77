#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "box/box.hpp"
#include "halfspace/fast/solid.hpp"
#include "table/shared_table.hpp"

namespace halfspace::fast {

/// A directed edge of a face under construction.
struct DirectedEdge {
  std::int64_t bucket = 0;  ///< which face: all its pieces have the same
  std::int32_t plane = 0;   ///< the face's
  std::int32_t from = 0;
  std::int32_t to = 0;
  std::int32_t other = -1;  ///< as SolidEdge::other
  /// If not 0: stands for a run of this many edges of the source, from
  /// `run_first` on, reversed if the face is flipped.
  std::uint32_t run_first = 0;
  std::uint32_t run_count = 0;
};

/// The bucket of the result's face that is a part of operand `o`'s face.
inline std::int64_t bucket_of(std::size_t o, std::int32_t face, bool flipped) {
  return (static_cast<std::int64_t>(o) << 40) + 2 * std::int64_t{face} +
         (flipped ? 1 : 0);
}

/// Whether the edges are in the order of the faces, without gaps.
bool are_packed(const Solid& solid);

/// Puts the edges in the order of the faces, if they are not. Gaps go.
void pack_edges(Solid& solid);

/// The box of a face, rounded outwards.
Box face_box(const Solid& solid, const Face& face);

/// Drops collinear vertices: those at which two edges of one line meet and no
/// other. Leaves the edges in the order of buckets, loop by loop.
///
/// `is_pinned(vertex)`: other faces have the vertex too, so it must stay.
void drop_collinear_vertices(List<DirectedEdge>& pieces,
                             const std::function<bool(std::int32_t)>& is_pinned,
                             const GeometryTable& table);

}  // namespace halfspace::fast
