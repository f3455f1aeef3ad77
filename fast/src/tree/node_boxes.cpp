#include "tree/node_boxes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "box/box.hpp"
#include "tree/tree_access.hpp"
#include "tree/tree_reader.hpp"

namespace halfspace::fast {

void add_boxes(BspTree& tree, const Scene& scene) {
  const TreeReader reader(scene, tree);
  std::vector<Box> boxes(tree.nodes.size(), kEmptyBox);
  for (std::size_t n = tree.nodes.size(); n-- > 0;) {
    const Node& node = tree.nodes[n];
    Box& box = boxes[n];
    for_fragments(tree, node, [&](const TreeFragment& fragment) {
      for (const Corner& corner : reader.corners(fragment)) {
        extend(box, reader.vertex(corner.vertex));
      }
      return true;
    });
    for (const NodeId child : {node.positive, node.negative}) {
      if (child != kNoNode) extend(box, boxes[static_cast<std::size_t>(child)]);
    }
  }
  tree.boxes = std::move(boxes);
}

Extent extent_of(const BspTree& tree, int grid_bits) {
  const Extent grid = extent_of_grid(grid_bits);
  if (tree.nodes.empty() || tree.boxes.size() != tree.nodes.size()) return grid;
  double most = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    most = std::max({most, std::abs(double{tree.boxes[0].low[a]}),
                     std::abs(double{tree.boxes[0].high[a]})});
  }
  return {std::min(most, grid.most), grid.grid};
}

}  // namespace halfspace::fast
