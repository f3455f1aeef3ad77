#include "tree/leaf_divider.hpp"

#include <algorithm>

#include "halfspace/assert.hpp"
#include "tree/tree_access.hpp"

namespace halfspace::fast {
namespace {

const Progress kSilent;

/// A tree without nodes that names planes as another does.
BspTree empty_part(const BspTree& tree) {
  BspTree part;
  part.free_planes = tree.free_planes;
  part.slanted = tree.slanted;
  return part;
}

}  // namespace

void fragments_of_leaf(const BspTree& tree, const Node& leaf,
                       std::vector<FragmentRef>& fragments) {
  fragments.clear();
  for_fragments(tree, leaf, [&](const TreeFragment& listed) {
    fragments.push_back(
        {listed.source, listed.first_corner, listed.corner_count});
    return true;
  });
  std::sort(fragments.begin(), fragments.end(),
            [](const FragmentRef& p, const FragmentRef& q) {
              return p.source < q.source;
            });
}

LeafDivider::LeafDivider(const Scene& scene, const BspTree& tree,
                         FilterStats& stats)
    : tree_(tree),
      vertex_count_(static_cast<std::int32_t>(scene.data().vertices.size())),
      part_(empty_part(tree)),
      partition_(scene, kLeafOptions, part_, stats, kSilent) {}

const BspTree& LeafDivider::divide(const Node& leaf) {
  HALFSPACE_ASSERT(leaf.splitter == kNoPlane);
  part_.nodes.clear();
  part_.fragments.clear();
  part_.corners.clear();
  part_.cut_vertices.clear();
  fragments_of_leaf(tree_, leaf, fragments_);
  if (fragments_.empty()) return part_;
  for (FragmentRef& fragment : fragments_) fragment = copy_of(fragment);
  part_.nodes.emplace_back();
  partition_.divide(0, fragments_,
                    leaf_seed(static_cast<NodeId>(&leaf - tree_.nodes.data())));
  return part_;
}

FragmentRef LeafDivider::copy_of(const FragmentRef& fragment) {
  const FragmentRef copy = {fragment.source,
                            static_cast<std::uint32_t>(part_.corners.size()),
                            fragment.count};
  for (std::uint32_t k = 0; k < fragment.count; ++k) {
    Corner corner = tree_.corners[fragment.first + k];
    if (corner.vertex >= vertex_count_) {
      const auto cut = static_cast<std::size_t>(corner.vertex - vertex_count_);
      corner.vertex =
          vertex_count_ + static_cast<std::int32_t>(part_.cut_vertices.size());
      part_.cut_vertices.push_back(tree_.cut_vertices[cut]);
    }
    part_.corners.push_back(corner);
  }
  return copy;
}

}  // namespace halfspace::fast
