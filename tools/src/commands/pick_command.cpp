#include <CLI/App.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/loading.hpp"
#include "cli/measuring.hpp"
#include "cli/options.hpp"
#include "cli/uncut_loading.hpp"
#include "halfspace/cap_parts.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/image/lazy_tree.hpp"
#include "halfspace/fast/ray.hpp"
#include "halfspace/io/ray.hpp"
#include "image/building.hpp"
#include "image/clipping.hpp"
#include "image/viewing.hpp"

namespace halfspace::tools {
namespace {

/// A pixel. Units: columns and rows.
struct Pixel {
  std::int32_t x = 0;
  std::int32_t y = 0;
};

struct PickArguments {
  std::string path;
  std::optional<Pixel> at;
  std::optional<glm::dvec3> from;
  std::optional<glm::dvec3> along;
  std::optional<glm::dvec3> to;
  std::optional<glm::dvec3> sees;
  bool all = false;
  bool json = false;
  bool lazy = false;
  std::optional<std::string> stats_file;
  std::optional<int> grid_bits;
  ViewArguments view;
  ClipArguments clip;
};

std::optional<Pixel> parse_pixel(std::string_view text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  const auto x = parse_number<std::int32_t>(text.substr(0, comma));
  const auto y = parse_number<std::int32_t>(text.substr(comma + 1));
  return x && y && *x >= 0 && *y >= 0 ? std::optional(Pixel{*x, *y})
                                      : std::nullopt;
}

/// What is wrong with the options taken together; empty if nothing.
std::string complaint(const PickArguments& arguments) {
  const int ends = (arguments.along ? 1 : 0) + (arguments.to ? 1 : 0) +
                   (arguments.sees ? 1 : 0);
  if (arguments.at && !arguments.from && ends == 0) {
    return arguments.all ? "--all: needs a ray: --from and --along or --to"
                         : "";
  }
  if (!arguments.at && arguments.from && ends == 1) {
    if (arguments.clip.is_used()) {
      return "--clip, --yon and --cap: cut what --at sees; rays meet the whole "
             "model";
    }
    return arguments.all && arguments.sees
               ? "--all: --sees asks whether there is anything at all"
               : "";
  }
  return "pick: give --at X,Y, a pixel, or --from and one of --along, --to and "
         "--sees";
}

/// What was found, as text and for --json.
class Report {
 public:
  Report(const io::LoadedScene& loaded, bool json)
      : loaded_(loaded), is_json_(json) {}

  void add(PolygonId polygon, const glm::dvec3& point, double distance,
           const std::string& parameter) {
    nlohmann::json hit = {
        {"polygon", polygon},
        {"file_polygon", loaded_.polygons[static_cast<std::size_t>(polygon)]},
        {"point", {point.x, point.y, point.z}},
        {"distance", distance}};
    if (!parameter.empty()) hit["parameter"] = parameter;
    hits_.push_back(std::move(hit));
    if (is_json_) return;
    print(fmt::format("polygon {}  point {}, {}, {}  distance {}{}\n", polygon,
                      point.x, point.y, point.z, distance,
                      parameter.empty() ? "" : "  t " + parameter));
  }
  void add_cap(const CapItem& cap, const CapParts* parts) {
    nlohmann::json hit = {{"cap_of_clip_plane", cap.plane}};
    std::string text = fmt::format("cap of clip plane {}", cap.plane);
    if (parts != nullptr && cap.part == parts->count()) {
      hit["part"] = "several";
      text += "  several parts";
    } else if (parts != nullptr) {
      hit["part"] = cap.part;
      text += fmt::format("  part {}", cap.part);
    }
    hits_.push_back(std::move(hit));
    if (!is_json_) print(text + "\n");
  }
  void finish() {
    if (is_json_) {
      print(nlohmann::json{{"hits", hits_}}.dump(2) + "\n");
    } else if (hits_.empty()) {
      print("nothing\n");
    }
  }

 private:
  const io::LoadedScene& loaded_;
  bool is_json_;
  nlohmann::json hits_ = nlohmann::json::array();
};

/// A tree that is asked: one that is whole, or one of which that is built
/// that the question comes to (S3.12).
class AskedTree {
  template <class Question>
  auto timed(const Question& question) {
    const Stopwatch watch;
    auto answer = question();
    ask_ms_ = watch.elapsed_ms();
    return answer;
  }

