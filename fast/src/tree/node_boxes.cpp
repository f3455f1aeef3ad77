#include "tree/node_boxes.hpp"

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

}  // namespace halfspace::fast
