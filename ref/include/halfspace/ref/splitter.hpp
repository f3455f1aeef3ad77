#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "halfspace/bsp_tree.hpp"
#include "halfspace/ref/predicate.hpp"

namespace halfspace::ref {

/// Which of `polygons` becomes the root of their tree, by its place in the
/// list (S3.3).
///
/// Polygon `f.source` lies in plane `planes[f.source]`. `key` is the state of
/// the draw at this node (S3.4); only RootRule::kRandom looks at it.
/// Requires: polygons in id order, at least one; options.candidates >= 1.
/// Ties:     the lowest polygon id.
/// Cost:     one relation for each polygon and candidate; every polygon is a
///           candidate, but for kFirst (none is compared) and kRandom.
std::size_t choose_root(const std::vector<Plane>& planes,
                        const std::vector<Fragment>& polygons,
                        const BuildOptions& options, std::uint64_t key);

}  // namespace halfspace::ref
