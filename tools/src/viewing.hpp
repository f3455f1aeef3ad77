#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "arguments.hpp"
#include "halfspace/camera.hpp"
#include "halfspace/image.hpp"
#include "halfspace/result.hpp"
#include "loading.hpp"

namespace CLI {
class App;
}

namespace halfspace::tools {

/// ViewArguments::shading of Gouraud shading.
constexpr std::size_t kGouraudShading = 2;

/// What the command line says about the camera and the picture.
struct ViewArguments {
  std::optional<glm::dvec3> eye;
  std::optional<glm::dvec3> target;
  std::optional<glm::dvec3> up;
  std::optional<double> fov_deg;
  bool orthographic = false;
  std::optional<double> ortho_height;
  std::optional<double> near;
  std::optional<Size> size;
  std::optional<bool> cull;
  std::size_t shading = 0;  ///< 0: as the file says, flat, gouraud
};

/// Adds the options, each of which fills its member.
/// Requires: `arguments` outlives the parsing.
void add_view_options(CLI::App& app, ViewArguments& arguments);

/// The camera, and how far rounding moved it. Units: grid steps.
struct ChosenCamera {
  Camera camera;
  double max_move = 0;
  bool from_file = false;
};

/// The camera of the file if it has one and the arguments say nothing else;
/// else what they say, completed from the automatic view.
///
/// Errors: those of io::look_at and io::automatic_view; kBadCamera where a size
///         is asked for that is not that of the file's camera.
Result<ChosenCamera> choose_camera(const SceneFile& file,
                                   const ViewArguments& arguments);

/// The file's options, but for what the arguments say.
ImageOptions choose_options(const SceneFile& file,
                            const ViewArguments& arguments);

/// How a mesh is imported to be looked at: on a grid fine enough for cameras.
io::ImportOptions import_options(const ViewArguments& arguments,
                                 std::optional<int> grid_bits);

}  // namespace halfspace::tools
