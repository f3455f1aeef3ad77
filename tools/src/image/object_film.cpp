#include "image/object_film.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
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
#include "halfspace/fast/image/flat_scene.hpp"
#include "halfspace/fast/image/moving.hpp"
#include "halfspace/io/scalars.hpp"
#include "halfspace/ref/moving.hpp"
#include "image/film.hpp"
#include "image/object_file.hpp"

namespace halfspace::tools {
namespace {

std::string object_complaint(const RenderArguments& arguments) {
  const auto not_for = [](const std::string& option) {
    return option + ": is not for objects, each of which has a tree of its own";
  };
  if (arguments.lazy) return not_for("--lazy");
  if (arguments.tree_file) return not_for("--tree");
  if (arguments.build.rule) return not_for("--heuristic");
  if (arguments.shadow)
    return "--shadow: checks images of one scene, none of objects";
  return {};
}

/// What asks for a scene of all that has moved (S12.7): an option's name, or
/// nothing where objects are displayed from their own trees.
std::string flat_reason(const RenderArguments& arguments) {
  if (arguments.anti_aliasing) return "--aa";
  if (arguments.alpha) return "--alpha";
  if (arguments.lines.edges) return "--lines";
  if (arguments.back_color) return "--back-color";
  if (arguments.scalars.source) return "--scalar";
  if (arguments.screen) return "--screen";
  if (arguments.priority) return "--priority";
  const Method method = method_of(arguments);
  if (library_of(arguments) == Library::kRef && method != Method::kSpan)
    return "--method";
  return {};
}

/// By corner of a model the numbers of a PLY's property; no data where it has
/// none of that name.
Result<std::vector<double>> corner_numbers(const ModelFile& model,
                                           const std::string& property) {
  const SceneData& data = model.loaded.file.scene.data();
  const auto names = io::ply_scalar_names(model.path);
  std::vector<double> numbers(data.corners.size(), kNoData);
  if (std::find(names.begin(), names.end(), property) == names.end())
    return numbers;
  const auto column = io::read_ply_scalars(model.path, property);
  if (!column) return column.error();
  Result<ScalarField> field = io::scalars_of(model.loaded, *column);
  if (!field) return io::error_about(model.path, field.error());
  if (field->at_corners) return std::move(field->values);
  for (std::size_t p = 0; p < field->values.size(); ++p) {
    std::fill(numbers.begin() + data.first_corner[p],
              numbers.begin() + data.first_corner[p + 1], field->values[p]);
  }
  return numbers;
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

  const std::optional<ShownScalars>& scalars() const { return scalars_; }

  std::optional<Error> prepare() {
    if (arguments_.clip.caps) {
      if (auto error = prepare_caps()) return error;
    }
    if (arguments_.scalars.source) {
      if (auto error = prepare_scalars()) return error;
    }
    const std::string reason = flat_reason(arguments_);
    if (file_.cut && !reason.empty()) {
      return Error{ErrorCode::kOutOfRange,
                   reason +
                       ": draws whole polygons, and what is `cut` away is "
                       "drawn by span alone"};
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
    error.message = with_object_names(std::move(error.message), file_);
    return error;
  }

  Result<Frame> draw(const Camera& camera, const std::vector<Stand>& stands,
                     const ClipArguments& clip) {
    const Result<Placement> placement =
        make_placement(file_.assembly, pose_of(file_, stands));
    if (!placement) return named(placement.error());
    RenderArguments now = arguments_;
    now.clip = clip;
    Result<ImageOptions> options = image_options(file_.world(), camera, now);
    if (!options) return options.error();
    options->parts = parts_;
    if (!flat_reason(arguments_).empty())
      return draw_flat(*placement, camera, *options);
    return draw_from_trees(*placement, camera, *options);
  }

 private:
  /// Caps are of surfaces that are closed, and stay so.
  std::optional<Error> prepare_caps() {
    const Assembly& assembly = file_.assembly;
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
    if (by != CapsBy::kPart && by != CapsBy::kFile) return std::nullopt;
    std::vector<std::uint32_t> part_of(assembly.polygon_count());
    const auto& occurrences = assembly.occurrences();
    for (std::size_t o = 0; o < occurrences.size(); ++o) {
      const std::int32_t model = occurrences[o].model;
      // Each object is a part, or each model's file.
      std::fill_n(part_of.begin() + occurrences[o].first_polygon,
                  assembly.model(model).scene.polygon_count(),
                  by == CapsBy::kFile ? static_cast<std::uint32_t>(model)
                                      : static_cast<std::uint32_t>(o));
    }
    parts_ = told_apart(std::move(part_of), style);
    return std::nullopt;
  }

  /// The numbers of all models have one scale.
  std::optional<Error> prepare_scalars() {
    const std::string& property = *arguments_.scalars.source;
    if (io::is_scalar_file_name(property)) {
      return Error{ErrorCode::kUnknownFormat,
                   "--scalar: objects have the numbers of their models; give a "
                   "property of a PLY"};
    }
    ScalarField all = {true, {}};
    for (const ModelFile& model : file_.files) {
      Result<std::vector<double>> numbers = corner_numbers(model, property);
      if (!numbers) return numbers.error();
      all.values.insert(all.values.end(), numbers->begin(), numbers->end());
      numbers_.push_back(*std::move(numbers));
    }
    if (std::all_of(all.values.begin(), all.values.end(),
                    [](double value) { return std::isnan(value); })) {
      return Error{
          ErrorCode::kEmpty,
          "--scalar: no model is a PLY with numbers called " + property};
    }
    Result<ShownScalars> shown =
        shown_scalars(std::move(all), arguments_.scalars);
    if (!shown) return shown.error();
    scalars_ = *std::move(shown);
    return std::nullopt;
  }

  /// The numbers of a flat scene's corners.
  ScalarField numbers_of(const FlatScene& flat) const {
    const Assembly& assembly = file_.assembly;
    std::map<PolygonId, std::int32_t> models;  // by first polygon
    for (const Occurrence& here : assembly.occurrences()) {
      if (assembly.model(here.model).scene.polygon_count() > 0)
        models[here.first_polygon] = here.model;
    }
    ScalarField field = {true, {}};
    field.values.reserve(flat.corners.size());
    for (std::size_t p = 0; p < flat.ids.size(); ++p) {
      const auto& numbers = numbers_[static_cast<std::size_t>(
          std::prev(models.upper_bound(flat.ids[p]))->second)];
      const auto& first = flat.scene.data().first_corner;
      for (std::size_t k = first[p]; k < first[p + 1]; ++k)
        field.values.push_back(numbers[flat.corners[k]]);
    }
    return field;
  }

  /// As any other scene is drawn, with a tree of this frame.
  Result<Frame> draw_flat(const Placement& placement, const Camera& camera,
                          const ImageOptions& options) const {
    const Assembly& assembly = file_.assembly;
    const Library library = library_of(arguments_);
    const auto flat = library == Library::kFast
                          ? fast::flat_scene(assembly, placement, camera)
                          : ref::flat_scene(assembly, placement, camera);
    if (!flat) {
      return Error{flat.error().code,
                   flat_reason(arguments_) + ": " + flat.error().message};
    }
    const auto own = flat_options(*flat, options);
    if (!own) return own.error();
    const std::unique_ptr<Engine> engine = make_engine(library);
    if (scalars_)
      engine->set_scalars(flat->scene, numbers_of(*flat),
                          scalars_->legend.scale);
    TreeRequest request;
    request.leaves =
        !arguments_.screen && arguments_.anti_aliasing != AntiAliasing::kExact;
    request.threads = working_threads(arguments_.build);
    request.progress = [](double) { return !LongWork::interrupted(); };
    if (needs_tree(arguments_) && !engine->build(flat->scene, request))
      return Error{ErrorCode::kStopped, "interrupted"};
    Result<Frame> frame =
        make_frame(*engine, flat->scene, flat->camera, *own,
                   scalars_ ? &scalars_->legend : nullptr, arguments_);
    if (!frame) return frame;
    for (PolygonId& item : frame->picture.items.pixels)
      item = moved_item(assembly, *flat, item);
    return frame;
  }

  template <class Rendering>
  static Picture picture_of(Rendering rendering) {
    return {std::move(rendering.items), std::move(rendering.colors),
            rendering.pixels_painted, rendering.fragments_displayed};
  }

  Picture placed_picture(const Placement& placement, const Camera& camera,
                         const ImageOptions& options,
                         const std::optional<Rows>& rows) const {
    const Assembly& assembly = file_.assembly;
    if (library_of(arguments_) == Library::kRef) {
      Picture whole =
          picture_of(ref::render_moving(assembly, placement, camera, options));
      return rows ? rows_of(whole, *rows) : whole;
    }
    fast::RenderOptions how;
    how.threads = thread_count(arguments_.build);
    how.simd = arguments_.simd.value_or(fast::SimdLevel::kBest);
    if (rows) how.rectangle = {0, rows->first, camera->width_px, rows->end};
    return picture_of(
        fast::render_moving(assembly, trees_, placement, camera, options, how));
  }

  /// Each object from the tree of its model.
  Result<Frame> draw_from_trees(const Placement& placement,
                                const Camera& camera,
                                const ImageOptions& options) const {
    const auto rows = asked_rows(arguments_, camera->height_px);
    if (!rows) return rows.error();
    Frame frame;
    frame.options = options;
    if (*rows)
      frame.part = io::PartOfPicture{(*rows)->first, camera->height_px};
    std::vector<double> times_ms;
    for (std::uint32_t i = 0; i < arguments_.repeat.value_or(1); ++i) {
      const Stopwatch watch;
      frame.picture = placed_picture(placement, camera, options, *rows);
      times_ms.push_back(watch.elapsed_ms());
    }
    frame.frame_ms = median(std::move(times_ms));
    add_background(arguments_, camera->height_px, frame);
    return frame;
  }

  const RenderArguments& arguments_;
  ObjectFile file_;
  std::vector<Stand> start_;
  std::shared_ptr<const CapParts> parts_;  ///< each object one
  std::optional<ShownScalars> scalars_;
  std::vector<std::vector<double>> numbers_;  ///< by model and corner
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
    const SceneFile& world = film.file().world();
    const Result<ChosenCamera> chosen =
        path ? frame_camera(world, *path, k, arguments)
             : still_camera(world, film.scalars(), arguments);
    if (!chosen)
      return fail(name + camera_error(arguments.path, chosen.error()));
    Result<Frame> frame =
        film.draw(chosen->camera, film.stands_at(path, k),
                  path ? path->clip_at(k, arguments.clip) : arguments.clip);
    if (LongWork::interrupted()) return stop("interrupted");
    if (!frame)
      return fail(arguments.path + ": " + name + frame.error().message);
    const Status written = write_frame(
        *frame, path ? outputs_of(arguments, k)
                     : Outputs{arguments.picture_file, arguments.ids_file,
                               working_threads(arguments.build)});
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
  io::ImportOptions options =
      import_options(arguments.view, arguments.grid_bits);
  if (arguments.scalars.source) color_by_scalars(options);
  Result<ObjectFile> file = read_object_file(arguments.path, options);
  if (!file) return fail(file.error().message);
  ObjectFilm film(arguments, *std::move(file));
  if (const auto error = film.prepare()) {
    return fail(arguments.path + ": " +
                with_object_names(error->message, film.file()));
  }
  if (!arguments.camera_path_file && !arguments.turntable) {
    const std::string uncut =
        cut_complaint(arguments.clip, arguments.view.near);
    if (!uncut.empty()) return fail(arguments.path + ": " + uncut);
    return draw_frames(film, nullptr, {0, 1}, arguments);
  }
  const Result<CameraPath> path =
      film_path(film.file().world(), film.scalars(), arguments);
  if (!path) return fail(path.error().message);
  if (const auto name = film.unknown_in(*path)) {
    return fail(*arguments.camera_path_file + ": there is no object " + *name +
                " in " + arguments.path);
  }
  const Result<Range> asked = frames_of(*path, arguments);
  if (!asked) return fail(asked.error().message);
  const Range frames = *asked;
  const std::string uncut =
      clip_complaint(*path, frames, film.file().world().scene, arguments.clip);
  if (!uncut.empty()) return fail(arguments.path + ": " + uncut);
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
