// The fast library by itself: a tree of a triangle.
#include <halfspace/fast/build.hpp>
#include <halfspace/scene.hpp>
#include <utility>

int main() {
  halfspace::SceneData data;
  data.vertices = {{-9, -9, 0}, {9, -9, 0}, {0, 9, 0}};
  data.corners = {0, 1, 2};
  data.first_corner = {0, 3};
  data.colors = {{200, 80, 40}};
  const auto scene = halfspace::make_scene(std::move(data));
  return scene && halfspace::fast::build(*scene, {}).nodes.size() == 1 ? 0 : 1;
}
