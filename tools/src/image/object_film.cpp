#include "image/object_film.hpp"

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
#include "cli/outputs.hpp"
#include "halfspace/boolean.hpp"
#include "halfspace/cap_parts.hpp"
#include "halfspace/fast/image/moving.hpp"
#include "halfspace/ref/moving.hpp"
#include "halfspace/ref/oracle/painter.hpp"
#include "halfspace/ref/oracle/raycast.hpp"
#include "halfspace/ref/oracle/zbuffer.hpp"
#include "image/camera_path.hpp"
#include "image/object_file.hpp"

namespace halfspace::tools {
namespace {

std::string object_complaint(const RenderArguments& arguments) {
  const auto not_for = [](const std::string& option) {
    return option + ": is not for objects; leave it out";
  };
  if (arguments.anti_aliasing) return not_for("--aa");
  if (arguments.screen) return not_for("--screen");
  if (arguments.lazy) return not_for("--lazy");
  if (arguments.priority) return not_for("--priority");
  if (arguments.scalars.source) return not_for("--scalar");
  if (arguments.lines.edges) return not_for("--lines");
  if (arguments.alpha) return not_for("--alpha");
  if (arguments.back_color) return not_for("--back-color");
  if (arguments.shadow) return not_for("--shadow");
  if (arguments.rows) return not_for("--rows");
  if (arguments.tree_file) return not_for("--tree");
  if (arguments.turntable) return not_for("--turntable");
  if (arguments.build.rule) return not_for("--heuristic");
  const auto& background = arguments.view.background;
  if (background && background->style != Background::Style::kColor)
    return not_for("--background gradient or none");
  return {};
}

/// Draws a file of objects, frame by frame.
class ObjectFilm {
 public:
  ObjectFilm(const RenderArguments& arguments, ObjectFile file)
      : arguments_(arguments), file_(std::move(file)) {
    for (const NamedObject& object : file_.objects)
      start_.push_back(object.stand);
  }

  const ObjectFile& file() const { return file_; }
  const fast::MovingTrees& trees() const { return trees_; }
  double build_ms() const { return build_ms_; }

  std::optional<Error> prepare() {
    if (arguments_.clip.caps) {
      if (auto error = prepare_caps()) return error;
    }
    if (library_of(arguments_) == Library::kRef) {
      const Result<Done> is_free = ref::check_free(file_.assembly);
      if (!is_free && !file_.cut) return is_free.error();
      return std::nullopt;
    }
    const Stopwatch watch;
    Result<fast::MovingTrees> trees = fast::build_moving_trees(
        file_.assembly,
        file_.cut ? fast::InRegion::kCut : fast::InRegion::kError);
    if (!trees) return trees.error();
    trees_ = *std::move(trees);
    build_ms_ = watch.elapsed_ms();
    return std::nullopt;
  }

  /// The stands of all objects in a frame of the path.
  std::vector<Stand> stands_at(const CameraPath* path,
                               std::int64_t frame) const {
    std::vector<Stand> stands = start_;
    for (std::size_t k = 0; path != nullptr && k < stands.size(); ++k)
      stands[k] = path->stand_at(file_.objects[k].name, frame, start_[k]);
    return stands;
  }

  /// An object of which the path speaks and the file does not.
  std::optional<std::string> unknown_in(const CameraPath& path) const {
    for (const std::string& name : path.objects()) {
      const bool is_known =
          std::any_of(file_.objects.begin(), file_.objects.end(),
                      [&](const auto& object) { return object.name == name; });
      if (!is_known) return name;
    }
    return std::nullopt;
  }

  /// The error of a placement, with the object's name in the file.
  Error named(Error error) const {
    const auto& occurrences = file_.assembly.occurrences();
    if (error.index < 0 || error.index >= std::ssize(occurrences)) return error;
    const Occurrence& here = occurrences[static_cast<std::size_t>(error.index)];
    const Occurrence& owner = occurrences[static_cast<std::size_t>(here.owner)];
    for (const NamedObject& object : file_.objects) {
      if (static_cast<std::int32_t>(object.owner) == owner.model &&
          static_cast<std::int32_t>(object.object) == here.object) {
        error.message = object.name + ": " + error.message;
      }
    }
    return error;
  }

