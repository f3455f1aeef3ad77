#pragma once

#include <cstdint>
#include <span>

#include "halfspace/fast/list.hpp"
#include "table/shared_table.hpp"

namespace halfspace::fast {

/// Vertices, each named once, in the order of their coordinates.
///
/// Exact: yes.
/// Cost:  linear where the first coordinates lie evenly; n log n comparisons of
///        those that do not, or are nearly level.
List<std::int32_t> vertices_in_order(std::span<const std::int32_t> vertices,
                                     const GeometryTable& table);

}  // namespace halfspace::fast
