#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "halfspace/fast/resolve.hpp"
#include "table/shared_table.hpp"

namespace halfspace::fast {

/// As resolve().
/// Requires: the lease is of the solid's table.
Resolved resolved(const Solid& solid, TableLease& lease);

/// The rest of a surface of which a patch is resolved.
struct RestOfSurface {
  /// By face of the patch: 1: it stays as it is; 0: it goes; -1: that is to be
  /// found.
  std::vector<std::int8_t> stays;
  /// What the faces that are not in the patch add to the winding number that
  /// PointLocator::winding(vertex, target) finds.
  std::function<int(std::int32_t vertex, std::int32_t target)> winding;
};

/// What becomes of a patch of a closed surface when all of that is resolved.
///
/// Requires: a face of which is known whether it stays, and any that is not in
///           the patch, meets others in vertices and edges that it shares with
///           them alone. All faces that share a vertex with one of which it is
///           not known are in the patch.
/// Shape:    the faces that stay as they are, then `faces_cut` of those that do
///           not.
Resolved resolved_patch(const Solid& patch, TableLease& lease,
                        const RestOfSurface& rest);

}  // namespace halfspace::fast
