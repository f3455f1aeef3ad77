#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "box/box.hpp"
#include "halfspace/fast/solid.hpp"
#include "table/shared_table.hpp"

namespace halfspace::fast {

/// A directed edge of a face to be.
struct Piece {
  std::int64_t bucket = 0;  ///< which face: all its pieces have the same
  std::int32_t plane = 0;   ///< the face's
  std::int32_t from = 0;
  std::int32_t to = 0;
  std::int32_t other = -1;  ///< as SolidEdge::other
  /// So many edges of the source in a row from this one on, if not 0, flipped
  /// round as the face is.
  std::uint32_t run_first = 0;
  std::uint32_t run_count = 0;
};

/// What stands for a face of the result that is a part of operand `o`'s face.
inline std::int64_t bucket_of(std::size_t o, std::int32_t face, bool flipped) {
  return (static_cast<std::int64_t>(o) << 40) + 2 * std::int64_t{face} +
         (flipped ? 1 : 0);
}

/// Puts the edges in the order of the faces, if they are not.
void line_up(Solid& solid);

/// The box of a face, rounded outwards.
Box face_box(const Solid& solid, const Face& face);

/// Drops the vertices at which nothing turns: all edges there are on one line.
/// What is left is in the order of buckets, loop by loop.
///
/// `is_pinned(vertex)`: it is one of other faces too, and must stay.
void straighten(List<Piece>& pieces,
                const std::function<bool(std::int32_t)>& is_pinned,
                const GeometryTable& table);

}  // namespace halfspace::fast
