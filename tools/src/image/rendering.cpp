#include "image/rendering.hpp"

#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "cli/long_work.hpp"
#include "cli/measuring.hpp"
#include "image/grounds.hpp"

namespace halfspace::tools {
namespace {

std::string name_of(Method method) {
  return std::string(word_of(kMethodWords, method));
}

/// What is wrong with a film's options, or with their absence.
std::string film_complaint(const RenderArguments& arguments) {
  if (!arguments.camera_path_file && !arguments.turntable) {
    return arguments.frames ? "--frames: needs --path, which tells the cameras"
                            : "";
  }
  for (const auto& name : {arguments.picture_file, arguments.ids_file}) {
    if (name && !NumberedName::parse(*name)) {
      return *name +
             ": with --path or --turntable the name needs one %d or %05d, for "
             "the frame's "
             "number; %% is a percent sign";
    }
  }
  return {};
}

std::string tree_complaint(const RenderArguments& arguments,
                           const Engine& engine) {
  if (!arguments.tree_file) return {};
  if (!needs_tree(method_of(arguments))) {
    return "--tree: --method " + name_of(method_of(arguments)) +
           " needs no tree";
  }
  if (!needs_tree(arguments)) return "--tree: --priority depthsort needs none";
  if (!engine.has_tree_files()) return "--tree: --impl ref reads no trees";
  const BuildArguments& build = arguments.build;
  if (build.rule || build.candidates || build.seed || build.cut_weight) {
    return "--tree: the tree is there already; leave out --heuristic, "
           "--candidates, --seed and --cut-weight";
  }
  return {};
}

/// What is wrong with a lazy tree among the other options.
std::string lazy_complaint(const RenderArguments& arguments) {
  if (!arguments.lazy) return {};
  if (!needs_tree(arguments)) return "--lazy: no tree is needed";
  if (library_of(arguments) != Library::kFast)
    return "--lazy: --impl ref builds whole trees";
  const BuildArguments& build = arguments.build;
  if (arguments.tree_file || build.rule || build.candidates || build.seed ||
      build.cut_weight) {
    return "--lazy: is a display tree that is begun here; leave out --tree, "
           "--heuristic, --candidates, --seed and --cut-weight";
  }
  if (arguments.screen || arguments.anti_aliasing == AntiAliasing::kExact)
    return "--lazy: --screen and --aa exact take whole trees";
  return {};
}

std::string simd_complaint(const RenderArguments& arguments) {
  if (!arguments.simd) return {};
  if (library_of(arguments) != Library::kFast) {
    return "--simd: --impl ref has no loops for instruction sets";
  }
  if (!fast::is_supported(*arguments.simd)) {
    return fmt::format("--simd: this machine has no {}",
                       word_of(kSimdWords, *arguments.simd));
  }
  return {};
}

/// What is wrong with depth sort among the other options.
std::string priority_complaint(const RenderArguments& arguments) {
  if (!arguments.priority) return {};
  if (!needs_tree(method_of(arguments))) {
    return "--priority: is for --method span and painter, not " +
           name_of(method_of(arguments));
  }
  if (*arguments.priority != Priority::kDepthSort) return {};
  const BuildArguments& build = arguments.build;
  if (build.rule || build.candidates || build.seed || build.cut_weight) {
    return "--priority depthsort: builds no tree; leave out --heuristic, "
           "--candidates, --seed and --cut-weight";
  }
  if (arguments.anti_aliasing == AntiAliasing::kExact)
    return "--priority depthsort: has no exact areas; take --aa 8";
  return {};
}

Background::Style background_style(const RenderArguments& arguments) {
  const auto& background = arguments.view.background;
  return background ? background->style : Background::Style::kColor;
}

/// Whether each pixel shows one thing, or nothing.
bool is_plain(const RenderArguments& arguments) {
  return !arguments.anti_aliasing && !arguments.alpha && !arguments.lines.edges;
}

/// What is wrong with the background among the other options.
std::string background_complaint(const RenderArguments& arguments) {
  const Background::Style style = background_style(arguments);
  if (style == Background::Style::kColor) return {};
  if (arguments.shadow)
    return "--background: --shadow checks pictures with one colour behind";
  if (style == Background::Style::kGradient) {
    return arguments.anti_aliasing == AntiAliasing::kExact
               ? "--background: of exact areas a gradient is not made; take "
                 "--aa 8"
               : "";
  }
  if (arguments.rows)
    return "--background: parts of pictures have one; leave out none or --rows";
  if (arguments.lazy && !is_plain(arguments)) {
    return "--background: how much of none is seen is asked of a whole tree; "
           "leave out --lazy";
  }
  return {};
}

/// What is wrong with scalars among the other options.
std::string scalars_complaint(const RenderArguments& arguments) {
  const std::string alone = scalar_complaint(arguments.scalars);
  if (!arguments.scalars.source || !alone.empty()) return alone;
  if (arguments.anti_aliasing == AntiAliasing::kExact)
    return "--scalar: has colours of samples, no exact areas; take --aa 8";
  if (arguments.shadow)
    return "--shadow: checks a scene's own colours, none by --scalar";
  if (!arguments.scalars.has_legend) return {};
  if (arguments.rows) return "--legend: is for whole pictures, without --rows";
  if (background_style(arguments) == Background::Style::kNone)
    return "--legend: needs a background to stand on";
  return {};
}

/// What is wrong with a colour of back faces among the other options.
std::string back_color_complaint(const RenderArguments& arguments) {
  if (!arguments.back_color) return {};
  if (arguments.anti_aliasing == AntiAliasing::kExact)
    return "--back-color: marks samples, no exact areas; take --aa 8";
  if (arguments.scalars.source)
    return "--back-color: not where numbers are the colours; leave out "
           "--scalar";
  if (arguments.shadow)
    return "--shadow: checks a scene's own colours, none by --back-color";
  return {};
}

/// What is wrong with lines among the other options.
std::string lines_complaint(const RenderArguments& arguments) {
  const std::string alone = line_complaint(arguments.lines);
  if (!arguments.lines.edges || !alone.empty()) return alone;
  if (arguments.shadow) return "--shadow: checks pictures without --lines";
  return {};
}

}  // namespace

Method method_of(const RenderArguments& arguments) {
  if (arguments.method) return *arguments.method;
  return arguments.alpha ? Method::kPainter : Method::kSpan;
}

bool needs_tree(const RenderArguments& arguments) {
  return needs_tree(method_of(arguments)) &&
         arguments.priority != Priority::kDepthSort;
}

Library library_of(const RenderArguments& arguments) {
  return library_of(arguments.build, needs_tree(method_of(arguments))
                                         ? Library::kFast
                                         : Library::kRef);
}

std::string complaint(const RenderArguments& arguments, const Engine& engine) {
  if (!arguments.picture_file && !arguments.ids_file &&
      !arguments.build.stats_file) {
    return "render: nothing to write; give -o, --ids or --stats";
  }
  if (arguments.picture_file &&
      !io::has_extension(*arguments.picture_file, ".png")) {
    return *arguments.picture_file + ": pictures are written as .png";
  }
  const Method method = method_of(arguments);
  if (!engine.has(method)) {
    return "--impl fast: makes images by span or painter; use --impl ref for "
           "--method " +
           name_of(method);
  }
  if (arguments.alpha && method != Method::kPainter) {
    return "--alpha: only --method painter blends, not " + name_of(method);
  }
  if (arguments.anti_aliasing && !arguments.alpha && method != Method::kSpan) {
    return "--aa: is for --method span alone, not " + name_of(method);
  }
  if (arguments.anti_aliasing == AntiAliasing::kExact && arguments.rows) {
    return "--aa exact: makes whole pictures; leave out --rows";
  }
  if (arguments.anti_aliasing && arguments.shadow) {
    return "--shadow: checks images of one sample a pixel, none with --aa";
  }
  if (arguments.alpha && arguments.shadow) {
    return "--shadow: checks opaque images, none with --alpha";
  }
  if (arguments.anti_aliasing == AntiAliasing::kExact && arguments.alpha) {
    return "--aa exact: has areas of what is in front; with --alpha take --aa "
           "8";
  }
  if (arguments.screen &&
      (method != Method::kSpan || arguments.anti_aliasing || arguments.rows)) {
    return "--screen: is for whole pictures by --method span; leave out --aa "
           "and --rows";
  }
  for (const std::string& wrong :
       {background_complaint(arguments), priority_complaint(arguments),
        scalars_complaint(arguments), lines_complaint(arguments),
        back_color_complaint(arguments), lazy_complaint(arguments)}) {
    if (!wrong.empty()) return wrong;
  }
  const std::string simd = simd_complaint(arguments);
  if (!simd.empty()) return simd;
  const std::string film = film_complaint(arguments);
  return film.empty() ? tree_complaint(arguments, engine) : film;
}

Status make_tree(Engine& engine, const Scene& scene,
                 const RenderArguments& arguments, BuildMeasure& tree) {
  const Library library = library_of(arguments);
  tree.library = word_of(kLibraryWords, library);
  if (!needs_tree(arguments)) return Status::kFine;
  const bool leaves =
      !arguments.screen && arguments.anti_aliasing != AntiAliasing::kExact;
  if (arguments.tree_file) {
    const std::string& path = *arguments.tree_file;
    Result<BuildMeasure> loaded =
        load_measured(engine, library, scene, path, leaves);
    if (!loaded) return fail(path, loaded.error());
    tree = *std::move(loaded);
    return Status::kFine;
  }
  std::optional<BuildMeasure> built = build_measured(
      engine, library, scene, arguments.build, leaves, arguments.lazy);
  if (!built) return stop("interrupted; nothing was written");
  tree = *std::move(built);
  progress("tree: " + to_string(tree, scene.polygon_count()));
  return Status::kFine;
}

namespace {

/// What a legend stands on: of a gradient, what is half way down.
Rgb background_near_legend(const RenderArguments& arguments,
                           const Frame& frame) {
  if (background_style(arguments) == Background::Style::kGradient) {
    const std::int32_t height = frame.picture.colors.height_px;
    return gradient_color(height / 2, height);
  }
  return frame.options.background;
}

}  // namespace

Result<std::optional<Rows>> asked_rows(const RenderArguments& arguments,
                                       std::int32_t height_px) {
  if (!arguments.rows) return std::optional<Rows>();
  const std::int64_t first = arguments.rows->first.value_or(0);
  const std::int64_t end = arguments.rows->end.value_or(height_px);
  if (first < end && end <= height_px) {
    return std::optional(
        Rows{static_cast<std::int32_t>(first), static_cast<std::int32_t>(end)});
  }
  return Error{ErrorCode::kOutOfRange,
               "--rows: the image has the rows 0:" + std::to_string(height_px)};
}

void add_background(const RenderArguments& arguments, std::int32_t height_px,
                    Frame& frame) {
  const Background::Style style = background_style(arguments);
  Picture& picture = frame.picture;
  if (style == Background::Style::kNone) {
    frame.coverage =
        io::CoverageImage(picture.items.width_px, picture.items.height_px, 255);
    for (std::size_t k = 0; k < picture.items.pixels.size(); ++k) {
      if (picture.items.pixels[k] == kBackground) frame.coverage->pixels[k] = 0;
    }
  }
  if (style != Background::Style::kGradient) return;
  const std::int32_t first = frame.part ? frame.part->first_row : 0;
  for (std::int32_t j = 0; j < picture.items.height_px; ++j) {
    const Rgb color = gradient_color(first + j, height_px);
    for (std::int32_t i = 0; i < picture.items.width_px; ++i) {
      if (picture.items.at(i, j) == kBackground)
        picture.colors.at(i, j) = color;
    }
  }
}

Result<ImageOptions> image_options(const SceneFile& file, const Camera& camera,
                                   const RenderArguments& arguments) {
  ImageOptions options = choose_options(file, arguments.view);
  const Result<Done> clipped =
      add_clips(file.scene, camera, arguments.clip, options);
  if (!clipped) return clipped.error();
  return options;
}

Result<Frame> make_frame(const Engine& engine, const Subject& subject,
                         const Camera& camera,
                         const RenderArguments& arguments) {
  const SceneFile& file = subject.loaded.file;
  const Result<ImageOptions> options = image_options(file, camera, arguments);
  if (!options) return options.error();
  return make_frame(engine, file.scene, camera, *options,
                    subject.scalars ? &subject.scalars->legend : nullptr,
                    arguments);
}

Result<Frame> make_frame(const Engine& engine, const Scene& scene,
                         const Camera& camera, const ImageOptions& options,
                         const io::Legend* legend,
                         const RenderArguments& arguments) {
  const Result<std::optional<Rows>> rows =
      asked_rows(arguments, camera->height_px);
  if (!rows) return rows.error();
  const auto anti_aliasing =
      arguments.anti_aliasing.value_or(AntiAliasing::kNone);
  const std::int32_t most = kMaxImageSize / samples_of(anti_aliasing);
  if (camera->width_px > most || camera->height_px > most) {
    return Error{ErrorCode::kOutOfRange,
                 "--aa: with so many samples a picture has at most " +
                     std::to_string(most) + " columns and rows"};
  }
  Shot shot;
  shot.method = method_of(arguments);
  shot.options = options;
  shot.rows = *rows;
  shot.screen = arguments.screen;
  shot.priority = arguments.priority.value_or(Priority::kTree);
  shot.anti_aliasing = anti_aliasing;
  shot.items = !arguments.anti_aliasing || arguments.ids_file ||
               arguments.scalars.has_legend;
  shot.alpha = arguments.alpha.value_or(kOpaque);
  shot.threads = thread_count(arguments.build);
  shot.simd = arguments.simd.value_or(fast::SimdLevel::kBest);
  shot.mark = arguments.back_color;
  shot.by_scalars = legend != nullptr;
  Frame frame;
  frame.options = shot.options;
  if (shot.rows) {
    frame.part = io::PartOfPicture{shot.rows->first, camera->height_px};
  }
  const Background::Style style = background_style(arguments);
  const bool is_cut_out =
      style == Background::Style::kNone && !is_plain(arguments);
  const bool has_gradient = style == Background::Style::kGradient &&
                            (arguments.anti_aliasing || arguments.alpha);
  if (is_cut_out) shot.options.background = {0, 0, 0};
  std::vector<double> times_ms;
  for (std::uint32_t i = 0; i < arguments.repeat.value_or(1); ++i) {
    const Stopwatch watch;
    frame.picture = has_gradient
                        ? drawn_over_gradient(engine, scene, camera, shot)
                        : drawn(engine, scene, camera, shot);
    times_ms.push_back(watch.elapsed_ms());
  }
  frame.frame_ms = median(std::move(times_ms));
  frame.picture.cells = engine.built_cells();
  if (arguments.build.stats_file && needs_tree(arguments) && !arguments.lazy) {
    const auto count = engine.count_behind(scene, camera);
    frame.picture.subtrees_behind = count.subtrees;
    frame.picture.fragments_behind = count.fragments;
  }
  if (!is_cut_out && !has_gradient)
    add_background(arguments, camera->height_px, frame);
  const Result<Done> lines = add_lines(engine, scene, camera, shot,
                                       arguments.lines, frame.picture.colors);
  if (!lines) return lines.error();
  if (is_cut_out) {
    Result<io::CoverageImage> coverage =
        coverage_of(engine, scene, camera, shot, arguments.lines);
    if (!coverage) return coverage.error();
    frame.coverage = *std::move(coverage);
    divide(*frame.coverage, frame.picture.colors);
  }
  if (arguments.scalars.has_legend) {
    io::draw_legend(*legend, frame.picture.items,
                    background_near_legend(arguments, frame),
                    frame.picture.colors);
  }
  return frame;
}

Status write_frame(const Frame& frame, const Outputs& outputs) {
  if (outputs.picture_file) {
    note_part(*outputs.picture_file);
    const Result<Done> written =
        frame.coverage
            ? io::write_png_cut_out(*outputs.picture_file, frame.picture.colors,
                                    *frame.coverage, outputs.threads)
            : io::write_png(*outputs.picture_file, frame.picture.colors,
                            frame.part, outputs.threads);
    if (!written) return fail(*outputs.picture_file, written.error());
  }
  if (outputs.ids_file) {
    note_part(*outputs.ids_file);
    const Result<Done> written =
        io::write_npy(*outputs.ids_file, frame.picture.items);
    if (!written) return fail(*outputs.ids_file, written.error());
  }
  return Status::kFine;
}

void print_summary(const io::LoadedScene& loaded, const BuildMeasure& tree,
                   const Frame& frame, std::int64_t frames,
                   const RenderArguments& arguments) {
  const std::size_t polygons = loaded.file.scene.polygon_count();
  say("{}: {} polygons; {}\n", arguments.path, polygons,
      to_string(loaded.report));
  const Method method = method_of(arguments);
  if (needs_tree(arguments)) {
    say("tree: {}\n", to_string(tree, polygons));
    if (const auto& cells = frame.picture.cells) {
      say("built: {} of {} cells with {} polygons, {} fragments, {} bytes\n",
          cells->cells_built, cells->cells, cells->polygons_built,
          cells->fragments, cells->bytes);
    }
  } else if (arguments.priority) {
    say("depth sort: {} fragments, {} moved, {} cuts\n", frame.picture.listed,
        frame.picture.moves, frame.picture.cuts);
  }
  say("{}: {}x{}, ", name_of(method), frame.picture.colors.width_px,
      frame.picture.colors.height_px);
  if (arguments.anti_aliasing) {
    say("anti-aliased by {}, ",
        word_of(kAntiAliasingWords, *arguments.anti_aliasing));
  }
  if (frames > 1) {
    say("{} frames, the median ", frames);
  } else {
    say("{} pixels painted, ", frame.picture.pixels_painted);
  }
  say("{:.3f} ms ({})\n", frame.frame_ms, tree.library);
}

nlohmann::json stats_of(const io::LoadedScene& loaded, const BuildMeasure& tree,
                        const Frame& frame, std::int64_t frames,
                        const RenderArguments& arguments) {
  nlohmann::json stats = stats_of(loaded, tree);
  stats["method"] = name_of(method_of(arguments));
  stats["threads"] = thread_count(arguments.build);
  stats["width_px"] = frame.picture.colors.width_px;
  stats["height_px"] = frame.picture.colors.height_px;
  stats["frame_ms"] = frame.frame_ms;
  stats["frames"] = frames;
  stats["repeats"] = arguments.repeat.value_or(1);
  stats["exact_pixels"] = frame.picture.exact_pixels;
  stats["pixels_painted"] = frame.picture.pixels_painted;
  stats["fragments_displayed"] = frame.picture.fragments_displayed;
  stats["tiles_touched"] = frame.picture.tiles_touched;
  stats["exact_decisions"] = frame.picture.exact_decisions;
  if (const auto& cells = frame.picture.cells) {
    stats["cells"] = cells->cells;
    stats["cells_built"] = cells->cells_built;
    stats["polygons_built"] = cells->polygons_built;
    stats["fragments_built"] = cells->fragments;
    stats["bytes_built"] = cells->bytes;
  } else if (needs_tree(arguments)) {
    stats["subtrees_behind"] = frame.picture.subtrees_behind;
    stats["fragments_behind"] = frame.picture.fragments_behind;
  }
  if (arguments.priority == Priority::kDepthSort) {
    stats["listed"] = frame.picture.listed;
    stats["moves"] = frame.picture.moves;
    stats["cuts"] = frame.picture.cuts;
  }
  return stats;
}

}  // namespace halfspace::tools
