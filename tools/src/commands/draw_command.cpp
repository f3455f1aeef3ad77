#include <fmt/format.h>
#include <malloc.h>

#include <CLI/App.hpp>
#include <CLI/Validators.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/command.hpp"
#include "cli/long_work.hpp"
#include "cli/options.hpp"
#include "cli/outputs.hpp"
#include "figure/figure_scene.hpp"
#include "figure/scalar_figure.hpp"
#include "figure/sheet.hpp"
#include "figure/view_figure.hpp"
#include "halfspace/fast/visible_map.hpp"
#include "halfspace/io/figure.hpp"
#include "halfspace/io/figure_legend.hpp"
#include "image/clipping.hpp"
#include "image/scalars.hpp"
#include "image/viewing.hpp"

namespace halfspace::tools {
namespace {

constexpr Word<Hidden> kHiddenWords[] = {{"gone", Hidden::kGone},
                                         {"dashed", Hidden::kDashed},
                                         {"solid", Hidden::kSolid}};

/// Numbers from 0 to 255 with commas between them.
std::optional<std::vector<std::uint8_t>> parse_alphas(std::string_view text) {
  std::vector<std::uint8_t> alphas;
  while (true) {
    const std::size_t comma = text.find(',');
    const auto alpha = parse_number<std::uint8_t>(text.substr(0, comma));
    if (!alpha) return std::nullopt;
    alphas.push_back(*alpha);
    if (comma == std::string_view::npos) return alphas;
    text.remove_prefix(comma + 1);
  }
}

/// What is not said follows from what is: lines alone where the format has
/// nothing else, or where the options speak of lines.
void complete(DrawArguments& arguments) {
  const bool plotter = io::is_plotter_format(
      std::filesystem::path(arguments.output).extension().string());
  const bool speaks_of_edges = arguments.hidden || arguments.crease_deg ||
                               arguments.cut || arguments.titles ||
                               arguments.sheet.is_used();
  const bool only_lines =
      arguments.fill.empty() &&
      (plotter || speaks_of_edges || arguments.lines == "edges");
  if (arguments.fill.empty()) arguments.fill = only_lines ? "none" : "colour";
  if (arguments.fill == "shaded") {
    arguments.fill = "colour";
    if (!arguments.view.shading) arguments.view.shading = Shading::kGouraud;
  }
  if (arguments.lines.empty())
    arguments.lines = only_lines || speaks_of_edges ? "edges" : "none";
  if (arguments.by.empty()) {
    arguments.by = arguments.fill == "none" ? "face" : arguments.fill;
  }
}

/// The camera with so many pixels more on each side.
Result<Camera> with_margin(const Camera& camera, std::int32_t margin,
                           int grid_bits) {
  CameraData data = camera.data();
  const auto less = [margin](const LatticeVector& s0, const LatticeVector& sx,
                             const LatticeVector& sy) {
    return LatticeVector{s0.x - margin * (sx.x + sy.x),
                         s0.y - margin * (sx.y + sy.y),
                         s0.z - margin * (sx.z + sy.z)};
  };
  data.s0 = less(data.s0, data.sx, data.sy);
  data.width_px += 2 * margin;
  data.height_px += 2 * margin;
  return make_camera(data, grid_bits);
}

/// The camera of the options; axes get a margin for their numbers.
Result<ChosenCamera> choose_view(const DrawArguments& arguments,
                                 const FigureScene& loaded, const Size& size) {
  if (loaded.scalars && arguments.scalars.has_legend) {
    ViewArguments beside = arguments.view;
    beside.size = size_beside_legend(loaded.scalars, arguments.scalars, size);
    const Result<ChosenCamera> chosen = choose_camera(loaded.file, beside);
    return chosen ? widened(*chosen, size.width_px, loaded.scene()) : chosen;
  }
  if (!arguments.axes || loaded.file.camera)
    return choose_camera(loaded.file, arguments.view);
  constexpr double kTextsWide = 5;
  const auto margin = static_cast<std::int32_t>(
      std::min(kTextsWide * arguments.text_size.value_or(kUsualTextPx),
               0.2 * std::min(size.width_px, size.height_px)));
  ViewArguments inner = arguments.view;
  inner.size = Size{size.width_px - 2 * margin, size.height_px - 2 * margin};
  Result<ChosenCamera> chosen = choose_camera(loaded.file, inner);
  if (!chosen) return chosen;
  const Result<Camera> camera =
      with_margin(chosen->camera, margin, loaded.scene().grid_bits());
  if (!camera) return camera.error();
  chosen->camera = *camera;
  return chosen;
}

/// The one view of the options.
Result<Done> draw_view(const DrawArguments& arguments,
                       const FigureScene& loaded, const Rgb& background,
                       ViewFigure& figures) {
  const Size size = arguments.view.size.value_or(kUsualSize);
  const Result<ChosenCamera> chosen = choose_view(arguments, loaded, size);
  io::Figure& figure = figures.figure();
  figure.width = size.width_px;
  figure.height = size.height_px;
  if (!chosen && chosen.error().code == ErrorCode::kEmpty) return Done{};
  if (!chosen) {
    return Error{chosen.error().code,
                 camera_error(loaded.name, chosen.error())};
  }
  figure.width = chosen->camera->width_px;
  figure.height = chosen->camera->height_px;
  const Result<Done> added = figures.add(chosen->camera, {}, false);
  if (!added || !arguments.scalars.has_legend) return added;
  if (!io::add_legend(loaded.scalars->legend, background, figure))
    return Error{ErrorCode::kBadCamera, "--legend: needs a larger --size"};
  return Done{};
}

/// Several views on a sheet of paper.
Result<Done> draw_sheet(const DrawArguments& arguments,
                        const FigureScene& loaded, ViewFigure& figures) {
  const SheetArguments& sheet = arguments.sheet;
  io::Figure& figure = figures.figure();
  figure.width = sheet.width_mm();
  figure.height = sheet.height_mm();
  figure.unit_mm = 1;
  if (loaded.scene().polygon_count() == 0) return Done{};
  const Result<std::vector<SheetView>> views = views_on(sheet, loaded.scene());
  if (!views) return views.error();
  for (const SheetView& view : *views) {
    const Result<Done> done = figures.add(view.camera, view.placing, true);
    if (!done) return done;
  }
  say("scale {}\n", scale_text(views->front().scale));
  return Done{};
}

/// What is wrong with scalars among the other options.
std::string scalars_complaint(const DrawArguments& arguments,
                              bool asks_for_shade) {
  const std::string alone = scalar_complaint(arguments.scalars);
  if (!arguments.scalars.source || !alone.empty()) return alone;
  if (arguments.paths.size() > 1) return "--scalar: colours one FILE";
  if (arguments.fill != "colour" || arguments.by != "colour" ||
      asks_for_shade) {
    return "--scalar: gives regions their colours; give no --fill, --by or "
           "--shade";
  }
  if (arguments.scalars.has_legend &&
      (arguments.sheet.is_used() || arguments.axes))
    return "--legend: is for one view, without --sheet and --axes";
  return {};
}

std::string complaint_of(const DrawArguments& arguments) {
  if (!io::is_figure_name(arguments.output)) {
    return arguments.output + ": a figure's name ends in one of " +
           io::figure_format_names();
  }
  if (io::is_plotter_format(
          std::filesystem::path(arguments.output).extension().string()) &&
      arguments.lines == "none")
    return arguments.output + ": the format holds lines alone; give --lines";
  const bool asks_for_shade =
      arguments.view.shading.value_or(
          arguments.view.crease_deg ? Shading::kGouraud : Shading::kFlat) ==
      Shading::kGouraud;
  if (asks_for_shade && arguments.fill != "none" && !can_shade(arguments.by)) {
    return "regions by " + arguments.by +
           " have one colour each; for shaded ones give --by colour or polygon";
  }
  if (!arguments.alphas.empty() &&
      (arguments.by != "colour" || asks_for_shade)) {
    return "--alpha composes the polygons' own colours; give no --shade "
           "gouraud and no --by or --fill but colour";
  }
  if (arguments.alphas.size() > 1 &&
      arguments.alphas.size() != arguments.paths.size())
    return "--alpha: is one number for all, or one a FILE";
  const std::string scalars = scalars_complaint(arguments, asks_for_shade);
  if (!scalars.empty()) return scalars;
  std::vector<NamedFile> inputs;
  for (const std::string& path : arguments.paths)
    inputs.push_back({"FILE", path});
  if (!arguments.notes.empty()) inputs.push_back({"--notes", arguments.notes});
  return complaint(inputs, std::array{NamedFile{"-o", arguments.output}});
}

Status run_draw(DrawArguments arguments) {
  complete(arguments);
  const std::string wrong = complaint_of(arguments);
  if (!wrong.empty()) return fail(wrong);
  io::ImportOptions options =
      import_options(arguments.view, arguments.grid_bits);
  if (arguments.scalars.source) color_by_scalars(options);
  Result<FigureScene> loaded =
      arguments.scalars.source
          ? load_scalar_figure(arguments.paths[0], options, arguments.scalars)
          : load_figure(arguments.paths, options);
  if (!loaded) return fail(arguments.paths[0], loaded.error());
  if (loaded->scalars && !arguments.alphas.empty()) {
    const std::vector<bool>& banded = loaded->scalars->banded;
    if (std::find(banded.begin(), banded.end(), true) != banded.end()) {
      return fail(
          "--alpha: composes polygons of one colour each, and numbers at "
          "corners change colours within polygons; take numbers of faces");
    }
  }
  // Reading leaves holes that large arrays do not fit.
  malloc_trim(0);
  if (arguments.view.background &&
      arguments.view.background->style != Background::Style::kColor) {
    return fail("--background: a figure has one colour behind it");
  }
  std::string no_caps = cut_complaint(arguments.clip, arguments.view.near);
  if (no_caps.empty())
    no_caps = prepare_caps(loaded->file, arguments.clip, loaded->files);
  if (!no_caps.empty()) return fail(loaded->name, {ErrorCode::kOpen, no_caps});
  const ImageOptions image = choose_options(loaded->file, arguments.view);
  ViewFigure figures(arguments, *loaded, image);
  const Result<Done> drawn =
      arguments.sheet.is_used()
          ? draw_sheet(arguments, *loaded, figures)
          : draw_view(arguments, *loaded, image.background, figures);
  if (!drawn && drawn.error().code == ErrorCode::kStopped)
    return stop("interrupted");
  if (!drawn && drawn.error().code == ErrorCode::kBadCamera)
    return fail(drawn.error().message);
  if (!drawn) return fail(loaded->name, drawn.error());
  note_part(arguments.output);
  const io::FigureOptions writing = {arguments.decimals, arguments.levels};
  const Result<Done> written =
      io::write_figure(arguments.output, figures.figure(), writing);
  if (!written) return fail(arguments.output, written.error());
  say("{}: {} polygons; {} regions, {} arcs, {} strokes\n", loaded->name,
      loaded->scene().polygon_count(), figures.regions(), figures.arcs(),
      figures.strokes());
  if (arguments.certificate) {
    const io::FigureCertificate certificate = io::certify(
        std::filesystem::path(arguments.output).extension().string(),
        figures.figure(), writing);
    say("coordinates moved by at most {:.3g} of {:.3g}; {} loops, {} turned "
        "over, {} vanished; {} points with up to {} decimals\n",
        certificate.largest_move, certificate.bound, certificate.loops,
        certificate.turned_over, certificate.vanished, certificate.finer_points,
        certificate.most_decimals);
  }
  return Status::kFine;
}

void add_note_options(CLI::App& app, DrawArguments& arguments) {
  const std::string group = "Notes";
  app.add_flag("--axes", arguments.axes,
               "Draw axes along edges of the box round the model, with ticks, "
               "numbers and names, hidden where the model hides them, and "
               "whole where --clip cuts it")
      ->group(group);
  app.add_option(
         "--notes", arguments.notes,
         "Draw what this file says where the model does not hide it, in "
         "its units: line X Y Z X Y Z, point X Y Z [WORDS], text X Y Z "
         "WORDS")
      ->type_name("FILE")
      ->group(group);
  app.add_option("--text-size", arguments.text_size,
                 "Height of lines of text; 12 pixels, or 3.5 mm on a sheet, if "
                 "not said")
      ->check(CLI::Range(0.01, 10000.0))
      ->group(group);
}

void add_line_options(CLI::App& app, DrawArguments& arguments) {
  const std::string group = "Lines";
  app.add_option("--lines", arguments.lines,
                 "none, the borders of regions, or the scene's edges, which "
                 "--hidden, --crease and --sheet also ask for")
      ->check(CLI::IsMember({"none", "regions", "edges"}))
      ->group(group);
  add_choice(app, "--hidden", kHiddenWords, arguments.hidden,
             "What becomes of hidden parts of edges; gone if not said")
      ->group(group);
  const auto parse_crease = [](std::string_view text) {
    const std::optional<double> angle = parse_number<double>(text);
    return angle && *angle >= 0 && *angle <= 180 ? angle : std::nullopt;
  };
  add_parsed(app, "--crease", "DEG", "a number of at least 0 and at most 180",
             arguments.crease_deg, parse_crease,
             "Edges where faces turn by more are drawn, though they are no "
             "silhouettes; 20 if not said")
      ->group(group);
  const auto parse_cut = [](std::string_view text) {
    const std::optional<double> at =
        text.size() > 2 && text[1] == '=' && text[0] >= 'x' && text[0] <= 'z'
            ? parse_number<double>(text.substr(2))
            : std::nullopt;
    return at ? std::optional(CutPlane{text[0] - 'x', *at}) : std::nullopt;
  };
  add_parsed(app, "--cut", "AXIS=AT", "x, y or z, =, and a finite number",
             arguments.cut, parse_cut,
             "Faces in this plane, where `csg` cut with half(), are hatched")
      ->group(group);
  app.add_option("--line-width", arguments.line_width,
                 "In pixels, or on a sheet times 0.35 mm")
      ->check(CLI::Range(0.001, 1000.0))
      ->capture_default_str()
      ->group(group);
  app.add_flag("--titles", arguments.titles,
               "Title each stroke of an SVG by its edges, intervals and the "
               "layers before it")
      ->group(group);
}

}  // namespace

void add_draw(CLI::App& program, Status& status) {
  CLI::App* app = program.add_subcommand(
      "draw", "Draw meshes as vectors: exact regions and lines");
  const auto arguments = std::make_shared<DrawArguments>();
  app->add_option("FILE", arguments->paths, "Meshes, or one .scene")
      ->required()
      ->type_name("");
  app->add_option("-o,--output", arguments->output,
                  "The figure: " + io::figure_format_names())
      ->required()
      ->type_name("OUT");
  app->add_option("--fill", arguments->fill,
                  "What regions show: the colours of lit faces, the same "
                  "shaded between corners, or one colour a part or a file; "
                  "colour if not said")
      ->check(
          CLI::IsMember({"none", "face", "part", "file", "colour", "shaded"}));
  app->add_option("--by", arguments->by,
                  "Which polygons make one region where they meet; if not "
                  "said, what --fill says")
      ->check(
          CLI::IsMember({"polygon", "face", "colour", "part", "file", "all"}));
  app->add_option(
         "--decimals", arguments->decimals,
         "Of coordinates, in the figure's units; where that would turn "
         "a region over, its corners get more")
      ->check(CLI::Range(0, 12))
      ->capture_default_str();
  app->add_flag("--certificate", arguments->certificate,
                "Say how far rounding moved coordinates, and how many got more "
                "decimals so that no region turns over");
  app->add_option("--levels", arguments->levels,
                  "With --shade gouraud: by how many of 255 levels a shaded "
                  "region's colour may be off")
      ->check(CLI::Range(1.0, 255.0))
      ->capture_default_str();
  add_parsed(*app, "--alpha", "A[,A...]",
             "whole numbers of at least 0 and at most 255, with commas",
             arguments->alphas, parse_alphas,
             "Polygons that let what is behind them through: 0 is not seen, "
             "255 hides it; one for all, or one a FILE; if not said, what the "
             "FILEs say of their faces. A region is what has one composed "
             "colour");
  app->add_option("--most-cells", arguments->most_cells,
                  "Give up where the map needs more cells")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1} << 28))
      ->capture_default_str();
  add_note_options(*app, *arguments);
  add_line_options(*app, *arguments);
  add_scalar_options(*app, arguments->scalars);
  add_sheet_options(*app, arguments->sheet);
  add_clip_options(*app, arguments->clip);
  add_grid_option(*app, arguments->grid_bits);
  add_view_options(*app, arguments->view);
  add_quiet_option(*app);
  app->footer(
      "What is seen is worked out exactly (spec/S7-map.md, spec/S9-drawing.md):"
      "\nno region is in the wrong place, and an edge ends where it does.\n\n"
      "Examples:\n"
      "  halfspace draw part.stl -o part.svg\n"
      "  halfspace draw part.stl -o part.svg --view iso --hidden dashed\n"
      "  halfspace draw part.stl -o part.dxf --sheet a3 --scale 1:5\n"
      "  halfspace draw part.stl -o cut.svg --clip 0,1,0,0 --cap hatch\n"
      "  halfspace draw a.off b.off -o both.pdf --fill file --lines edges");
  app->callback([arguments, &status] { status = run_draw(*arguments); });
}

}  // namespace halfspace::tools
