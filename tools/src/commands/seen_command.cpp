#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Validators.hpp>
#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/command.hpp"
#include "cli/loading.hpp"
#include "cli/long_work.hpp"
#include "cli/options.hpp"
#include "cli/outputs.hpp"
#include "figure/figure_scene.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/image/seen_areas.hpp"
#include "halfspace/io/file.hpp"
#include "halfspace/io/number.hpp"
#include "halfspace/panorama.hpp"
#include "image/viewing.hpp"

namespace halfspace::tools {
namespace {

struct SeenArguments {
  std::vector<std::string> paths;
  std::string by = "polygon";
  std::string csv_file = "-";
  std::optional<std::string> eyes_file;
  std::optional<std::string> directions_file;
  bool panorama = false;
  bool exact = false;
  std::optional<int> grid_bits;
  ViewArguments view;
};

/// What is seen of a key in one view, or all round an eye.
struct SeenRow {
  double square_pixels = 0;
  double steradians = 0;
  std::string exact;  ///< square pixels
};

/// A view: one camera, or the six of a panorama.
struct SeenView {
  std::vector<Camera> cameras;
  /// The area of a square pixel across the view; 0 in perspective. Units:
  /// squares of model units.
  double pixel_area = 0;
};

/// The points of a file, one a line: X,Y,Z.
/// Errors: those of io::read_file(); kSyntax, with the line; kEmpty.
Result<std::vector<glm::dvec3>> read_points(const std::string& path,
                                            bool may_be_zero) {
  const Result<std::string> text = io::read_file(path);
  if (!text) return text.error();
  std::vector<glm::dvec3> points;
  int number = 0;
  for (std::string_view rest = *text; !rest.empty();) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    ++number;
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.empty()) continue;
    const std::optional<glm::dvec3> point = parse_vector(line);
    if (!point || (!may_be_zero && *point == glm::dvec3(0))) {
      return Error{
          ErrorCode::kSyntax,
          fmt::format("{}:{}: expected X,Y,Z, three numbers{}, not '{}'", path,
                      number, may_be_zero ? "" : " that are not all 0",
                      line.substr(0, 40))};
    }
    points.push_back(*point);
  }
  if (points.empty())
    return Error{ErrorCode::kEmpty, path + ": there is no line X,Y,Z"};
  return points;
}

/// Works out what is seen, view by view, as text for a table.
class SeenTable {
 public:
  SeenTable(const FigureScene& loaded, const SeenArguments& arguments,
            bool cull, const fast::BspTree& tree)
      : scene_(loaded.scene()),
        tree_(tree),
        options_{cull, keys_of(loaded, arguments.by)},
        is_exact_(arguments.exact) {
    keys_ = static_cast<std::int32_t>(scene_.polygon_count());
    if (!options_.keys.empty()) {
      keys_ = 1 + *std::max_element(options_.keys.begin(), options_.keys.end());
    }
    csv_ = "view,key,square_pixels,steradians,projected_area";
    csv_ += is_exact_ ? ",exact_square_pixels\n" : "\n";
  }

  /// Errors: those of the map.
  Result<Done> add(const SeenView& view) {
    std::vector<SeenRow> rows(static_cast<std::size_t>(keys_) + 1);
    for (const Camera& camera : view.cameras) {
      const Result<fast::VisibleMap> map =
          fast::visible_map(scene_, tree_, camera, options_);
      if (!map) return map.error();
      for (const fast::SeenArea& area : fast::seen_areas(*map, camera)) {
        SeenRow& row = rows[static_cast<std::size_t>(area.key + 1)];
        row.square_pixels += area.area_px;
        row.steradians += area.solid_angle;
        if (is_exact_) row.exact = fast::exact_seen_area(*map, area.key);
      }
    }
    write(rows, view);
    return Done{};
  }

  const std::string& csv() const { return csv_; }
  std::int32_t views() const { return views_; }
  std::int32_t keys() const { return keys_; }
  std::size_t keys_seen() const { return seen_.size(); }

