#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "halfspace/bsp_tree.hpp"
#include "halfspace/fast/predicate.hpp"

namespace halfspace::fast {

/// Which of `polygons` becomes the root of their tree, by its place in the
/// list (S3.3).
///
/// `key` is the state of the draw at this node (S3.4); only RootRule::kRandom
/// looks at it.
/// Requires: polygons in id order, at least one; options.candidates >= 1.
/// Ties:     the lowest polygon id.
/// Exact:    yes.
/// Cost:     one relation for each polygon and candidate; every polygon is a
///           candidate, but for kFirst (none is compared) and kRandom.
std::size_t choose_root(const Scene& scene,
                        const std::vector<Fragment>& polygons,
                        const BuildOptions& options, std::uint64_t key,
                        FilterStats& stats);

}  // namespace halfspace::fast
