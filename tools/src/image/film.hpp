#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cli/arguments.hpp"
#include "halfspace/scene_file.hpp"
#include "image/camera_path.hpp"
#include "image/rendering.hpp"
#include "image/scalars.hpp"

namespace halfspace::tools {

/// The camera of a still picture: where the view is chosen so that all is seen,
/// that is beside the legend, if there is one.
/// Errors: those of choose_camera().
Result<ChosenCamera> still_camera(const SceneFile& file,
                                  const std::optional<ShownScalars>& scalars,
                                  const RenderArguments& arguments);

/// The way of the camera that --path or --turntable describes.
///
/// Requires: one of them.
/// Errors: those of read_camera_path() and turntable(); the message names the
///         file or the option.
Result<CameraPath> film_path(const SceneFile& file,
                             const std::optional<ShownScalars>& scalars,
                             const RenderArguments& arguments);

/// The camera of a frame. Errors: those of choose_camera().
Result<ChosenCamera> frame_camera(const SceneFile& file, const CameraPath& path,
                                  std::int64_t frame,
                                  const RenderArguments& arguments);

/// The frames asked for, if the path has them.
/// Errors: kOutOfRange.
Result<Range> frames_of(const CameraPath& path,
                        const RenderArguments& arguments);

/// What is wrong with what cuts in one of the frames; empty if nothing.
std::string clip_complaint(const CameraPath& path, const Range& frames,
                           const Scene& scene, const ClipArguments& clip);

/// The names of a frame's files.
Outputs outputs_of(const RenderArguments& arguments, std::int64_t number);

}  // namespace halfspace::tools