 private:
  void write(const std::vector<SeenRow>& rows, const SeenView& view) {
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const std::int32_t key = static_cast<std::int32_t>(k) - 1;
      const SeenRow& row = rows[k];
      if (key >= 0 && row.square_pixels > 0) seen_.insert(key);
      csv_ += fmt::format("{},{},", views_, key);
      // Pixels of six images are not one measure.
      if (view.cameras.size() == 1)
        csv_ += fmt::format("{}", row.square_pixels);
      csv_ += ',';
      if (view.pixel_area == 0) csv_ += fmt::format("{}", row.steradians);
      csv_ += ',';
      if (view.pixel_area != 0)
        csv_ += fmt::format("{}", row.square_pixels * view.pixel_area);
      if (is_exact_) csv_ += ',' + (row.exact.empty() ? "0" : row.exact);
      csv_ += '\n';
    }
    ++views_;
  }

  const Scene& scene_;
  const fast::BspTree& tree_;
  MapOptions options_;
  bool is_exact_;
  std::int32_t keys_ = 0;
  std::int32_t views_ = 0;
  std::set<std::int32_t> seen_;
  std::string csv_;
};

/// The length of a lattice step. Units: model units.
double lattice_step(const Unit& unit) {
  return io::to_double(
             {1, unit.exponent, unit.base == 10 ? unit.exponent : 0}) /
         (1 << kLatticeBits);
}

Result<SeenView> view_of(const FigureScene& loaded, const ViewArguments& wanted,
                         bool all_round) {
  const Result<ChosenCamera> chosen = choose_camera(loaded.file, wanted);
  if (!chosen) {
    return Error{chosen.error().code,
                 camera_error(loaded.name, chosen.error())};
  }
  const Camera& camera = chosen->camera;
  if (all_round) {
    const auto cameras = panorama(camera->eye, loaded.scene().grid_bits());
    if (!cameras) return cameras.error();
    return SeenView{{cameras->begin(), cameras->end()}, 0};
  }
  if (camera->perspective) return SeenView{{camera}, 0};
  const double step = lattice_step(loaded.scene().unit());
  return SeenView{{camera}, fast::pixel_area(camera) * step * step};
}

/// The arguments with an eye there, which looks anywhere.
ViewArguments with_eye(ViewArguments view, const Scene& scene,
                       const glm::dvec3& eye) {
  view.eye = eye;
  if (!view.target && io::middle_of(scene) == eye)
    view.target = eye + glm::dvec3(0, std::max(1.0, glm::length(eye)), 0);
  return view;
}

/// The arguments with a parallel view from a direction.
ViewArguments with_direction(ViewArguments view, const glm::dvec3& to_eye) {
  const bool is_vertical = to_eye.x == 0 && to_eye.y == 0;
  view.view = {to_eye, is_vertical ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1)};
  view.orthographic = true;
  return view;
}

/// The views that the arguments ask for.
Result<std::vector<SeenView>> views_of(const FigureScene& loaded,
                                       const SeenArguments& arguments) {
  std::vector<ViewArguments> wanted;
  if (arguments.eyes_file) {
    const auto eyes = read_points(*arguments.eyes_file, true);
    if (!eyes) return eyes.error();
    for (const glm::dvec3& eye : *eyes)
      wanted.push_back(with_eye(arguments.view, loaded.scene(), eye));
  } else if (arguments.directions_file) {
    const auto directions = read_points(*arguments.directions_file, false);
    if (!directions) return directions.error();
    for (const glm::dvec3& to_eye : *directions)
      wanted.push_back(with_direction(arguments.view, to_eye));
  } else if (arguments.panorama && arguments.view.eye) {
    wanted.push_back(
        with_eye(arguments.view, loaded.scene(), *arguments.view.eye));
  } else {
    wanted.push_back(arguments.view);
  }
  std::vector<SeenView> views;
  for (const ViewArguments& view : wanted) {
    Result<SeenView> made = view_of(
        loaded, view, arguments.panorama || arguments.eyes_file.has_value());
    if (!made) return made.error();
    views.push_back(std::move(*made));
  }
  return views;
}

