#include "image/film.hpp"

#include <string>

#include "cli/outputs.hpp"

namespace halfspace::tools {
namespace {

/// The size asked for, or else that of the file's camera, or else the usual.
Size whole_size(const SceneFile& file, const RenderArguments& arguments) {
  if (arguments.view.size) return *arguments.view.size;
  const auto& camera = file.camera;
  return camera ? Size{(*camera)->width_px, (*camera)->height_px} : kUsualSize;
}

/// The arguments for the part of the picture beside the legend, where the view
/// is chosen so that all is seen.
ViewArguments beside_legend(const SceneFile& file,
                            const std::optional<ShownScalars>& scalars,
                            const RenderArguments& arguments) {
  ViewArguments view = arguments.view;
  const bool is_chosen = !view.eye && !view.target &&
                         !arguments.camera_path_file &&
                         (view.view || !file.camera);
  if (is_chosen && scalars && arguments.scalars.has_legend) {
    view.size = size_beside_legend(scalars, arguments.scalars,
                                   whole_size(file, arguments));
  }
  return view;
}

/// choose_camera() for that part, of a camera for the whole picture.
Result<ChosenCamera> choose_wide_camera(const SceneFile& file,
                                        const ViewArguments& view,
                                        const RenderArguments& arguments) {
  Result<ChosenCamera> chosen = choose_camera(file, view);
  const Size whole = whole_size(file, arguments);
  if (!chosen || !view.size || arguments.camera_path_file ||
      view.size->width_px >= whole.width_px)
    return chosen;
  return widened(*chosen, whole.width_px, file.scene);
}

}  // namespace

Result<ChosenCamera> still_camera(const SceneFile& file,
                                  const std::optional<ShownScalars>& scalars,
                                  const RenderArguments& arguments) {
  return choose_wide_camera(file, beside_legend(file, scalars, arguments),
                            arguments);
}

Result<CameraPath> film_path(const SceneFile& file,
                             const std::optional<ShownScalars>& scalars,
                             const RenderArguments& arguments) {
  if (arguments.camera_path_file) {
    const std::string& name = *arguments.camera_path_file;
    Result<CameraPath> path =
        read_camera_path(name, arguments.view, arguments.clip);
    if (!path) return io::error_about(name, path.error());
    return path;
  }
  Result<CameraPath> path =
      turntable(file, arguments.own_view, *arguments.turntable,
                beside_legend(file, scalars, arguments));
  if (!path)
    return Error{path.error().code, "--turntable: " + path.error().message};
  return path;
}

Result<ChosenCamera> frame_camera(const SceneFile& file, const CameraPath& path,
                                  std::int64_t frame,
                                  const RenderArguments& arguments) {
  const std::optional<ChosenCamera> own = path.camera_at(frame);
  if (own) return *own;
  return choose_wide_camera(file, path.at(frame), arguments);
}

Result<Range> frames_of(const CameraPath& path,
                        const RenderArguments& arguments) {
  const Range asked = arguments.frames.value_or(Range{});
  const std::int64_t first = asked.first.value_or(path.first_frame());
  const std::int64_t end = asked.end.value_or(path.last_frame() + 1);
  if (path.first_frame() <= first && first < end &&
      end <= path.last_frame() + 1) {
    return Range{first, end};
  }
  return Error{ErrorCode::kOutOfRange,
               "--frames: the path has the frames " +
                   std::to_string(path.first_frame()) + ":" +
                   std::to_string(path.last_frame() + 1)};
}

std::string clip_complaint(const CameraPath& path, const Range& frames,
                           const Scene& scene, const ClipArguments& clip) {
  const std::string uncut = cut_complaint(path.clip_at(*frames.first, clip));
  if (!uncut.empty()) return uncut;
  for (std::int64_t k = *frames.first; k < *frames.end; ++k) {
    const auto planes = clip_planes(scene, path.clip_at(k, clip));
    if (!planes)
      return "frame " + std::to_string(k) + ": " + planes.error().message;
  }
  return {};
}

Outputs outputs_of(const RenderArguments& arguments, std::int64_t number) {
  const auto numbered = [number](const std::optional<std::string>& name) {
    const auto pattern =
        name ? NumberedName::parse(*name) : std::optional<NumberedName>();
    return pattern ? std::optional(pattern->with(number)) : std::nullopt;
  };
  return {numbered(arguments.picture_file), numbered(arguments.ids_file),
          working_threads(arguments.build)};
}

}  // namespace halfspace::tools
