#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "halfspace/fast/list.hpp"
#include "solid/loops.hpp"

namespace halfspace::fast {

/// The pieces of all lists in the order of buckets; those of one bucket in the
/// order of the lists.
///
/// Requires: `faces[o]` is how many faces operand `o` has (bucket_of()).
/// Cost:     linear: pieces are counted, bucket by bucket, and put in their
///           places; few pieces are sorted.
List<const DirectedEdge*> in_order_of_buckets(
    std::span<const List<DirectedEdge>> lists, std::array<std::size_t, 2> faces,
    int threads);

}  // namespace halfspace::fast
