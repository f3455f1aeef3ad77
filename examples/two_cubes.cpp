// The three booleans of two cubes that overlap in an eighth, and their volumes.
//
//   two_cubes OUT.off    writes the difference
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "halfspace/boolean.hpp"
#include "halfspace/io/write_mesh.hpp"
#include "halfspace/ref/boolean.hpp"

using namespace halfspace;

namespace {

/// The cube from `low` to `low + 2` on every axis, faces outwards.
Result<GridSolid> cube_at(std::int64_t low) {
  SceneData data;
  for (int i = 0; i < 8; ++i) {
    data.vertices.push_back(
        {low + 2 * (i & 1), low + 2 * (i >> 1 & 1), low + 2 * (i >> 2 & 1)});
  }
  data.corners = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4,
                  2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
  data.first_corner = {0, 4, 8, 12, 16, 20, 24};
  data.colors.assign(6, low == 0 ? Rgb{200, 80, 40} : Rgb{40, 80, 200});
  Result<Scene> scene = make_scene(std::move(data));
  if (!scene) return scene.error();
  return make_solid(*std::move(scene));
}

bool has_volume(BooleanOp operation, const GridSolid& a, const GridSolid& b,
                int volume) {
  const ref::Solid result =
      ref::boolean(operation, ref::to_solid(a), ref::to_solid(b));
  return ref::bad_edges(result).empty() && ref::volume6(result) == 6 * volume;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return EXIT_FAILURE;
  const Result<GridSolid> a = cube_at(0);
  const Result<GridSolid> b = cube_at(1);
  if (!a || !b) return EXIT_FAILURE;
  const bool right = has_volume(BooleanOp::kUnion, *a, *b, 15) &&
                     has_volume(BooleanOp::kIntersection, *a, *b, 1) &&
                     has_volume(BooleanOp::kDifference, *a, *b, 7);
  ref::RoundedSolid rounded =
      ref::rounded(ref::boolean(BooleanOp::kDifference, ref::to_solid(*a),
                                ref::to_solid(*b)),
                   a->scene().unit());
  const auto written = io::write_mesh(
      argv[1], {std::move(rounded.vertices), std::move(rounded.first_corner),
                std::move(rounded.corners), std::move(rounded.colors)});
  std::printf("volumes %s\n", right ? "15, 1 and 7" : "are wrong");
  return right && written ? EXIT_SUCCESS : EXIT_FAILURE;
}
