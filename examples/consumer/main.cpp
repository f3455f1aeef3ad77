// Builds the tree of two crossing triangles with the installed library, one of
// which is cut in two, and makes an image of them: with the reference, and with
// the fast library, whose image must be the same.
#include <cstdio>
#include <cstdlib>
#include <halfspace/fast/build.hpp>
#include <halfspace/fast/render.hpp>
#include <halfspace/io/view.hpp>
#include <halfspace/ref/build.hpp>
#include <halfspace/ref/render.hpp>
#include <halfspace/scene.hpp>
#include <utility>

int main() {
  halfspace::SceneData data;
  data.vertices = {{-9, -9, 0}, {9, -9, 0}, {0, 9, 0},
                   {0, -5, -5}, {0, 5, -5}, {0, 0, 5}};
  data.corners = {0, 1, 2, 3, 4, 5};
  data.first_corner = {0, 3, 6};
  data.colors = {{200, 80, 40}, {40, 80, 200}};
  const auto scene = halfspace::make_scene(std::move(data));
  if (!scene) return EXIT_FAILURE;
  const auto view = halfspace::io::automatic_view(*scene, 64, 48);
  if (!view) return EXIT_FAILURE;
  const auto tree =
      halfspace::ref::build(*scene, {.rule = halfspace::RootRule::kFirst});
  const auto stats = halfspace::ref::stats(tree);
  const auto image = halfspace::ref::render(*scene, tree, view->camera, {});
  std::printf("%zu nodes, %zu fragments, %zu pixels\n", stats.nodes,
              stats.fragments, image.pixels_painted);
  const auto fast_tree =
      halfspace::fast::build(*scene, {.rule = halfspace::RootRule::kFirst});
  const auto fast_image =
      halfspace::fast::render(*scene, fast_tree, view->camera, {});
  const bool right =
      stats.nodes == 3 && stats.fragments == 3 && image.pixels_painted > 100 &&
      fast_image.items == image.items && fast_image.colors == image.colors;
  return right ? EXIT_SUCCESS : EXIT_FAILURE;
}
