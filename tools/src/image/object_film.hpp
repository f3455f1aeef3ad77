#pragma once

#include "cli/command.hpp"
#include "image/rendering.hpp"

namespace halfspace::tools {

/// `render` of a file of objects: a picture, or a film whose path may move
/// objects.
Status render_objects(const RenderArguments& arguments);

}  // namespace halfspace::tools
