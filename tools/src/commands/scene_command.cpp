#include <CLI/App.hpp>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "cli/command.hpp"
#include "cli/loading.hpp"
#include "cli/outputs.hpp"
#include "halfspace/scene_file.hpp"
#include "image/viewing.hpp"

namespace halfspace::tools {
namespace {

struct SceneArguments {
  std::string path;
  std::string output;
  std::optional<int> grid_bits;
  bool no_camera = false;
  ViewArguments view;
};

Status run_scene(const SceneArguments& arguments) {
  const std::string wrong =
      complaint(std::array{NamedFile{"FILE", arguments.path}},
                std::array{NamedFile{"-o", arguments.output}});
  if (!wrong.empty()) return fail(wrong);
  Result<io::LoadedScene> loaded =
      load(arguments.path, import_options(arguments.view, arguments.grid_bits));
  if (!loaded) return fail(arguments.path, loaded.error());
  if (loaded->is_scene_file && changes_colors(arguments.view))
    return fail(arguments.path +
                ": a scene has its own colours; --color and lights are for "
                "meshes");
  SceneFile file = std::move(loaded->file);
  file.options = choose_options(file, arguments.view);
  if (arguments.no_camera) {
    file.camera.reset();
  } else {
    const Result<ChosenCamera> chosen = choose_camera(file, arguments.view);
    if (!chosen) return fail(camera_error(arguments.path, chosen.error()));
    file.camera = chosen->camera;
  }
  const Result<Done> written =
      write_output(arguments.output, write_scene(file));
  if (!written) return fail(arguments.output, written.error());
  if (arguments.output != "-") {
    say("{}: {} polygons; {}\n", arguments.path, file.scene.polygon_count(),
        to_string(loaded->report));
  }
  return Status::kFine;
}

}  // namespace

void add_scene(CLI::App& program, Status& status) {
  CLI::App* app = program.add_subcommand(
      "scene", "Write the exact scene, and the camera, as text");
  const auto arguments = std::make_shared<SceneArguments>();
  app->add_option("FILE", arguments->path, "A mesh or a .scene")
      ->required()
      ->type_name("");
  app->add_option("-o,--output", arguments->output, "The scene")
      ->required()
      ->type_name("OUT.scene");
  app->add_flag("--no-camera", arguments->no_camera,
                "Write the scene alone; else the camera is the one that "
                "`render` would use");
  add_grid_option(*app, arguments->grid_bits);
  add_view_options(*app, arguments->view);
  add_quiet_option(*app);
  app->footer(
      "`halfspace render OUT.scene` gives the image that `render FILE` gives "
      "with the\nsame options. spec/scene-format.md describes the file.\n\n"
      "Examples:\n"
      "  halfspace scene part.stl -o part.scene\n"
      "  halfspace scene part.stl -o part.scene --eye 3,2,1 --size 64x64");
  app->callback([arguments, &status] { status = run_scene(*arguments); });
}

}  // namespace halfspace::tools
