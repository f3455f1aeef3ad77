#pragma once

#include <cstdint>
#include <map>
#include <tuple>

#include "halfspace/fast/solid.hpp"
#include "halfspace/ref/rational.hpp"

namespace halfspace::identities {

/// A sum of the volumes of solids in one table, with whole factors: exactly.
///
/// A face's share in six times the volume is a sum over its edges: the
/// determinant of a grid point of its plane and the edge's two ends. Equal
/// terms are counted, not added. So those of faces that are as they were are
/// never worked out, and the others cancel plane by plane if they do at all:
/// then numbers stay small, however large the solids.
class VolumeSum {
 public:
  /// Requires: all solids in one table, each bounded.
  void add(const fast::Solid& solid, int factor);

  /// Six times the sum, in cubic grid steps.
  ref::Rational times6() const;

 private:
  /// A plane and the ends of an edge, the lower id first; how often forwards.
  std::map<std::tuple<std::int32_t, std::int32_t, std::int32_t>, std::int64_t>
      terms_;
  fast::Solid any_;  ///< no faces: the table
};

}  // namespace halfspace::identities
