#include <CLI/App.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "building.hpp"
#include "command.hpp"
#include "engine.hpp"
#include "loading.hpp"

namespace halfspace::tools {
namespace {

struct Arguments {
  std::string path;
  std::optional<int> grid_bits;
  BuildArguments build;
};

Status run(const Arguments& arguments) {
  const std::unique_ptr<Engine> engine =
      make_engine(static_cast<Library>(arguments.build.library));
  const Result<Loaded> loaded =
      load(arguments.path, {.grid_bits = arguments.grid_bits});
  if (!loaded) return fail(arguments.path, loaded.error());
  const Scene& scene = loaded->file.scene;
  progress(engine->warning(scene.polygon_count()));
  const BuildMeasure measure = build_measured(*engine, scene, arguments.build);
  if (arguments.build.stats_file != "-") {
    std::printf("%s: %zu polygons; %s\n", arguments.path.c_str(),
                scene.polygon_count(), to_string(loaded->report).c_str());
    std::printf("tree: %s\n", to_string(measure).c_str());
  }
  if (arguments.build.stats_file) {
    const Result<Done> written =
        write_stats(*arguments.build.stats_file,
                    stats_of(*loaded, measure, arguments.build));
    if (!written) return fail(*arguments.build.stats_file, written.error());
  }
  return Status::kFine;
}

}  // namespace

void add_build(CLI::App& program, Status& status) {
  CLI::App* app =
      program.add_subcommand("build", "Build a tree, tell its size");
  const auto arguments = std::make_shared<Arguments>();
  app->add_option("FILE", arguments->path, "A mesh or a .scene")
      ->required()
      ->type_name("");
  add_grid_option(*app, arguments->grid_bits);
  add_build_options(*app, arguments->build);
  app->footer(
      "Examples:\n"
      "  halfspace build part.stl\n"
      "  halfspace build part.stl --heuristic h3 --stats -\n"
      "  halfspace build part.stl --candidates 15 --seed 7");
  app->callback([arguments, &status] { status = run(*arguments); });
}

}  // namespace halfspace::tools
