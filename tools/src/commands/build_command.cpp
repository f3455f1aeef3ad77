#include <CLI/App.hpp>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/command.hpp"
#include "cli/loading.hpp"
#include "cli/options.hpp"
#include "cli/outputs.hpp"
#include "image/building.hpp"
#include "image/engine.hpp"
#include "image/viewing.hpp"

namespace halfspace::tools {
namespace {

struct BuildCommandArguments {
  std::string path;
  std::optional<std::string> tree_file;
  std::optional<int> grid_bits;
  Shading shading = Shading::kFlat;
  BuildArguments build;
};

constexpr Word<Shading> kShadingWords[] = {{"flat", Shading::kFlat},
                                           {"gouraud", Shading::kGouraud}};

/// As `render` does, so that a saved tree is one of the same scene.
io::ImportOptions import_options_of(const BuildCommandArguments& arguments) {
  ViewArguments view;
  view.shading = arguments.shading;
  return import_options(view, arguments.grid_bits);
}

std::string complaint(const BuildCommandArguments& arguments) {
  return complaint(
      std::array{NamedFile{"FILE", arguments.path}},
      std::array{
          NamedFile{"-o", arguments.tree_file.value_or("")},
          NamedFile{"--stats", arguments.build.stats_file.value_or("")}});
}

Status run_build(const BuildCommandArguments& arguments) {
  const std::string wrong = complaint(arguments);
  if (!wrong.empty()) return fail(wrong);
  const Library library = library_of(arguments.build, Library::kFast);
  const std::unique_ptr<Engine> engine = make_engine(library);
  if (arguments.tree_file && !engine->has_tree_files()) {
    return fail("--impl ref: saves no trees; leave --impl or -o out");
  }
  const Result<io::LoadedScene> loaded =
      load(arguments.path, import_options_of(arguments));
  if (!loaded) return fail(arguments.path, loaded.error());
  const Scene& scene = loaded->file.scene;
  progress(engine->warning(scene.polygon_count()));
  const std::optional<BuildMeasure> measure =
      build_measured(*engine, library, scene, arguments.build, /*leaves=*/true);
  if (!measure) return stop("interrupted; no tree was made");
  if (arguments.build.stats_file != "-") {
    say("{}: {} polygons; {}\n", arguments.path, scene.polygon_count(),
        to_string(loaded->report));
    say("tree: {}\n", to_string(*measure, scene.polygon_count()));
  }
  if (arguments.tree_file) {
    const Result<Done> saved = engine->save_tree(*arguments.tree_file, scene);
    if (!saved) return fail(*arguments.tree_file, saved.error());
  }
  if (arguments.build.stats_file) {
    const Result<Done> written =
        write_stats(*arguments.build.stats_file, stats_of(*loaded, *measure));
    if (!written) return fail(*arguments.build.stats_file, written.error());
  }
  return Status::kFine;
}

}  // namespace

void add_build(CLI::App& program, Status& status) {
  CLI::App* app =
      program.add_subcommand("build", "Build a tree, tell its size");
  const auto arguments = std::make_shared<BuildCommandArguments>();
  app->add_option("FILE", arguments->path, "A mesh or a .scene")
      ->required()
      ->type_name("");
  app->add_option("-o,--output", arguments->tree_file,
                  "Save the tree, for `render --tree`; fast only")
      ->type_name("OUT.tree");
  add_grid_option(*app, arguments->grid_bits);
  add_choice(*app, "--shade", kShadingWords, arguments->shading,
             "Import the mesh as `render` does with this: gouraud makes "
             "triangles of what has colours at its corners");
  add_build_options(*app, arguments->build, "fast");
  add_quiet_option(*app);
  app->footer(
      "Examples:\n"
      "  halfspace build part.stl\n"
      "  halfspace build part.stl --heuristic h3 --stats -\n"
      "  halfspace build part.stl --candidates 15 --seed 7\n"
      "  halfspace build part.stl -o part.tree\n"
      "  halfspace render part.stl --tree part.tree -o part.png");
  app->callback([arguments, &status] { status = run_build(*arguments); });
}

}  // namespace halfspace::tools
