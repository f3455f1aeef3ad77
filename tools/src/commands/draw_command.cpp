#include <CLI/App.hpp>
#include <CLI/Validators.hpp>
#include <array>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "cli/command.hpp"
#include "cli/loading.hpp"
#include "cli/long_work.hpp"
#include "cli/outputs.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/visible_map.hpp"
#include "halfspace/io/figure.hpp"
#include "image/viewing.hpp"

namespace halfspace::tools {
namespace {

struct DrawArguments {
  std::string path;
  std::string output;
  std::string by = "colour";
  std::string fill = "colour";
  std::string lines = "none";
  double line_width = 1;
  int decimals = 3;
  std::size_t most_cells = fast::MapLimits{}.most_cells;
  std::optional<int> grid_bits;
  ViewArguments view;
};

/// Numbers things in the order in which they come.
template <class Thing>
std::vector<std::int32_t> numbered(const std::vector<Thing>& things) {
  std::map<Thing, std::int32_t> numbers;
  std::vector<std::int32_t> result;
  for (const Thing& thing : things) {
    const auto next = static_cast<std::int32_t>(numbers.size());
    result.push_back(numbers.try_emplace(thing, next).first->second);
  }
  return result;
}

/// Polygons that share vertices are of one part.
std::vector<std::int32_t> parts_of(const Scene& scene) {
  std::map<GridPoint, std::int32_t> points;
  std::vector<std::int32_t> parents(scene.polygon_count());
  std::iota(parents.begin(), parents.end(), 0);
  const auto root_of = [&](std::int32_t p) {
    while (parents[static_cast<std::size_t>(p)] != p) {
      std::int32_t& parent = parents[static_cast<std::size_t>(p)];
      parent = parents[static_cast<std::size_t>(parent)];
      p = parent;
    }
    return p;
  };
  for (PolygonId p = 0; p < std::ssize(parents); ++p) {
    for (const VertexId corner : scene.corners(p)) {
      const auto [found, is_new] = points.try_emplace(scene.point(corner), p);
      if (is_new) continue;
      const std::int32_t a = root_of(found->second);
      const std::int32_t b = root_of(p);
      parents[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }
  }
  std::vector<std::int32_t> roots;
  for (PolygonId p = 0; p < std::ssize(parents); ++p)
    roots.push_back(root_of(p));
  return numbered(roots);
}

/// The keys by which regions are joined (S7.3); none: polygons.
std::vector<std::int32_t> keys_of(const Scene& scene, const std::string& by) {
  const std::size_t count = scene.polygon_count();
  if (by == "polygon") return {};
  if (by == "all") return std::vector<std::int32_t>(count, 0);
  if (by == "part") return parts_of(scene);
  const fast::PlaneTable planes = fast::intern_planes(scene);
  std::vector<std::tuple<std::int32_t, bool, Rgb>> faces;
  for (std::size_t p = 0; p < count; ++p) {
    const Rgb color = scene.color(static_cast<PolygonId>(p));
    const bool is_face = by == "face";
    faces.emplace_back(is_face ? planes.plane_of[p] : 0,
                       is_face && planes.same_orientation[p], color);
  }
  return numbered(faces);
}

io::Figure figure_of(const fast::VisibleMap& map, const Scene& scene,
                     const Camera& camera, const ImageOptions& image,
                     const DrawArguments& arguments) {
  io::Figure figure;
  figure.width = camera->width_px;
  figure.height = camera->height_px;
  const auto point = [&map](std::int32_t v) {
    const fast::MapVertex& vertex = map.vertices[static_cast<std::size_t>(v)];
    return io::FigurePoint{vertex.x, vertex.y};
  };
  if (arguments.fill == "colour") {
    for (const fast::MapRegion& region : map.regions) {
      io::FigureRegion drawn;
      const bool is_background = region.item == kBackground;
      drawn.fill = is_background ? image.background : scene.color(region.item);
      drawn.title = is_background
                        ? "background"
                        : arguments.by + " " + std::to_string(region.key);
      for (std::int32_t l = 0; l < region.loop_count; ++l) {
        const auto loop = static_cast<std::size_t>(region.first_loop + l);
        std::vector<io::FigurePoint> points;
        for (std::uint32_t k = map.first_corner[loop];
             k < map.first_corner[loop + 1]; ++k)
          points.push_back(point(map.corners[k]));
        drawn.loops.push_back(std::move(points));
      }
      figure.regions.push_back(std::move(drawn));
    }
  }
  if (arguments.lines == "regions") {
    io::FigureStrokes strokes;
    strokes.width = arguments.line_width;
    for (const fast::MapArc& arc : map.arcs) {
      if (arc.left < 0 || arc.right < 0) continue;
      strokes.segments.push_back({point(arc.from), point(arc.to)});
    }
    figure.strokes.push_back(std::move(strokes));
  }
  return figure;
}

Status run_draw(const DrawArguments& arguments) {
  if (!io::is_figure_name(arguments.output)) {
    return fail(arguments.output + ": a figure's name ends in one of " +
                io::figure_format_names());
  }
  const std::string wrong =
      complaint(std::array{NamedFile{"FILE", arguments.path}},
                std::array{NamedFile{"-o", arguments.output}});
  if (!wrong.empty()) return fail(wrong);
  const Result<io::LoadedScene> loaded =
      load(arguments.path, import_options(arguments.view, arguments.grid_bits));
  if (!loaded) return fail(arguments.path, loaded.error());
  const Scene& scene = loaded->file.scene;
  const Result<ChosenCamera> chosen =
      choose_camera(loaded->file, arguments.view);
  if (!chosen) return fail(camera_error(arguments.path, chosen.error()));
  const ImageOptions image = choose_options(loaded->file, arguments.view);
  LongWork work("building the tree");
  fast::DisplayTreeOptions display;
  display.progress = [&work](double share) { return work.report(share); };
  fast::BspTree tree = fast::build_display_tree(scene, display);
  if (LongWork::interrupted()) return stop("interrupted");
  fast::divide_leaves(tree, scene);
  const Result<fast::VisibleMap> map = fast::visible_map(
      scene, tree, chosen->camera, {image.cull, keys_of(scene, arguments.by)},
      {arguments.most_cells});
  if (!map) return fail(arguments.path, map.error());
  const io::Figure figure =
      figure_of(*map, scene, chosen->camera, image, arguments);
  note_part(arguments.output);
  const Result<Done> written =
      io::write_figure(arguments.output, figure, {arguments.decimals});
  if (!written) return fail(arguments.output, written.error());
  say("{}: {} polygons; {} regions, {} arcs, {} vertices\n", arguments.path,
      scene.polygon_count(), map->regions.size(), map->arcs.size(),
      map->vertices.size());
  return Status::kFine;
}

}  // namespace

void add_draw(CLI::App& program, Status& status) {
  CLI::App* app = program.add_subcommand(
      "draw", "Draw a mesh as vectors: exact regions without seams");
  const auto arguments = std::make_shared<DrawArguments>();
  app->add_option("FILE", arguments->path, "A mesh or a .scene")
      ->required()
      ->type_name("");
  app->add_option("-o,--output", arguments->output,
                  "The figure: " + io::figure_format_names())
      ->required()
      ->type_name("OUT");
  app->add_option("--by", arguments->by,
                  "Which polygons make one region where they meet")
      ->check(CLI::IsMember({"polygon", "face", "colour", "part", "all"}))
      ->capture_default_str();
  app->add_option("--fill", arguments->fill, "What regions are filled with")
      ->check(CLI::IsMember({"colour", "none"}))
      ->capture_default_str();
  app->add_option("--lines", arguments->lines,
                  "Lines over the fills: none, or the borders of regions")
      ->check(CLI::IsMember({"none", "regions"}))
      ->capture_default_str();
  app->add_option("--line-width", arguments->line_width, "In pixels")
      ->check(CLI::Range(0.001, 1000.0))
      ->capture_default_str();
  app->add_option("--decimals", arguments->decimals,
                  "Of coordinates, in pixels")
      ->check(CLI::Range(0, 12))
      ->capture_default_str();
  app->add_option("--most-cells", arguments->most_cells,
                  "Give up where the map needs more cells")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1} << 31))
      ->capture_default_str();
  add_grid_option(*app, arguments->grid_bits);
  add_view_options(*app, arguments->view);
  add_quiet_option(*app);
  app->footer(
      "What is seen is worked out exactly (spec/S7-map.md): no region is in "
      "the wrong\nplace, and neighbours share their border to the digit.\n\n"
      "Examples:\n"
      "  halfspace draw part.stl -o part.svg\n"
      "  halfspace draw part.off -o part.pdf --by part --lines regions");
  app->callback([arguments, &status] { status = run_draw(*arguments); });
}

}  // namespace halfspace::tools
