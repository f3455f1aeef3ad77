#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "halfspace/camera.hpp"
#include "halfspace/image.hpp"
#include "halfspace/io/number.hpp"
#include "halfspace/result.hpp"
#include "halfspace/scene.hpp"

namespace CLI {
class App;
}

namespace halfspace::tools {

/// What the command line says about clip planes and caps (S10).
struct ClipArguments {
  std::vector<std::array<io::Number, 4>> planes;  ///< in model units
  std::optional<double> yon;
  std::optional<CapStyle> caps;
  bool is_used() const { return !planes.empty() || yon || caps; }
};

/// Adds --clip, --yon and --cap.
/// Requires: `arguments` outlives the parsing.
void add_clip_options(CLI::App& app, ClipArguments& arguments);

/// Adds the planes and caps asked for to the options of an image.
///
/// Errors: those of io::clip_plane() and make_clips(), in words about the
///         options.
Result<Done> add_clips(const Scene& scene, const Camera& camera,
                       const ClipArguments& arguments, ImageOptions& options);

/// What is wrong with caps for the scene; empty if nothing.
/// Cost: where caps are asked for, a sort of the scene's edges.
std::string cap_complaint(const Scene& scene, const ClipArguments& arguments);

}  // namespace halfspace::tools
