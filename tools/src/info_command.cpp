#include <CLI/App.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>

#include "command.hpp"
#include "halfspace/boolean.hpp"
#include "halfspace/csg/closing.hpp"
#include "halfspace/csg/volume.hpp"
#include "loading.hpp"

namespace halfspace::tools {
namespace {

struct InfoArguments {
  std::string path;
  std::optional<int> grid_bits;
};

void print_polygons(const Scene& scene) {
  std::size_t least = SIZE_MAX;
  std::size_t most = 0;
  const auto count = static_cast<PolygonId>(scene.polygon_count());
  for (PolygonId p = 0; p < count; ++p) {
    least = std::min(least, scene.corners(p).size());
    most = std::max(most, scene.corners(p).size());
  }
  std::printf("polygons   %d", count);
  if (count > 0) std::printf(" of %zu to %zu corners", least, most);
  std::printf("\nvertices   %zu\n", scene.data().vertices.size());
  std::printf("colours    %s\n", scene.data().corner_colors.empty()
                                     ? "one a polygon"
                                     : "at the corners, and one a polygon");
}

void print_box(const Scene& scene) {
  const auto& vertices = scene.data().vertices;
  if (vertices.empty()) return;
  GridPoint low = vertices.front();
  GridPoint high = low;
  for (const GridPoint& v : vertices) {
    low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
    high = {std::max(high.x, v.x), std::max(high.y, v.y),
            std::max(high.z, v.z)};
  }
  const double step = std::pow(static_cast<double>(scene.unit().base),
                               static_cast<double>(scene.unit().exponent));
  const auto units = [step](std::int64_t steps) {
    return step * static_cast<double>(steps);
  };
  std::printf("from       %.9g, %.9g, %.9g\n", units(low.x), units(low.y),
              units(low.z));
  std::printf("to         %.9g, %.9g, %.9g\n", units(high.x), units(high.y),
              units(high.z));
}

void print_closedness(const Scene& scene) {
  const std::size_t bad = bad_edges(scene).size();
  const std::size_t added = bad == 0 ? 0 : csg::closed_on_lines(scene).added;
  if (bad != 0 && added == 0) {
    std::printf("surface    not closed: %zu bad edges\n", bad);
    return;
  }
  std::printf("surface    closed");
  if (added != 0)
    std::printf(", but for %zu corners where vertices lie within edges", added);
  std::printf("\nvolume     %s\n", csg::exact_volume(scene).c_str());
}

void print_camera(const SceneFile& file) {
  if (!file.camera) return;
  const CameraData& camera = file.camera->data();
  std::printf("camera     %s, %dx%d pixels\n",
              camera.perspective ? "perspective" : "orthographic",
              camera.width_px, camera.height_px);
}

Status run_info(const InfoArguments& arguments) {
  const Result<io::LoadedScene> loaded =
      io::load_scene(arguments.path, {.grid_bits = arguments.grid_bits});
  if (!loaded) return fail(arguments.path, loaded.error());
  const Scene& scene = loaded->file.scene;
  std::printf("file       %s\n", arguments.path.c_str());
  print_polygons(scene);
  std::printf("grid       %d bits of %s\n", scene.grid_bits(),
              io::to_string(scene.unit()).c_str());
  print_box(scene);
  if (!loaded->is_scene_file) {
    std::printf("mesh       %zu polygons, %zu vertices\n",
                loaded->report.polygons, loaded->report.vertices);
    std::printf("import     %s\n", to_string(loaded->report).c_str());
  }
  print_closedness(scene);
  print_camera(loaded->file);
  return Status::kFine;
}

}  // namespace

void add_info(CLI::App& program, Status& status) {
  CLI::App* app =
      program.add_subcommand("info",
                             "Tell what is in a file, and what import "
                             "did to it");
  const auto arguments = std::make_shared<InfoArguments>();
  app->add_option("FILE", arguments->path, "A mesh or a .scene")
      ->required()
      ->type_name("");
  add_grid_option(*app, arguments->grid_bits);
  app->footer(
      "Example:\n"
      "  halfspace info part.stl");
  app->callback([arguments, &status] { status = run_info(*arguments); });
}

}  // namespace halfspace::tools
