// Two things done with the installed libraries. An image of two crossing
// triangles: by the reference and by the fast library, whose image must be the
// same. And a cube cut by a plane: an expression, worked out by both.
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <halfspace/csg/outcome.hpp>
#include <halfspace/csg/plan.hpp>
#include <halfspace/csg/script.hpp>
#include <halfspace/fast/build.hpp>
#include <halfspace/fast/render.hpp>
#include <halfspace/io/view.hpp>
#include <halfspace/ref/build.hpp>
#include <halfspace/ref/render.hpp>
#include <halfspace/scene.hpp>
#include <utility>
#include <vector>

namespace {

/// The volume of what is left of a cube when its corner is taken away, if the
/// reference says the same; else a negative number.
double volume_without_corner() {
  std::ofstream("cube.off")
      << "OFF\n8 6 0\n"
         "0 0 0\n2 0 0\n0 2 0\n2 2 0\n0 0 2\n2 0 2\n0 2 2\n2 2 2\n"
         "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n";
  const std::vector<halfspace::csg::Binding> names = {{"A", "cube.off"}};
  const auto script =
      halfspace::csg::parse_script("A - translate(A, 1, 1, 1)", names);
  if (!script) return -1;
  const auto plan = halfspace::csg::make_plan(*script);
  if (!plan) return -1;
  auto operands = halfspace::csg::Operands::load(*script, *plan, {});
  if (!operands) return -1;
  const auto fast = halfspace::csg::evaluate_fast(*plan, *operands, {});
  const auto ref = halfspace::csg::evaluate_ref(*plan, *operands, {});
  if (!fast || !ref || (*fast)->volume.value() != (*ref)->volume.value())
    return -1;
  return (*fast)->volume.value();
}

}  // namespace

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
      fast_image.items == image.items && fast_image.colors == image.colors &&
      volume_without_corner() == 7;
  return right ? EXIT_SUCCESS : EXIT_FAILURE;
}
