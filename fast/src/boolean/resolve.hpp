#pragma once

#include "halfspace/fast/resolve.hpp"
#include "table/shared_table.hpp"

namespace halfspace::fast {

/// As resolve().
/// Requires: the lease is of the solid's table.
Resolved resolved(const Solid& solid, TableLease& lease);

}  // namespace halfspace::fast
