#pragma once

#include <cstdint>
#include <vector>

#include "boxes.hpp"
#include "halfspace/fast/solid.hpp"
#include "space.hpp"

namespace halfspace::fast {

/// A directed edge of a face to be.
struct Piece {
  std::int64_t bucket = 0;  ///< which face: all its pieces have the same
  std::int32_t plane = 0;   ///< the face's
  std::int32_t from = 0;
  std::int32_t to = 0;
  std::int32_t other = -1;  ///< as SolidEdge::other
};

/// The box of a face, rounded outwards.
Box face_box(const Solid& solid, const Face& face);

/// Drops the vertices at which nothing turns: all edges there are on one line.
/// What is left is in the order of buckets, loop by loop.
///
/// `pinned`, by vertex, are those of other faces, which must stay. May be
/// shorter than the space.
void straighten(std::vector<Piece>& pieces,
                const std::vector<std::uint8_t>& pinned, const Space& space);

}  // namespace halfspace::fast
