#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Validators.hpp>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/options.hpp"
#include "cli/outputs.hpp"
#include "figure/figure_scene.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/visible_map.hpp"
#include "image/clipping.hpp"
#include "image/viewing.hpp"

namespace halfspace::tools {
namespace {

using boost::multiprecision::cpp_int;
using boost::multiprecision::cpp_rational;

struct MapArguments {
  std::vector<std::string> paths;
  std::string output = "-";
  std::string by = "polygon";
  bool exact = false;
  std::size_t most_cells = fast::MapLimits{}.most_cells;
  std::optional<int> grid_bits;
  ViewArguments view;
  ClipArguments clip;
};

cpp_int integer_of(const fast::MapLine::Integer& words) {
  cpp_int value = 0;
  for (std::size_t k = words.size(); k-- > 0;) value = (value << 64) + words[k];
  if (words.back() >> 63 != 0) value -= cpp_int(1) << (64 * words.size());
  return value;
}

/// A vertex of the map where its two lines meet, as quotients in quotes.
std::string exact_text(const fast::VisibleMap& map,
                       const fast::MapVertex& vertex) {
  const auto coefficients = [&](std::size_t k) {
    const fast::MapLine& line =
        map.lines[static_cast<std::size_t>(vertex.lines[k])];
    return std::array<cpp_int, 3>{integer_of(line.a), integer_of(line.b),
                                  integer_of(line.c)};
  };
  const auto [a, b, c] = coefficients(0);
  const auto [d, e, f] = coefficients(1);
  const cpp_int turn = a * e - b * d;
  // Old versions of Boost take positive denominators alone.
  const cpp_int sign = turn < 0 ? -1 : 1;
  const cpp_int w = 2 * sign * turn;
  const cpp_rational x(cpp_int(sign * (b * f - c * e)), w);
  const cpp_rational y(cpp_int(sign * (c * d - a * f)), w);
  return "[\"" + x.str() + "\",\"" + y.str() + "\"]";
}

/// A list in JSON, an entry a line.
template <class List, class Text>
std::string list_of(const List& list, const Text& text) {
  std::string result = "[";
  for (std::size_t k = 0; k < list.size(); ++k)
    result += (k == 0 ? "\n" : ",\n") + text(list[k]);
  return result + "\n]";
}

std::string loops_text(const fast::VisibleMap& map,
                       const fast::MapRegion& region) {
  std::string text;
  for (std::int32_t l = 0; l < region.loop_count; ++l) {
    const auto loop = static_cast<std::size_t>(region.first_loop + l);
    std::string corners;
    for (std::uint32_t k = map.first_corner[loop];
         k < map.first_corner[loop + 1]; ++k)
      corners +=
          (corners.empty() ? "" : ",") + fmt::format("{}", map.corners[k]);
    text += (l == 0 ? "[" : ",[") + corners + "]";
  }
  return text;
}

std::string json_of(const fast::VisibleMap& map, const Size& size,
                    const MapArguments& arguments) {
  std::string text =
      fmt::format("{{\"width\":{},\"height\":{},\"by\":\"{}\",\n\"vertices\":",
                  size.width_px, size.height_px, arguments.by);
  text += list_of(map.vertices, [](const fast::MapVertex& v) {
    return fmt::format("[{},{}]", v.x, v.y);
  });
  if (arguments.exact) {
    text += ",\n\"exact_vertices\":" +
            list_of(map.vertices, [&](const fast::MapVertex& v) {
              return exact_text(map, v);
            });
  }
  text += ",\n\"arcs\":" + list_of(map.arcs, [](const fast::MapArc& arc) {
            return fmt::format("[{},{},{},{}]", arc.from, arc.to, arc.left,
                               arc.right);
          });
  text +=
      ",\n\"regions\":" +
      list_of(map.regions, [&](const fast::MapRegion& region) {
        return fmt::format("{{\"key\":{},\"polygon\":{},\"loops\":[{}]}}",
                           region.key, region.item, loops_text(map, region));
      });
  return text + "}\n";
}

std::string complaint_of(const MapArguments& arguments) {
  std::vector<NamedFile> inputs;
  for (const std::string& path : arguments.paths)
    inputs.push_back({"FILE", path});
  return complaint(inputs, std::array{NamedFile{"-o", arguments.output}});
}

Status run_map(const MapArguments& arguments) {
  const std::string wrong = complaint_of(arguments);
  if (!wrong.empty()) return fail(wrong);
  Result<FigureScene> loaded = load_figure(
      arguments.paths, import_options(arguments.view, arguments.grid_bits));
  if (!loaded) return fail(arguments.paths[0], loaded.error());
  std::string no_caps = cut_complaint(arguments.clip, arguments.view.near);
  if (no_caps.empty())
    no_caps = prepare_caps(loaded->file, arguments.clip, loaded->files);
  if (!no_caps.empty()) return fail(loaded->name, {ErrorCode::kOpen, no_caps});
  Size size = arguments.view.size.value_or(kUsualSize);
  fast::VisibleMap map;
  const Result<ChosenCamera> chosen =
      choose_camera(loaded->file, arguments.view);
  if (!chosen && chosen.error().code != ErrorCode::kEmpty)
    return fail(camera_error(loaded->name, chosen.error()));
  if (chosen) {
    size = {chosen->camera->width_px, chosen->camera->height_px};
    const fast::BspTree tree = fast::build_display_tree(loaded->scene());
    ImageOptions image = choose_options(loaded->file, arguments.view);
    const Result<Done> clipped =
        add_clips(loaded->scene(), chosen->camera, arguments.clip, image);
    if (!clipped) return fail(loaded->name, clipped.error());
    Result<fast::VisibleMap> made = fast::section_map(
        loaded->scene(), tree, chosen->camera,
        {image.cull, keys_of(*loaded, arguments.by, false, image)}, image,
        {arguments.most_cells});
    if (!made) return fail(loaded->name, made.error());
    map = std::move(*made);
  }
  const Result<Done> written =
      write_output(arguments.output, json_of(map, size, arguments));
  if (!written) return fail(arguments.output, written.error());
  if (arguments.output != "-") {
    say("{}: {} polygons; {} regions, {} arcs, {} vertices\n", loaded->name,
        loaded->scene().polygon_count(), map.regions.size(), map.arcs.size(),
        map.vertices.size());
  }
  return Status::kFine;
}

}  // namespace

void add_map(CLI::App& program, Status& status) {
  CLI::App* app = program.add_subcommand(
      "map", "Write the planar map of what is seen, exactly, as JSON");
  const auto arguments = std::make_shared<MapArguments>();
  app->add_option("FILE", arguments->paths, "Meshes, or one .scene")
      ->required()
      ->type_name("");
  app->add_option("-o,--output", arguments->output,
                  "Where the map goes; `-` is standard output")
      ->capture_default_str()
      ->type_name("OUT.json");
  app->add_option("--by", arguments->by,
                  "Which polygons make one region where they meet")
      ->check(
          CLI::IsMember({"polygon", "face", "colour", "part", "file", "all"}))
      ->capture_default_str();
  app->add_flag("--exact", arguments->exact,
                "Coordinates of vertices as quotients of integers, too");
  app->add_option("--most-cells", arguments->most_cells,
                  "Give up where the map needs more cells")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1} << 28))
      ->capture_default_str();
  add_grid_option(*app, arguments->grid_bits);
  add_view_options(*app, arguments->view);
  add_clip_options(*app, arguments->clip);
  add_quiet_option(*app);
  app->footer(
      "An arc is its two vertices and the regions on its left and right, -1 "
      "for the\noutside of the image; a region is its key, its lowest polygon "
      "and loops of\nvertices, the outer one first (spec/S7-map.md). Caps have "
      "numbers after "
      "those of\npolygons (S10.5).\n\n"
      "Examples:\n"
      "  halfspace map part.stl --by face --exact -o map.json\n"
      "  halfspace map part.stl --clip 0,1,0,0 --cap part -o cut.json");
  app->callback([arguments, &status] { status = run_map(*arguments); });
}

}  // namespace halfspace::tools