  Result<Frame> draw(const Camera& camera, const std::vector<Stand>& stands) {
    const Result<Placement> placement =
        make_placement(file_.assembly, pose_of(file_, stands));
    if (!placement) return named(placement.error());
    Frame frame;
    frame.options = choose_options(file_.world.file, arguments_.view);
    const Result<Done> clipped = add_clips(file_.world.file.scene, camera,
                                           arguments_.clip, frame.options);
    if (!clipped) return clipped.error();
    frame.options.parts = parts_;
    std::vector<double> times_ms;
    for (std::uint32_t i = 0; i < arguments_.repeat.value_or(1); ++i) {
      const Stopwatch watch;
      Result<Picture> picture = draw_placed(*placement, camera, frame.options);
      if (!picture) return picture.error();
      frame.picture = *std::move(picture);
      times_ms.push_back(watch.elapsed_ms());
    }
    frame.frame_ms = median(std::move(times_ms));
    return frame;
  }

 private:
  /// Caps are of surfaces that are closed, and stay so.
  std::optional<Error> prepare_caps() {
    const Assembly& assembly = file_.assembly;
    if (arguments_.clip.planes.empty() && !arguments_.clip.yon) {
      return Error{ErrorCode::kEmpty,
                   "--cap: needs --clip, which says what is cut"};
    }
    if (file_.cut) {
      return Error{ErrorCode::kOpen,
                   "--cap: only cuts of solids are filled, and what is `cut` "
                   "away of one leaves it open"};
    }
    for (const Model& model : assembly.models()) {
      if (!bad_edges(model.scene).empty()) {
        return Error{ErrorCode::kOpen,
                     "--cap: only cuts of solids are filled, and one of the "
                     "models is not closed"};
      }
    }
    const auto& [style, by] = *arguments_.clip.caps;
    if (by == CapsBy::kFile) {
      return Error{ErrorCode::kUnknownFormat,
                   "--cap: file is for draw, which takes several; give part"};
    }
    if (by != CapsBy::kPart) return std::nullopt;
    std::vector<std::uint32_t> part_of(assembly.polygon_count());
    const auto& occurrences = assembly.occurrences();
    for (std::size_t o = 0; o < occurrences.size(); ++o) {
      const Scene& scene = assembly.model(occurrences[o].model).scene;
      std::fill_n(part_of.begin() + occurrences[o].first_polygon,
                  scene.polygon_count(), static_cast<std::uint32_t>(o));
    }
    parts_ = told_apart(std::move(part_of), style);
    return std::nullopt;
  }

  template <class Rendering>
  static Picture picture_of(Rendering rendering) {
    return {std::move(rendering.items), std::move(rendering.colors),
            rendering.pixels_painted, rendering.fragments_displayed};
  }

  Result<Picture> draw_placed(const Placement& placement, const Camera& camera,
                              const ImageOptions& options) const {
    const Assembly& assembly = file_.assembly;
    if (library_of(arguments_) == Library::kFast) {
      fast::RenderOptions how;
      how.threads = thread_count(arguments_.build);
      how.simd = arguments_.simd.value_or(fast::SimdLevel::kBest);
      return picture_of(fast::render_moving(assembly, trees_, placement, camera,
                                            options, how));
    }
    const Method method = method_of(arguments_);
    if (method == Method::kSpan) {
      return picture_of(
          ref::render_moving(assembly, placement, camera, options));
    }
    // The oracles draw ordinary scenes.
    if (!ref::check_free(assembly)) {
      return Error{ErrorCode::kOutOfRange,
                   "--method: what is cut away is drawn by span alone"};
    }
    const auto flat = ref::flat_scene(assembly, placement, camera);
    if (!flat) return flat.error();
    const auto own = ref::flat_options(*flat, options);
    if (!own) return own.error();
    const Scene& scene = flat->scene;
    const Camera& view = flat->camera;
    Picture picture =
        picture_of(method == Method::kZBuffer ? ref::zbuffer(scene, view, *own)
                   : method == Method::kRayCast
                       ? ref::raycast(scene, view, *own)
                       : ref::paint(scene, ref::build(scene, {}), view, *own));
    for (PolygonId& item : picture.items.pixels)
      item = ref::moved_item(assembly, *flat, item);
    return picture;
  }

