#include <CLI/App.hpp>
#include <algorithm>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/long_work.hpp"
#include "cli/measuring.hpp"
#include "cli/options.hpp"
#include "cli/outputs.hpp"
#include "cli/uncut_loading.hpp"
#include "halfspace/viewer/state.hpp"
#include "image/film.hpp"
#include "image/object_film.hpp"
#include "image/rendering.hpp"
#include "image/shadowing.hpp"

namespace halfspace::tools {
namespace {

/// Says what was done, and writes that to --stats.
Status conclude(const io::LoadedScene& loaded, const BuildMeasure& tree,
                const Frame& frame, std::int64_t frames, double max_move,
                const Shadow& shadow, const RenderArguments& arguments) {
  const std::optional<std::string>& file = arguments.build.stats_file;
  if (file != "-") {
    print_summary(loaded, tree, frame, frames, arguments);
    if (arguments.shadow) say("{}\n", shadow.sentence());
    if (frame.picture.pixels_painted == 0)
      say("warning: the {} nothing: no polygon is seen\n",
          frames > 1 ? "last frame shows" : "picture shows");
  }
  if (!file) return shadow.status();
  nlohmann::json stats = stats_of(loaded, tree, frame, frames, arguments);
  stats["camera_max_move"] = max_move;
  shadow.add_to(stats);
  const Result<Done> written = write_stats(*file, stats);
  return written ? shadow.status() : fail(*file, written.error());
}

Status run_still(Engine& engine, const Subject& subject,
                 const RenderArguments& arguments) {
  const io::LoadedScene& loaded = subject.loaded;
  const Result<ChosenCamera> chosen =
      still_camera(loaded.file, subject.scalars, arguments);
  if (!chosen) return fail(camera_error(arguments.path, chosen.error()));
  BuildMeasure tree;
  const Status made = make_tree(engine, loaded.file.scene, arguments, tree);
  if (made != Status::kFine) return made;
  const Result<Frame> frame =
      make_frame(engine, subject, chosen->camera, arguments);
  if (!frame) return fail(frame.error().message);
  const Status written =
      write_frame(*frame, {arguments.picture_file, arguments.ids_file,
                           working_threads(arguments.build)});
  if (written != Status::kFine) return written;
  Shadow shadow(arguments);
  const Status checked = shadow.check(loaded, chosen->camera, *frame);
  if (checked != Status::kFine) return checked;
  return conclude(loaded, tree, *frame, 1, chosen->max_move, shadow, arguments);
}

/// What is wrong with the files that `pictures` writes, and those beside them.
std::string file_complaint(const RenderArguments& arguments,
                           const Outputs& pictures) {
  const std::string none;
  return complaint(
      std::array{
          NamedFile{"FILE", arguments.path},
          NamedFile{"--tree", arguments.tree_file.value_or(none)},
          NamedFile{"--path", arguments.camera_path_file.value_or(none)},
          NamedFile{"--scalar", arguments.scalars.source.value_or(none)}},
      std::array{
          NamedFile{"-o", pictures.picture_file.value_or(none)},
          NamedFile{"--ids", pictures.ids_file.value_or(none)},
          NamedFile{"--stats", arguments.build.stats_file.value_or(none)},
          NamedFile{"--shadow-scene",
                    arguments.shadow ? arguments.shadow_file : none}});
}

Status run_film(Engine& engine, const Subject& subject,
                const RenderArguments& arguments) {
  const io::LoadedScene& loaded = subject.loaded;
  const Result<CameraPath> path =
      film_path(loaded.file, subject.scalars, arguments);
  if (!path) return fail(path.error().message);
  if (!path->objects().empty()) {
    return fail(*arguments.camera_path_file + ": there is no object " +
                *path->objects().begin() + " in " + arguments.path);
  }
  const Result<Range> frames = frames_of(*path, arguments);
  if (!frames) return fail(frames.error().message);
  const std::string uncut =
      clip_complaint(*path, *frames, loaded.file.scene, arguments.clip);
  if (!uncut.empty()) return fail(uncut);
  for (std::int64_t k = *frames->first; k < *frames->end; ++k) {
    const std::string wrong =
        file_complaint(arguments, outputs_of(arguments, k));
    if (!wrong.empty()) return fail(wrong);
  }
  BuildMeasure tree;
  const Status made = make_tree(engine, loaded.file.scene, arguments, tree);
  if (made != Status::kFine) return made;
  const std::int64_t first = *frames->first;
  const std::int64_t count = *frames->end - first;
  std::vector<double> times_ms;
  double max_move = 0;
  Frame last;
  Shadow shadow(arguments);
  LongWork work("frames");
  for (std::int64_t k = 0; k < count; ++k) {
    const std::string name = "frame " + std::to_string(first + k);
    const double done = static_cast<double>(k) / static_cast<double>(count);
    if (!work.report(done)) return stop("interrupted before " + name);
    const Result<ChosenCamera> chosen =
        frame_camera(loaded.file, *path, first + k, arguments);
    if (!chosen)
      return fail(name + ": " + camera_error(arguments.path, chosen.error()));
    RenderArguments now = arguments;
    now.clip = path->clip_at(first + k, arguments.clip);
    Result<Frame> frame = make_frame(engine, subject, chosen->camera, now);
    if (!frame) return fail(name + ": " + frame.error().message);
    const Status written =
        write_frame(*frame, outputs_of(arguments, first + k));
    if (written != Status::kFine) return written;
    const Status checked = shadow.check(loaded, chosen->camera, *frame);
    if (checked != Status::kFine) return checked;
    times_ms.push_back(frame->frame_ms);
    max_move = std::max(max_move, chosen->max_move);
    last = *std::move(frame);
  }
  last.frame_ms = median(std::move(times_ms));
  return conclude(loaded, tree, last, count, max_move, shadow, arguments);
}

/// The lines that a state asks for, in its colour.
void add_lines_of(const viewer::State& state, LineArguments& lines) {
  switch (state.looks.lines) {
    case viewer::Lines::kNone:
      return;
    case viewer::Lines::kOutline:
      lines.edges = ShownEdges::kOutline;
      break;
    case viewer::Lines::kFeatures:
      lines.edges = ShownEdges::kFeatures;
      break;
    case viewer::Lines::kWire:
      lines.edges = ShownEdges::kWire;
      break;
  }
  if (!lines.color) lines.color = viewer::line_color_of(state);
}

/// The arguments with what a `.view` file says that a scene does not hold.
Result<RenderArguments> with_view_file(const RenderArguments& arguments) {
  RenderArguments all = arguments;
  if (!viewer::is_view_name(arguments.path)) return all;
  const auto state = viewer::read_state(arguments.path);
  if (!state) return state.error();
  all.own_view = state->camera;
  if (!all.lines.edges) add_lines_of(*state, all.lines);
  if (!all.alpha && state->looks.alpha != kOpaque)
    all.alpha = state->looks.alpha;
  if (arguments.scalars.source) return all;
  if (!all.back_color) all.back_color = viewer::back_color_of(*state);
  if (!state->looks.scalar || state->parts.empty()) return all;
  const viewer::ScalarLook& look = *state->looks.scalar;
  all.scalars.source = look.source;
  all.scalars.owner = state->parts.front().path;
  all.scalars.map = look.map;
  all.scalars.range = look.range;
  all.scalars.logarithmic = look.is_logarithmic;
  if (look.steps > 0) all.scalars.steps = look.steps;
  all.scalars.has_legend = look.has_legend;
  return all;
}

Status run_render(const RenderArguments& given) {
  const Result<RenderArguments> with_view = with_view_file(given);
  if (!with_view) return fail(given.path, with_view.error());
  RenderArguments arguments = *with_view;
  // What hides all behind it is opaque, by whatever method.
  if (arguments.alpha == kOpaque) arguments.alpha.reset();
  const std::unique_ptr<Engine> engine = make_engine(library_of(arguments));
  std::string wrong = complaint(arguments, *engine);
  if (wrong.empty()) {
    wrong =
        file_complaint(arguments, {arguments.picture_file, arguments.ids_file});
  }
  if (!wrong.empty()) return fail(wrong);
  if (io::has_extension(arguments.path, ".objects"))
    return render_objects(arguments);
  io::ImportOptions options =
      import_options(arguments.view, arguments.grid_bits);
  if (arguments.scalars.source) color_by_scalars(options);
  Result<io::LoadedScene> loaded = load_uncut(arguments.path, options);
  if (!loaded) return fail(arguments.path, loaded.error());
  if (loaded->is_scene_file && changes_colors(arguments.view))
    return fail(arguments.path +
                ": a scene has its own colours; --color, --light, --headlight, "
                "--ambient and --smooth are for meshes");
  // The planes of a film may be its path's.
  if (!arguments.camera_path_file)
    wrong = cut_complaint(arguments.clip, arguments.view.near);
  if (wrong.empty()) wrong = prepare_caps(loaded->file, arguments.clip);
  if (!wrong.empty()) return fail(wrong);
  Subject subject{*loaded};
  if (arguments.scalars.source) {
    Result<ShownScalars> scalars =
        load_scalars(arguments.scalars.owner.value_or(arguments.path), *loaded,
                     arguments.scalars);
    if (!scalars) return fail(scalars.error().message);
    engine->set_scalars(loaded->file.scene, scalars->field,
                        scalars->legend.scale);
    subject.scalars = *std::move(scalars);
  }
  progress(engine->warning(loaded->file.scene.polygon_count()));
  return arguments.camera_path_file || arguments.turntable
             ? run_film(*engine, subject, arguments)
             : run_still(*engine, subject, arguments);
}

constexpr const char* kRangeForm =
    "A:B, A: or :B, from A up to but not including B";

void add_film_options(CLI::App& app, RenderArguments& arguments) {
  const std::string group = "Film and cluster";
  app.add_option("--path", arguments.camera_path_file,
                 "The way of the camera: lines such as `0 eye 9,0,2 target "
                 "0,0,0`, a frame's number and its camera; between two lines "
                 "it moves evenly. -o and --ids name each frame: "
                 "frame-%05d.png")
      ->type_name("FILE")
      ->group(group);
  add_number(app, "--turntable", "N", arguments.turntable, 2u, 1'000'000u,
             "A film of N frames once round the model, about the vertical or "
             "--up, beginning at --eye, --orbit or --view, or at the file's "
             "own camera")
      ->excludes("--path")
      ->group(group);
  add_parsed(app, "--frames", "A:B", kRangeForm, arguments.frames, parse_range,
             "Only the frames from A up to but not including B")
      ->group(group);
  add_parsed(app, "--rows", "A:B", kRangeForm, arguments.rows, parse_range,
             "Only the rows from A up to but not including B, counted from "
             "the top; `halfspace join` puts them together")
      ->group(group);
}

void add_tree_options(CLI::App& app, RenderArguments& arguments) {
  add_build_options(app, arguments.build,
                    "fast for span and painter, ref for zbuffer and raycast, "
                    "which fast does not have");
  app.add_option("--tree", arguments.tree_file,
                 "The tree that `build -o` saved, instead of building one")
      ->type_name("FILE.tree")
      ->group("Tree");
  app.add_flag("--lazy", arguments.lazy,
               "Build of the tree what images come to, as they do: the first "
               "one is there sooner. The same bytes")
      ->group("Tree");
}

void add_shadow_options(CLI::App& app, RenderArguments& arguments) {
  const std::string group = "Assurance";
  add_share(app, "--shadow", arguments.shadow,
            "Check this share of the pixels against the reference; exit "
            "status 1, and a scene that shows it, if one is wrong")
      ->envname("HALFSPACE_SHADOW")
      ->group(group);
  app.add_option("--shadow-scene", arguments.shadow_file, "That scene")
      ->envname("HALFSPACE_SHADOW_SCENE")
      ->type_name("FILE.scene")
      ->capture_default_str()
      ->group(group);
}

}  // namespace

void add_render(CLI::App& program, Status& status) {
  CLI::App* app = program.add_subcommand("render", "Make an image of a file");
  const auto arguments = std::make_shared<RenderArguments>();
  app->add_option("FILE", arguments->path,
                  "A mesh, a .scene, or .objects that move")
      ->required()
      ->type_name("");
  app->add_option("-o,--output", arguments->picture_file, "The picture")
      ->type_name("FILE.png");
  app->add_option("--ids", arguments->ids_file,
                  "The polygon seen at each pixel, -1 for none, as a NumPy "
                  "array of int32")
      ->type_name("FILE.npy");
  add_choice(*app, "--method", kMethodWords, arguments->method,
             "Span buffer, front to back (usual); painter's algorithm, back "
             "to front; z-buffer; ray casting. All give the same image");
  add_choice(*app, "--screen", kScreenWords, arguments->screen,
             "What keeps the unlit part of the image of --method span: F2B's "
             "lists, a 1-D BSP tree a line, a quadtree, or a 2-D BSP tree of "
             "the edges' images. All give the same image; the usual screen of "
             "tiles is quicker");
  add_choice(*app, "--priority", kPriorityWords, arguments->priority,
             "What orders the polygons of --method span and painter: the BSP "
             "tree (usual), or Newell, Newell and Sancha's depth sort, which "
             "sorts every frame anew. Both give the same image");
  add_grid_option(*app, arguments->grid_bits);
  add_view_options(*app, arguments->view);
  add_clip_options(*app, arguments->clip);
  add_scalar_options(*app, arguments->scalars);
  add_line_options(*app, arguments->lines);
  add_number(*app, "--alpha", "A", arguments->alpha, std::uint8_t{0}, kOpaque,
             "Blend the polygons, from the farthest to the nearest: 0 is not "
             "seen, 255 hides what is behind. By the painter's algorithm")
      ->group("Picture");
  add_back_color_option(*app, arguments->back_color)->group("Picture");
  add_choice(*app, "--aa", kAntiAliasingWords, arguments->anti_aliasing,
             "Anti-aliasing: a pixel's colour is the exact mean of so many "
             "samples each way, or of all that is seen in it; --ids then has "
             "an entry a sample")
      ->group("Picture");
  add_film_options(*app, *arguments);
  add_tree_options(*app, *arguments);
  add_number(*app, "--repeat", "N", arguments->repeat, 1u, 1'000'000u,
             "Make the image, and check it, N times; times are medians")
      ->group("Measurement");
  add_choice(*app, "--simd", kSimdWords, arguments->simd,
             "Instruction set of the fast library's loops; best if not said. "
             "All give the same bytes")
      ->group("Measurement");
  add_shadow_options(*app, *arguments);
  add_quiet_option(*app);
  app->footer(
      "Examples:\n"
      "  halfspace render part.stl -o part.png\n"
      "  halfspace render part.stl -o part.png --size 1500x1500 --shade "
      "gouraud\n"
      "  halfspace render part.stl -o top.png --eye 0,0,9 --target 0,0,0 "
      "--ortho\n"
      "  halfspace render part.stl -o glass.png --alpha 80\n"
      "  halfspace render part.stl -o smooth.png --aa 4\n"
      "  halfspace render part.stl -o cut.png --clip 0,1,0,-5 --cap hatch\n"
      "  halfspace render scan.ply -o heat.png --scalar quality --map heated "
      "--legend\n"
      "  halfspace render part.stl -o frame-%05d.png --path tour.txt "
      "--frames 0:100\n"
      "  halfspace render part.stl --ids a.npy --method painter\n"
      "  halfspace render part.stl --ids b.npy --method zbuffer\n"
      "  halfspace compare a.npy b.npy");
  app->callback([arguments, &status] { status = run_render(*arguments); });
}

}  // namespace halfspace::tools
