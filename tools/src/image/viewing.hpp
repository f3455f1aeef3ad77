#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/arguments.hpp"
#include "cli/loading.hpp"
#include "halfspace/camera.hpp"
#include "halfspace/image.hpp"
#include "halfspace/io/import.hpp"
#include "halfspace/io/view.hpp"
#include "halfspace/result.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace halfspace::tools {

/// What is seen where nothing is.
struct Background {
  enum class Style : std::uint8_t { kColor, kGradient, kNone };
  Style style = Style::kColor;
  Rgb color = ImageOptions{}.background;
};

/// The colour of a gradient's row `row` of `height_px`: from light blue at the
/// top to nearly white at the bottom, each channel the exact value at the row's
/// middle, rounded half up.
Rgb gradient_color(std::int32_t row, std::int32_t height_px);

/// The camera and the picture, as far as the command line describes them.
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
  std::optional<Background> background;
  std::optional<Rgb> surface;
  std::vector<io::Light> lights;  ///< nothing: the usual one
  bool headlight = false;         ///< a light comes from where the eye is
  std::optional<double> ambient;
  std::optional<double> crease_deg;
  std::optional<io::ViewDirection> view;  ///< a direction of --view
  std::optional<Shading> shading;         ///< nothing: as the file says
};

/// The direction from `azimuth` degrees round from the front, counterclockwise
/// from above, and `elevation` degrees up.
io::ViewDirection orbit(double azimuth_deg, double elevation_deg);

/// The colour that `R,G,B` or `#rrggbb` spells.
std::optional<Rgb> parse_color(std::string_view text);

/// Adds the options, each of which fills its member.
/// Requires: `arguments` outlives the parsing.
void add_view_options(CLI::App& app, ViewArguments& arguments);

/// Adds --back-color, the mark of what is seen from behind (S5.8).
/// Requires: `color` outlives the parsing.
CLI::Option* add_back_color_option(CLI::App& app, std::optional<Rgb>& color);

/// The view that the arguments describe, completed from the automatic view.
///
/// Requires: arguments.size.
/// Errors: those of io::automatic_options.
Result<io::ViewOptions> complete_view(const Scene& scene,
                                      const ViewArguments& arguments);

/// The size of images if none is given.
constexpr Size kUsualSize = {640, 480};

/// The direction of a word of --view, such as `front`; nothing if it is none.
std::optional<io::ViewDirection> view_direction(std::string_view word);

/// The camera, and how far rounding moved it. Units: grid steps.
struct ChosenCamera {
  Camera camera;
  double max_move = 0;
  bool from_file = false;
};

/// The camera of the file if it has one and the arguments describe no other;
/// else the one they describe, completed from the automatic view. Its size is
/// the file's if the arguments give none.
///
/// Errors: those of io::look_at and io::automatic_options; kBadCamera where the
///         arguments ask for a part of another camera than the file's. All but
///         kEmpty are about the arguments.
Result<ChosenCamera> choose_camera(const SceneFile& file,
                                   const ViewArguments& arguments);

/// The same camera with more columns at the right side.
/// Errors: those of make_camera().
Result<ChosenCamera> widened(const ChosenCamera& chosen, std::int32_t width_px,
                             const Scene& scene);

/// The error of a camera for the scene in a file, in words: it is about the
/// scene, or about the arguments.
std::string camera_error(const std::string& path, const Error& error);

/// Whether the arguments ask for colours that only meshes are given.
bool changes_colors(const ViewArguments& arguments);

/// The file's options, but for what the arguments say.
ImageOptions choose_options(const SceneFile& file,
                            const ViewArguments& arguments);

/// How a mesh is imported to be looked at: on a grid fine enough for cameras.
io::ImportOptions import_options(const ViewArguments& arguments,
                                 std::optional<int> grid_bits);

}  // namespace halfspace::tools
