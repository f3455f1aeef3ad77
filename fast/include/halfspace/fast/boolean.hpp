#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "halfspace/boolean.hpp"
#include "halfspace/fast/solid.hpp"

namespace halfspace::fast {

/// The regularised boolean of two solids in one unit (S6.4, S6.5).
///
/// The same point set as the reference's result. Either operand may be empty.
/// Shape: the first operand's faces come first; those that the other operand
///        does not touch are as they were. The others have no more edges than
///        the point set asks for: no vertex at which nothing turns, no edge
///        within a face, and every vertex on an edge is an end of it.
///        Of an operand that is not noded the last is so only where the other
///        one is; if one of its faces has a part of an edge in it there, that
///        is no edge of its own, it is noded as resolve() does it first.
/// Keeps: planes and colours, and where faces came from.
/// Exact: yes. Of closed surfaces that check_operand() refuses the result may
/// be
///        anything, and open, but there is one.
/// Cost:  n log n, and what the surfaces have in common. With more threads what
///        is near what is found by all of them; the result is the same.
Solid boolean(BooleanOp operation, const Solid& a, const Solid& b,
              int threads = 1);

/// An edge that keeps a surface from being closed: as halfspace::BadEdge, with
/// points by their ids (S6.1).
struct BadEdge {
  std::int32_t from = 0;
  std::int32_t to = 0;
  std::int64_t excess = 0;
  friend bool operator==(const BadEdge&, const BadEdge&) = default;
};

/// The edges of the solid that are not used equally often in each direction,
/// in the order of their ends' ids. Empty: closed and consistently oriented.
std::vector<BadEdge> bad_edges(const Solid& solid);

}  // namespace halfspace::fast
