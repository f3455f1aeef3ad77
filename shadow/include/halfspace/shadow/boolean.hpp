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
  /// The share of the operations to check, above 0 and at most 1: one of every
  /// 1/share consecutive operations.
  double share = 0.01;
  std::uint64_t seed = 1;   ///< chooses operations and points
  std::size_t points = 32;  ///< for each checked operation
  std::size_t kept = 16;    ///< the most mismatches kept in full
  /// Of fast::boolean(); 0: as many as the machine has.
  int threads = 1;
};

/// A point whose membership in the result is wrong, or at which a surface has a
/// winding number that no solid's has (S6.2).
struct PointMismatch {
  std::uint64_t operation = 0;       ///< its number, from 0 on
  std::array<std::string, 3> point;  ///< exact. Units: grid steps
  /// At the point: first operand, second operand, result; 1 is inside.
  std::array<int, 3> windings{};
  std::string reproducer;  ///< the operation and the operands, exactly
};

/// The operations that were checked, and the mismatches found.
struct BooleanReport {
  std::uint64_t operations = 0;  ///< in all
  std::uint64_t checked = 0;     ///< how many of them were checked
  std::size_t points = 0;
  std::size_t mismatches = 0;
  std::vector<PointMismatch> first;  ///< at most BooleanOptions::kept
};

/// Checks a result at points near the faces of all three solids: membership in
/// the result must follow from membership in the operands, and all winding
/// numbers must be 0 or 1 (S6.2, S6.4).
///
/// Exact: yes. Points and rays are rational, in the reference's numbers, and
///        use no decision of the fast library. A point whose ray meets an edge
///        is passed over.
/// Cost:  each point tests the boxes of all faces.
void check(BooleanOp operation, const fast::Solid& a, const fast::Solid& b,
           const fast::Solid& result, const BooleanOptions& how,
           BooleanReport& report);

/// fast::boolean(), counted in the report, and checked where it is chosen.
fast::Solid boolean(BooleanOp operation, const fast::Solid& a,
                    const fast::Solid& b, const BooleanOptions& how,
                    BooleanReport& report);

/// One sentence.
std::string to_string(const PointMismatch& mismatch);

}  // namespace halfspace::shadow
