#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "halfspace/boolean.hpp"
#include "halfspace/fast/boolean.hpp"

namespace halfspace::shadow {

/// Which booleans are checked, and at how many points.
struct BooleanOptions {
  /// The share of the operations, above 0 and at most 1: of every 1/share in a
  /// row, one is chosen.
  double share = 0.01;
  std::uint64_t seed = 1;   ///< chooses them, and the points
  std::size_t points = 32;  ///< of each checked operation
  std::size_t kept = 16;    ///< so many mismatches are told in full
  int threads = 1;          ///< of fast::boolean()
};

/// A point that is in the result and should not be, or the other way round; or
/// at which a surface has a winding number that no solid's has (S6.2).
struct PointMismatch {
  std::uint64_t operation = 0;       ///< which one in the row, from 0 on
  std::array<std::string, 3> point;  ///< exact. Units: grid steps
  /// Of the first operand, the second, and the result; 1 is inside.
  std::array<int, 3> windings{};
  std::string reproducer;  ///< the operation and the operands, exactly
};

/// What was checked, and what was found.
struct BooleanReport {
  std::uint64_t operations = 0;  ///< in all
  std::uint64_t checked = 0;     ///< of them
  std::size_t points = 0;
  std::size_t mismatches = 0;
  std::vector<PointMismatch> first;  ///< BooleanOptions::kept of them at most
};

/// Checks a result, whoever made it, at points near the faces of all three
/// solids: what is in it must be what the operation makes of what is in the
/// operands, and the winding numbers of all three must be 0 or 1 (S6.2, S6.4).
///
/// Exact: yes: points are rational and so are rays, by the reference's numbers,
///        and by none of the fast library's decisions. A ray that meets an edge
///        is drawn again.
/// Cost:  for each point the boxes of all faces.
void check(BooleanOp operation, const fast::Solid& a, const fast::Solid& b,
           const fast::Solid& result, const BooleanOptions& how,
           BooleanReport& report);

/// fast::boolean(), counted in the report, and checked if it is chosen.
fast::Solid boolean(BooleanOp operation, const fast::Solid& a,
                    const fast::Solid& b, const BooleanOptions& how,
                    BooleanReport& report);

/// Likewise fast::symmetric_difference(). What is checked is that it is the
/// union of the two differences.
fast::Solid symmetric_difference(const fast::Solid& a, const fast::Solid& b,
                                 const BooleanOptions& how,
                                 BooleanReport& report);

/// One sentence.
std::string to_string(const PointMismatch& mismatch);

}  // namespace halfspace::shadow