 public:
  AskedTree(const Scene& scene, bool lazy) : scene_(scene) {
    fast::DisplayTreeOptions options;
    // Leaves are searched one polygon after the other.
    options.leaf_size = 8;
    const Stopwatch watch;
    const WallClock clock;
    if (lazy) {
      lazy_.emplace(scene, fast::LazyTreeOptions{.tree = options});
    } else {
      tree_ = fast::build_display_tree(scene, options);
    }
    measure_.build_ms = watch.elapsed_ms();
    measure_.wall_ms = clock.elapsed_ms();
    measure_.library = "fast";
    measure_.kind = lazy ? "lazy" : "display";
    measure_.is_lazy = lazy;
    measure_.bytes = lazy ? lazy_->stats().bytes : fast::bytes_of(tree_);
    if (!lazy) measure_.stats = fast::stats(tree_);
  }

  PolygonId pick(const Camera& camera, const ImageOptions& options, Pixel at) {
    return timed([&] {
      return lazy_ ? fast::pick(*lazy_, camera, options, at.x, at.y)
                   : fast::pick(scene_, tree_, camera, options, at.x, at.y);
    });
  }
  bool see_each_other(const Ray& between) {
    return timed([&] {
      return lazy_ ? fast::see_each_other(*lazy_, between)
                   : fast::see_each_other(scene_, tree_, between);
    });
  }
  /// All hits, or the first if there is one.
  std::vector<RayHit> hits(const Ray& ray, bool all) {
    return timed([&]() -> std::vector<RayHit> {
      if (all) {
        return lazy_ ? fast::all_hits(*lazy_, ray)
                     : fast::all_hits(scene_, tree_, ray);
      }
      const std::optional<RayHit> first =
          lazy_ ? fast::first_hit(*lazy_, ray)
                : fast::first_hit(scene_, tree_, ray);
      return first ? std::vector{*first} : std::vector<RayHit>();
    });
  }

  /// Writes what `--stats` says, if it was asked for.
  Status report(const std::optional<std::string>& path,
                const io::LoadedScene& loaded) const {
    if (!path) return Status::kFine;
    nlohmann::json stats = stats_of(loaded, measure_);
    stats["ask_ms"] = ask_ms_;
    if (lazy_) add_cells(lazy_->stats(), stats);
    const Result<Done> written = write_stats(*path, stats);
    return written ? Status::kFine : fail(*path, written.error());
  }

 private:
  static void add_cells(const fast::LazyTreeStats& built,
                        nlohmann::json& stats) {
    stats["cells"] = built.cells;
    stats["cells_built"] = built.cells_built;
    stats["polygons_built"] = built.polygons_built;
    stats["fragments_built"] = built.fragments;
    stats["bytes_built"] = built.bytes;
  }

