// Builds the tree of two crossing triangles with the installed library: one of
// them is cut in two.
#include <cstdio>
#include <cstdlib>
#include <halfspace/ref/build.hpp>
#include <halfspace/scene.hpp>
#include <utility>

int main() {
  halfspace::SceneData data;
  data.vertices = {{-9, -9, 0}, {9, -9, 0}, {0, 9, 0},
                   {0, -5, -5}, {0, 5, -5}, {0, 0, 5}};
  data.corners = {0, 1, 2, 3, 4, 5};
  data.first_corner = {0, 3, 6};
  data.colors = {{200, 80, 40}, {40, 80, 200}};
  const halfspace::Result<halfspace::Scene> scene =
      halfspace::make_scene(std::move(data));
  if (!scene) {
    std::fprintf(stderr, "%s\n", scene.error().message.c_str());
    return EXIT_FAILURE;
  }
  const halfspace::ref::BspTree tree =
      halfspace::ref::build(*scene, {.rule = halfspace::RootRule::kFirst});
  const halfspace::TreeStats stats = halfspace::ref::stats(tree);
  std::printf("%zu nodes, %zu fragments\n", stats.nodes, stats.fragments);
  return stats.nodes == 3 && stats.fragments == 3 ? EXIT_SUCCESS : EXIT_FAILURE;
}