  const RenderArguments& arguments_;
  ObjectFile file_;
  std::vector<Stand> start_;
  std::shared_ptr<const CapParts> parts_;  ///< each object one
  fast::MovingTrees trees_;
  double build_ms_ = 0;
};

Status conclude_objects(const ObjectFilm& film, const Frame& frame,
                        std::int64_t frames, const RenderArguments& arguments) {
  const Assembly& assembly = film.file().assembly;
  if (arguments.build.stats_file != "-") {
    say("{}: {} polygons in {} objects of {} models\n", arguments.path,
        assembly.polygon_count(), assembly.occurrences().size() - 1,
        assembly.models().size() - 1);
    say("trees: {} bytes, {:.1f} ms\n", fast::bytes_of(film.trees()),
        film.build_ms());
    say("{}x{}, {} frames, the median {:.3f} ms\n",
        frame.picture.colors.width_px, frame.picture.colors.height_px, frames,
        frame.frame_ms);
  }
  if (!arguments.build.stats_file) return Status::kFine;
  nlohmann::json stats;
  stats["polygons"] = assembly.polygon_count();
  stats["objects"] = assembly.occurrences().size() - 1;
  stats["models"] = assembly.models().size() - 1;
  stats["tree_bytes"] = fast::bytes_of(film.trees());
  stats["allocated_bytes"] = allocated_bytes();
  stats["build_ms"] = film.build_ms();
  stats["frame_ms"] = frame.frame_ms;
  stats["frames"] = frames;
  stats["pixels_painted"] = frame.picture.pixels_painted;
  stats["fragments_displayed"] = frame.picture.fragments_displayed;
  const Result<Done> written = write_stats(*arguments.build.stats_file, stats);
  return written ? Status::kFine
                 : fail(*arguments.build.stats_file, written.error());
}

Outputs names_of(const RenderArguments& arguments,
                 std::optional<std::int64_t> number) {
  const auto numbered = [number](const std::optional<std::string>& name) {
    if (!number || !name) return name;
    const auto pattern = NumberedName::parse(*name);
    return pattern ? std::optional(pattern->with(*number)) : std::nullopt;
  };
  return {numbered(arguments.picture_file), numbered(arguments.ids_file),
          working_threads(arguments.build)};
}

Status draw_frames(ObjectFilm& film, const CameraPath* path, Range frames,
                   const RenderArguments& arguments) {
  std::vector<double> times_ms;
  Frame last;
  LongWork work("frames");
  for (std::int64_t k = *frames.first; k < *frames.end; ++k) {
    const double done = static_cast<double>(k - *frames.first) /
                        static_cast<double>(*frames.end - *frames.first);
    const std::string name =
        path != nullptr ? "frame " + std::to_string(k) + ": " : "";
    if (!work.report(done)) return stop("interrupted");
    const Result<ChosenCamera> chosen = choose_camera(
        film.file().world.file, path ? path->at(k) : arguments.view);
    if (!chosen)
      return fail(name + camera_error(arguments.path, chosen.error()));
    Result<Frame> frame = film.draw(chosen->camera, film.stands_at(path, k));
    if (!frame) {
      return fail(arguments.path + ": " + name + frame.error().message);
    }
    const Status written = write_frame(
        *frame, names_of(arguments, path ? std::optional(k) : std::nullopt));
    if (written != Status::kFine) return written;
    times_ms.push_back(frame->frame_ms);
    last = *std::move(frame);
  }
  last.frame_ms = median(std::move(times_ms));
  return conclude_objects(film, last, *frames.end - *frames.first, arguments);
}

}  // namespace

Status render_objects(const RenderArguments& arguments) {
  const std::string wrong = object_complaint(arguments);
  if (!wrong.empty()) return fail(wrong);
  Result<ObjectFile> file = read_object_file(
      arguments.path, import_options(arguments.view, arguments.grid_bits));
  if (!file) return fail(file.error().message);
  ObjectFilm film(arguments, *std::move(file));
  if (const auto error = film.prepare())
    return fail(arguments.path + ": " + error->message);
  if (!arguments.camera_path_file)
    return draw_frames(film, nullptr, {0, 1}, arguments);
  const Result<CameraPath> path =
      read_camera_path(*arguments.camera_path_file, arguments.view);
  if (!path) return fail(*arguments.camera_path_file, path.error());
  if (const auto name = film.unknown_in(*path)) {
    return fail(*arguments.camera_path_file + ": there is no object " + *name +
                " in " + arguments.path);
  }
  const Range asked = arguments.frames.value_or(Range{});
  const Range frames = {asked.first.value_or(path->first_frame()),
                        asked.end.value_or(path->last_frame() + 1)};
  if (*frames.first < path->first_frame() || *frames.first >= *frames.end ||
      *frames.end > path->last_frame() + 1) {
    return fail("--frames: the path has the frames " +
                std::to_string(path->first_frame()) + ":" +
                std::to_string(path->last_frame() + 1));
  }
  // Before anything is drawn: no object leaves its region in any frame.
  for (std::int64_t k = *frames.first; k < *frames.end; ++k) {
    const auto placed = make_placement(
        film.file().assembly, pose_of(film.file(), film.stands_at(&*path, k)));
    if (!placed) {
      return fail(arguments.path + ": frame " + std::to_string(k) + ": " +
                  film.named(placed.error()).message);
    }
  }
  return draw_frames(film, &*path, frames, arguments);
}

}  // namespace halfspace::tools