  const Scene& scene_;
  fast::BspTree tree_;
  std::optional<fast::LazyTree> lazy_;  ///< instead of that
  BuildMeasure measure_;
  double ask_ms_ = 0;
};

Status run_pixel(const PickArguments& arguments, io::LoadedScene& loaded) {
  std::string wrong = cut_complaint(arguments.clip, arguments.view.near);
  if (wrong.empty()) wrong = prepare_caps(loaded.file, arguments.clip);
  if (!wrong.empty()) return fail(wrong);
  const Result<ChosenCamera> chosen =
      choose_camera(loaded.file, arguments.view);
  if (!chosen) return fail(camera_error(arguments.path, chosen.error()));
  const Camera& camera = chosen->camera;
  const auto& [x, y] = *arguments.at;
  if (x >= camera->width_px || y >= camera->height_px) {
    return fail(
        fmt::format("--at: the image has the columns 0 to {} and the "
                    "rows 0 to {}",
                    camera->width_px - 1, camera->height_px - 1));
  }
  const Scene& scene = loaded.file.scene;
  ImageOptions options = choose_options(loaded.file, arguments.view);
  const Result<Done> clipped =
      add_clips(scene, camera, arguments.clip, options);
  if (!clipped) return fail(clipped.error().message);
  AskedTree tree(scene, arguments.lazy);
  const PolygonId polygon = tree.pick(camera, options, *arguments.at);
  Report report(loaded, arguments.json);
  const auto count = static_cast<PolygonId>(scene.polygon_count());
  if (polygon >= count) {
    report.add_cap(cap_item(static_cast<std::size_t>(polygon - count)),
                   options.parts.get());
  } else if (polygon != kBackground) {
    const io::PixelPoint at = io::pixel_point(scene, camera, polygon, x, y);
    report.add(polygon, at.point, at.distance, "");
  }
  report.finish();
  return tree.report(arguments.stats_file, loaded);
}

Status run_sees(const PickArguments& arguments, const io::LoadedScene& loaded) {
  const Scene& scene = loaded.file.scene;
  const Result<io::RoundedRay> ray =
      io::ray_between(scene, *arguments.from, *arguments.sees, Reach::kBetween);
  if (!ray) return fail("--sees: " + ray.error().message);
  AskedTree tree(scene, arguments.lazy);
  const bool see = tree.see_each_other(ray->ray);
  print(arguments.json ? nlohmann::json{{"visible", see}}.dump(2) + "\n"
                       : std::string(see ? "visible\n" : "hidden\n"));
  return tree.report(arguments.stats_file, loaded);
}

Status run_ray(const PickArguments& arguments, const io::LoadedScene& loaded) {
  const Scene& scene = loaded.file.scene;
  const Result<io::RoundedRay> made =
      arguments.along ? io::ray_along(scene, *arguments.from, *arguments.along)
                      : io::ray_between(scene, *arguments.from, *arguments.to,
                                        Reach::kSegment);
  if (!made)
    return fail((arguments.along ? "--along: " : "--to: ") +
                made.error().message);
  const Ray& ray = made->ray;
  AskedTree tree(scene, arguments.lazy);
  Report report(loaded, arguments.json);
  for (const RayHit& hit : tree.hits(ray, arguments.all)) {
    report.add(hit.polygon, io::point_of(hit, ray, scene.unit()),
               io::distance_of(hit, ray, scene.unit()),
               io::exact_parameter_of(hit));
  }
  report.finish();
  return tree.report(arguments.stats_file, loaded);
}

Status run_pick(const PickArguments& arguments) {
  const std::string wrong = complaint(arguments);
  if (!wrong.empty()) return fail(wrong);
  Result<io::LoadedScene> loaded = load_uncut(
      arguments.path, import_options(arguments.view, arguments.grid_bits));
  if (!loaded) return fail(arguments.path, loaded.error());
  if (arguments.at) return run_pixel(arguments, *loaded);
  return arguments.sees ? run_sees(arguments, *loaded)
                        : run_ray(arguments, *loaded);
}

}  // namespace

void add_pick(CLI::App& program, Status& status) {
  CLI::App* app = program.add_subcommand(
      "pick", "Say what a pixel sees, or what a ray hits");
  const auto arguments = std::make_shared<PickArguments>();
  app->add_option("FILE", arguments->path, "A mesh or a .scene")
      ->required()
      ->type_name("");
  add_parsed(*app, "--at", "X,Y", "X,Y, a column and a row from 0 on",
             arguments->at, parse_pixel,
             "What is seen at this pixel, of the image that render makes with "
             "the same options");
  const std::string group = "Ray";
  add_vector(*app, "--from", arguments->from, "Where the ray begins")
      ->group(group);
  add_vector(*app, "--along", arguments->along, "In which direction it goes")
      ->group(group);
  add_vector(*app, "--to", arguments->to, "Where it ends")->group(group);
  add_vector(*app, "--sees", arguments->sees,
             "Whether nothing is between --from and this point")
      ->group(group);
  app->add_flag("--all", arguments->all, "All hits in order, not the first")
      ->group(group);
  app->add_flag("--json", arguments->json, "As JSON");
  app->add_flag("--lazy", arguments->lazy,
                "Build of the tree what the question comes to: the answer is "
                "there sooner, and the same");
  app->add_option("--stats", arguments->stats_file,
                  "Write sizes and processor times as JSON; - is standard "
                  "output")
      ->type_name("FILE.json");
  add_grid_option(*app, arguments->grid_bits);
  add_view_options(*app, arguments->view);
  add_clip_options(*app, arguments->clip);
  add_quiet_option(*app);
  app->footer(
      "Polygons are those of --ids. Which are hit is decided exactly; t is the "
      "exact\nshare of the way, distance and point are rounded once "
      "(spec/S8-rays.md).\n\n"
      "Examples:\n"
      "  halfspace pick part.stl --at 320,240\n"
      "  halfspace pick part.stl --from 0,0,90 --along 0,0,-1 --all\n"
      "  halfspace pick part.stl --from 0,0,9 --sees 5,5,0 --lazy");
  app->callback([arguments, &status] { status = run_pick(*arguments); });
}

}  // namespace halfspace::tools
