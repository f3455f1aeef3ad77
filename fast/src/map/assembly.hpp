#pragma once

#include <functional>

#include "map/cell_tree.hpp"

namespace halfspace::fast {

/// Merges the cells of a tree to regions and links their boundaries (S7.3 to
/// S7.5). `key_of` is asked for the key of an item.
VisibleMap assemble(const CellTree& cells, LineTable& lines,
                    const std::function<std::int32_t(PolygonId)>& key_of);

}  // namespace halfspace::fast
