#include "halfspace/fast/traverse.hpp"

#include "camera/edge_function.hpp"
#include "raster/exact_coverage.hpp"
#include "tree/traversal.hpp"

namespace halfspace::fast {

int EyeSide::exact(PlaneId id) const {
  return with_grid(reader_.scene().grid_bits(), [&](auto bits) {
    return sign(
        see(reader_.geometry().template exact<bits()>(id), camera_).eye);
  });
}

void back_to_front(const BspTree& tree, const Scene& scene,
                   const Camera& camera, const Display& display) {
  FilterStats stats;
  const TreeReader reader(scene, tree);
  const View view = make_view(camera, scene.grid_bits());
  const EyeSide eye_side(reader, view, camera.data(), stats);
  std::vector<std::int32_t> scratch;
  walk_back_to_front(tree, eye_side, [&](const Node& node, int) {
    return for_fragments_reversed(
        tree, node, scratch,
        [&](const TreeFragment& fragment) { return display(node, fragment); });
  });
}

void front_to_back(const BspTree& tree, const Scene& scene,
                   const Camera& camera, const Display& display) {
  FilterStats stats;
  const TreeReader reader(scene, tree);
  const View view = make_view(camera, scene.grid_bits());
  const EyeSide eye_side(reader, view, camera.data(), stats);
  walk_front_to_back(
      tree, eye_side, [](NodeId) { return true; },
      [&](const Node& node, int) {
        return for_fragments(tree, node, [&](const TreeFragment& fragment) {
          return display(node, fragment);
        });
      });
}

}  // namespace halfspace::fast
