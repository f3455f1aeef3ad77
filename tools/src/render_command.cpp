#include <CLI/App.hpp>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "building.hpp"
#include "command.hpp"
#include "engine.hpp"
#include "halfspace/io/picture.hpp"
#include "loading.hpp"
#include "measuring.hpp"
#include "viewing.hpp"

namespace halfspace::tools {
namespace {

struct Arguments {
  std::string path;
  std::optional<std::string> picture_file;
  std::optional<std::string> ids_file;
  std::optional<std::string> tree_file;
  std::size_t method = 0;
  std::optional<std::uint32_t> repeat;
  std::optional<int> grid_bits;
  ViewArguments view;
  BuildArguments build;
};

/// A picture, the tree it came from, and what both took.
struct Frame {
  Picture picture;
  BuildMeasure tree;
  double frame_ms = 0;  ///< median of the repeats
};

bool is_png_name(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) {
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return extension == ".png";
}

/// The library that makes images this way: the fast one if it can.
Library library_of(const Arguments& arguments) {
  const auto method = static_cast<Method>(arguments.method);
  return library_of(arguments.build,
                    needs_tree(method) ? Library::kFast : Library::kRef);
}

/// What is wrong with the options taken together; empty if nothing.
std::string complaint(const Arguments& arguments, const Engine& engine) {
  if (!arguments.picture_file && !arguments.ids_file &&
      !arguments.build.stats_file) {
    return "render: nothing to write; give -o, --ids or --stats";
  }
  if (arguments.picture_file && !is_png_name(*arguments.picture_file)) {
    return *arguments.picture_file + ": pictures are written as .png";
  }
  const auto method = static_cast<Method>(arguments.method);
  if (!engine.has(method)) {
    return "--impl fast: makes images by span or painter; use --impl ref for "
           "--method " +
           method_words()[arguments.method];
  }
  if (!arguments.tree_file) return {};
  if (!needs_tree(method)) {
    return "--tree: --method " + method_words()[arguments.method] +
           " needs no tree";
  }
  if (!engine.has_tree_files()) return "--tree: --impl ref reads no trees";
  return {};
}

/// The tree that the method needs, built or loaded; none where it needs none.
Status make_tree(Engine& engine, const Scene& scene, const Arguments& arguments,
                 BuildMeasure& tree) {
  const auto method = static_cast<Method>(arguments.method);
  const Library library = library_of(arguments);
  tree.library = library_words()[static_cast<std::size_t>(library)];
  if (!needs_tree(method)) return Status::kFine;
  const bool leaves = method == Method::kSpan;
  if (arguments.tree_file) {
    const std::string& path = *arguments.tree_file;
    Result<BuildMeasure> loaded =
        load_measured(engine, library, scene, path, leaves);
    if (!loaded) return fail(path, loaded.error());
    tree = *std::move(loaded);
    return Status::kFine;
  }
  std::optional<BuildMeasure> built =
      build_measured(engine, library, scene, arguments.build, leaves);
  if (!built) return stop("interrupted; nothing was written");
  tree = *std::move(built);
  progress("tree: " + to_string(tree, scene.polygon_count()));
  return Status::kFine;
}

Shot shot_of(const Loaded& loaded, const Arguments& arguments) {
  Shot shot;
  shot.method = static_cast<Method>(arguments.method);
  shot.options = choose_options(loaded.file, arguments.view);
  shot.threads = thread_count(arguments.build);
  return shot;
}

void make_picture(const Engine& engine, const Scene& scene,
                  const Camera& camera, const Shot& shot, std::uint32_t repeats,
                  Frame& frame) {
  std::vector<double> times_ms;
  for (std::uint32_t i = 0; i < repeats; ++i) {
    const Stopwatch watch;
    frame.picture = engine.render(scene, camera, shot);
    times_ms.push_back(watch.elapsed_ms());
  }
  frame.frame_ms = median(std::move(times_ms));
}

nlohmann::json stats_of(const Loaded& loaded, const ChosenCamera& chosen,
                        const Frame& frame, const Arguments& arguments) {
  nlohmann::json stats = stats_of(loaded, frame.tree);
  stats["method"] = method_words()[arguments.method];
  stats["threads"] = thread_count(arguments.build);
  stats["width_px"] = frame.picture.items.width_px;
  stats["height_px"] = frame.picture.items.height_px;
  stats["frame_ms"] = frame.frame_ms;
  stats["repeats"] = arguments.repeat.value_or(1);
  stats["pixels_painted"] = frame.picture.pixels_painted;
  stats["fragments_displayed"] = frame.picture.fragments_displayed;
  stats["camera_max_move"] = chosen.max_move;
  return stats;
}

/// Says what was done, line by line, on standard output.
void print_summary(const Loaded& loaded, const Frame& frame,
                   const Arguments& arguments) {
  const std::size_t polygons = loaded.file.scene.polygon_count();
  std::printf("%s: %zu polygons; %s\n", arguments.path.c_str(), polygons,
              to_string(loaded.report).c_str());
  if (needs_tree(static_cast<Method>(arguments.method))) {
    std::printf("tree: %s\n", to_string(frame.tree, polygons).c_str());
  }
  std::printf("%s: %dx%d, %zu pixels painted, %.3f ms (%s)\n",
              method_words()[arguments.method].c_str(),
              frame.picture.items.width_px, frame.picture.items.height_px,
              frame.picture.pixels_painted, frame.frame_ms,
              frame.tree.library.c_str());
}

Status write_results(const Loaded& loaded, const ChosenCamera& chosen,
                     const Frame& frame, const Arguments& arguments) {
  if (arguments.picture_file) {
    const Result<Done> written =
        io::write_png(*arguments.picture_file, frame.picture.colors);
    if (!written) return fail(*arguments.picture_file, written.error());
  }
  if (arguments.ids_file) {
    const Result<Done> written =
        io::write_npy(*arguments.ids_file, frame.picture.items);
    if (!written) return fail(*arguments.ids_file, written.error());
  }
  if (arguments.build.stats_file) {
    const Result<Done> written =
        write_stats(*arguments.build.stats_file,
                    stats_of(loaded, chosen, frame, arguments));
    if (!written) return fail(*arguments.build.stats_file, written.error());
  }
  return Status::kFine;
}

Status run(const Arguments& arguments) {
  const std::unique_ptr<Engine> engine = make_engine(library_of(arguments));
  const std::string wrong = complaint(arguments, *engine);
  if (!wrong.empty()) return fail(wrong);
  const Result<Loaded> loaded =
      load(arguments.path, import_options(arguments.view, arguments.grid_bits));
  if (!loaded) return fail(arguments.path, loaded.error());
  const Scene& scene = loaded->file.scene;
  const Result<ChosenCamera> chosen =
      choose_camera(loaded->file, arguments.view);
  if (!chosen) return fail(arguments.path, chosen.error());
  progress(engine->warning(scene.polygon_count()));
  Frame frame;
  const Status made = make_tree(*engine, scene, arguments, frame.tree);
  if (made != Status::kFine) return made;
  make_picture(*engine, scene, chosen->camera, shot_of(*loaded, arguments),
               arguments.repeat.value_or(1), frame);
  if (arguments.build.stats_file != "-") {
    print_summary(*loaded, frame, arguments);
  }
  return write_results(*loaded, *chosen, frame, arguments);
}

}  // namespace

void add_render(CLI::App& program, Status& status) {
  CLI::App* app = program.add_subcommand("render", "Make an image of a file");
  const auto arguments = std::make_shared<Arguments>();
  app->add_option("FILE", arguments->path, "A mesh or a .scene")
      ->required()
      ->type_name("");
  app->add_option("-o,--output", arguments->picture_file, "The picture")
      ->type_name("FILE.png");
  app->add_option("--ids", arguments->ids_file,
                  "The polygon seen at each pixel, -1 for none, as a NumPy "
                  "array of int32")
      ->type_name("FILE.npy");
  add_choice(*app, "--method", method_words(), arguments->method,
             "Span buffer, front to back (usual); painter's algorithm, back "
             "to front; z-buffer; ray casting. All give the same image");
  add_grid_option(*app, arguments->grid_bits);
  add_view_options(*app, arguments->view);
  add_build_options(*app, arguments->build,
                    "fast for span and painter, ref for zbuffer and raycast, "
                    "which fast does not have");
  app->add_option("--tree", arguments->tree_file,
                  "The tree that `build -o` saved, instead of building one")
      ->type_name("FILE.tree")
      ->group("Tree");
  add_parsed(*app, "--repeat", "N", arguments->repeat, parse_count,
             "Make the image N times; frame_ms is the median")
      ->group("Measurement");
  app->footer(
      "Examples:\n"
      "  halfspace render part.stl -o part.png\n"
      "  halfspace render part.stl -o part.png --size 1500x1500 --shade "
      "gouraud\n"
      "  halfspace render part.stl -o top.png --eye 0,0,9 --target 0,0,0 "
      "--ortho\n"
      "  halfspace render part.stl --ids a.npy --method painter\n"
      "  halfspace render part.stl --ids b.npy --method zbuffer\n"
      "  halfspace compare a.npy b.npy");
  app->callback([arguments, &status] { status = run(*arguments); });
}

}  // namespace halfspace::tools
