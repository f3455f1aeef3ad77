#include "halfspace/fast/traverse.hpp"

#include "tree/traversal.hpp"

namespace halfspace::fast {

void back_to_front(const BspTree& tree, const Scene& scene,
                   const Camera& camera, const Visitor& visit) {
  FilterStats stats;
  const TreeReader reader(scene, tree);
  const View view = make_view(camera, scene.grid_bits());
  const EyeClassifier side_of_eye(reader, view, camera.data(), stats);
  std::vector<std::int32_t> scratch;
  walk_back_to_front(tree, side_of_eye, EnterAll{}, [&](const Node& node, int) {
    return for_fragments_reversed(
        tree, node, scratch,
        [&](const TreeFragment& fragment) { return visit(node, fragment); });
  });
}

void front_to_back(const BspTree& tree, const Scene& scene,
                   const Camera& camera, const Visitor& visit) {
  FilterStats stats;
  const TreeReader reader(scene, tree);
  const View view = make_view(camera, scene.grid_bits());
  const EyeClassifier side_of_eye(reader, view, camera.data(), stats);
  walk_front_to_back(
      tree, side_of_eye, [](NodeId) { return true; },
      [&](const Node& node, int) {
        return for_fragments(tree, node, [&](const TreeFragment& fragment) {
          return visit(node, fragment);
        });
      });
}

}  // namespace halfspace::fast
