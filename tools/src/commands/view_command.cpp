#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/options.hpp"
#include "halfspace/image.hpp"
#include "halfspace/viewer/run.hpp"
#include "halfspace/viewer/state.hpp"
#include "image/scalars.hpp"
#include "image/viewing.hpp"

namespace halfspace::tools {
namespace {

struct ViewCommandArguments {
  std::vector<std::string> paths;
  ViewArguments view;
  ScalarArguments scalars;
  std::optional<std::uint8_t> alpha;
  std::optional<Rgb> back_color;
  std::optional<double> scale;
  bool watch = false;
  std::optional<std::string> play_file;
  std::optional<std::string> dump_name;
  std::optional<std::string> record_file;
};

#ifdef HALFSPACE_HAS_VIEWER

/// Where nothing is said, a picture on a screen is on grey paper.
constexpr Rgb kScreenPaper = {232, 236, 241};

/// The state of files and options; a `.view` file brings its own.
Result<viewer::State> state_of(const ViewCommandArguments& arguments) {
  viewer::State state;
  state.looks.background = kScreenPaper;
  for (const std::string& path : arguments.paths) {
    if (!viewer::is_view_name(path)) {
      state.parts.push_back({path, true, arguments.view.surface, {}});
      continue;
    }
    if (arguments.paths.size() > 1)
      return Error{ErrorCode::kBadIndex,
                   path + ": a view is opened alone, without other files"};
    const auto read = viewer::read_state(path);
    if (!read) return read.error();
    state = *read;
  }
  viewer::Looks& looks = state.looks;
  const ViewArguments& view = arguments.view;
  if (view.shading) looks.is_smooth = *view.shading == Shading::kGouraud;
  looks.cull = view.cull.value_or(looks.cull);
  if (view.background) looks.background = view.background->color;
  if (!view.lights.empty()) looks.light = view.lights.front().to_light;
  if (view.ambient) looks.ambient = view.ambient;
  if (arguments.back_color) looks.back_color = arguments.back_color;
  looks.alpha = arguments.alpha.value_or(looks.alpha);
  const ScalarArguments& scalars = arguments.scalars;
  if (scalars.source) {
    looks.scalar = viewer::ScalarLook{*scalars.source,
                                      scalars.map,
                                      scalars.range,
                                      scalars.logarithmic,
                                      scalars.steps.value_or(0),
                                      scalars.has_legend};
  }
  return state;
}

/// Runs this program again: `draw` is a command of its own.
Result<Done> draw_figure(const std::string& view_file,
                         const std::string& output) {
  std::string words[] = {"halfspace", "draw",    view_file, "-o",
                         output,      "--lines", "edges",   "--quiet"};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t child = 0;
  if (posix_spawn(&child, "/proc/self/exe", nullptr, nullptr, arguments.data(),
                  environ) != 0)
    return Error{ErrorCode::kUnwritable, output + ": the drawing cannot start"};
  int status = 0;
  if (waitpid(child, &status, 0) != child || status != 0)
    return Error{ErrorCode::kUnwritable,
                 output + ": the drawing failed; `halfspace draw` says why"};
  return Done{};
}

Status run_view(const ViewCommandArguments& arguments) {
  const auto state = state_of(arguments);
  if (!state) return fail(state.error().message);
  viewer::WindowOptions options;
  options.state = *state;
  options.first_view = [&arguments](const Scene& scene, std::int32_t width_px,
                                    std::int32_t height_px) {
    ViewArguments view = arguments.view;
    view.size = Size{width_px, height_px};
    return complete_view(scene, view);
  };
  if (const auto& size = arguments.view.size)
    options.picture_px = {size->width_px, size->height_px};
  else if (state->camera)
    options.picture_px = {state->camera->width_px, state->camera->height_px};
  options.draw_figure = draw_figure;
  options.scale = arguments.scale.value_or(0);
  options.watch = arguments.watch;
  options.headlight = arguments.view.headlight;
  options.play_file = arguments.play_file;
  options.dump_name = arguments.dump_name;
  options.record_file = arguments.record_file;
  const auto report = viewer::run(options);
  if (!report) return fail(report.error().message);
  if (arguments.play_file) {
    say("{} events, {} pictures, the median {:.1f} ms; window after {:.0f} ms; "
        "longest time without a look at the input {:.1f} ms, {:.1f} ms of the "
        "processor\n",
        report->events, report->frames, report->median_frame_ms,
        report->first_window_ms, report->longest_block_ms,
        report->longest_work_ms);
  }
  return Status::kFine;
}

#else

Status run_view(const ViewCommandArguments&) {
  return fail(
      "this build has no viewer: install libsdl2-dev and libimgui-dev, then "
      "configure with -DHALFSPACE_VIEWER=ON; `halfspace render` makes "
      "pictures without it");
}

#endif

void add_window_options(CLI::App& app, ViewCommandArguments& arguments) {
  const std::string group = "Window";
  const auto parse_scale = [](std::string_view text) {
    const std::optional<double> scale = parse_number<double>(text);
    return scale && *scale >= 0.5 && *scale <= 4 ? scale : std::nullopt;
  };
  app.add_flag("--watch", arguments.watch,
               "Read files again when they change; the view stays")
      ->group(group);
  add_parsed(app, "--scale", "S", "a number of at least 0.5 and at most 4",
             arguments.scale, parse_scale,
             "Size of letters and panels; as the display asks if not said")
      ->group(group);
  app.add_option("--play", arguments.play_file,
                 "Play the events of the file, then end")
      ->type_name("EVENTS")
      ->group(group);
  app.add_option("--dump", arguments.dump_name,
                 "Where the event `dump` writes the picture, with %d for its "
                 "number; a .view file of the same name is written beside it")
      ->type_name("FILE-%d.png")
      ->group(group);
  app.add_option("--record", arguments.record_file,
                 "Write what is done to this file, for --play")
      ->type_name("EVENTS")
      ->group(group);
}

}  // namespace

void add_view(CLI::App& program, Status& status) {
  CLI::App* app = program.add_subcommand("view",
                                         "Look at files in a window, and turn, "
                                         "measure and combine them");
  const auto arguments = std::make_shared<ViewCommandArguments>();
  app->add_option("FILE", arguments->paths,
                  "Meshes, .hsolid files, a .scene, or a .view that the window "
                  "saved")
      ->type_name("");
  add_view_options(*app, arguments->view);
  add_number(*app, "--alpha", "A", arguments->alpha, std::uint8_t{0}, kOpaque,
             "Polygons that let what is behind them through: 0 is not seen, "
             "255 hides it");
  add_back_color_option(*app, arguments->back_color)->group("Picture");
  add_scalar_options(*app, arguments->scalars);
  add_window_options(*app, *arguments);
  add_quiet_option(*app);
  app->footer(
      "Drag turns, the wheel zooms, H shows the keys.\n\n"
      "Examples:\n"
      "  halfspace view part.stl\n"
      "  halfspace view part.stl drill.stl --watch\n"
      "  halfspace view part.view");
  app->callback([arguments, &status] { status = run_view(*arguments); });
}

}  // namespace halfspace::tools