std::string complaint_of(const SeenArguments& arguments) {
  std::vector<NamedFile> inputs;
  for (const std::string& path : arguments.paths)
    inputs.push_back({"FILE", path});
  inputs.push_back({"--eyes", arguments.eyes_file.value_or("")});
  inputs.push_back({"--directions", arguments.directions_file.value_or("")});
  if ((arguments.panorama || arguments.eyes_file) &&
      (arguments.view.orthographic || arguments.view.ortho_height))
    return "--ortho: a parallel view has no eye to see all round from";
  if (arguments.exact && (arguments.panorama || arguments.eyes_file))
    return "--exact: all round an eye there are solid angles, which are not "
           "rational";
  return complaint(inputs, std::array{NamedFile{"--csv", arguments.csv_file}});
}

Status run_seen(const SeenArguments& arguments) {
  const std::string wrong = complaint_of(arguments);
  if (!wrong.empty()) return fail(wrong);
  const Result<FigureScene> loaded = load_figure(
      arguments.paths, import_options(arguments.view, arguments.grid_bits));
  if (!loaded) return fail(arguments.paths[0], loaded.error());
  if (loaded->scene().polygon_count() == 0)
    return fail(loaded->name + ": there are no polygons to be seen");
  const auto views = views_of(*loaded, arguments);
  if (!views) return fail(views.error().message);
  LongWork work("looking");
  fast::BspTree tree = fast::build_display_tree(loaded->scene());
  fast::divide_leaves(tree, loaded->scene());
  SeenTable table(*loaded, arguments,
                  choose_options(loaded->file, arguments.view).cull, tree);
  for (std::size_t v = 0; v < views->size(); ++v) {
    const Result<Done> added = table.add((*views)[v]);
    if (!added) return fail(loaded->name, added.error());
    work.report(static_cast<double>(v + 1) /
                static_cast<double>(views->size()));
    if (LongWork::interrupted()) return stop("interrupted");
  }
  const Result<Done> written = write_output(arguments.csv_file, table.csv());
  if (!written) return fail(arguments.csv_file, written.error());
  if (arguments.csv_file != "-") {
    say("{}: {} views; {} of {} {}s are seen in any\n", loaded->name,
        table.views(), table.keys_seen(), table.keys(), arguments.by);
  }
  return Status::kFine;
}

}  // namespace

void add_seen(CLI::App& program, Status& status) {
  CLI::App* app = program.add_subcommand(
      "seen", "Measure how much of each polygon or part is seen");
  const auto arguments = std::make_shared<SeenArguments>();
  app->add_option("FILE", arguments->paths, "Meshes, or one .scene")
      ->required()
      ->type_name("");
  app->add_option("--csv", arguments->csv_file,
                  "Where the table goes; `-` is standard output")
      ->capture_default_str()
      ->type_name("FILE.csv");
  app->add_option("--by", arguments->by, "What has a row of its own")
      ->check(CLI::IsMember({"polygon", "face", "colour", "part", "file"}))
      ->capture_default_str();
  app->add_flag("--panorama", arguments->panorama,
                "Look all round from the eye: solid angles add up to 4 pi");
  CLI::Option* eyes =
      app->add_option("--eyes", arguments->eyes_file,
                      "A panorama from each point of a file, X,Y,Z a line")
          ->type_name("FILE.csv");
  app->add_option("--directions", arguments->directions_file,
                  "A parallel view from each direction of a file, such as the "
                  "sun's, X,Y,Z a line")
      ->excludes(eyes)
      ->type_name("FILE.csv");
  app->add_flag("--exact", arguments->exact,
                "Areas as rationals, too, in square pixels");
  add_grid_option(*app, arguments->grid_bits);
  add_view_options(*app, arguments->view);
  add_quiet_option(*app);
  app->footer(
      "Areas are those of the visible map (spec/S7-map.md, S7.7), exact and "
      "then rounded\nonce. Key -1 is the background.\n\n"
      "Examples:\n"
      "  halfspace seen room.obj --by part --panorama --eye 1,2,1.6\n"
      "  halfspace seen house.obj --directions suns.csv --csv sunlit.csv");
  app->callback([arguments, &status] { status = run_seen(*arguments); });
}

}  // namespace halfspace::tools
