#include "viewing.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>

#include "halfspace/io/view.hpp"
#include "options.hpp"

namespace halfspace::tools {
namespace {

/// A camera's lattice is 2^8 times finer than the scene's grid (S4.1), so small
/// integers, such as a cube of side 2, need a finer grid for a smooth choice of
/// eyes. With 20 bits an eye moves by less than a millionth of the scene, and
/// products of three coordinates still fit 64 bits.
constexpr int kRefineBits = 20;

constexpr Size kUsualSize = {640, 480};

/// Whether the arguments ask for another camera than the file's.
bool describes_camera(const ViewArguments& arguments) {
  return arguments.eye || arguments.target || arguments.up ||
         arguments.fov_deg || arguments.orthographic ||
         arguments.ortho_height || arguments.near;
}

/// Straight up, or where the view is straight up or down, y.
glm::dvec3 usual_up(const glm::dvec3& eye, const glm::dvec3& target) {
  const bool vertical = eye.x == target.x && eye.y == target.y;
  return vertical ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
}

/// `view`, but for what the arguments say.
io::ViewOptions completed(io::ViewOptions view,
                          const ViewArguments& arguments) {
  if (arguments.eye) view.eye = *arguments.eye;
  if (arguments.target) view.target = *arguments.target;
  view.up = arguments.up ? *arguments.up : usual_up(view.eye, view.target);
  if (arguments.fov_deg) view.fov_deg = *arguments.fov_deg;
  view.near = arguments.near;
  if (arguments.orthographic || arguments.ortho_height) {
    // As much of the scene, at the target, as in perspective.
    const double half_angle = view.fov_deg * std::numbers::pi / 360;
    view.orthographic = true;
    view.ortho_height = arguments.ortho_height.value_or(
        2 * glm::distance(view.eye, view.target) * std::tan(half_angle));
  }
  return view;
}

std::string to_text(const Size& size) {
  return std::to_string(size.width_px) + "x" + std::to_string(size.height_px);
}

}  // namespace

void add_view_options(CLI::App& app, ViewArguments& arguments) {
  const std::string group = "Camera";
  add_parsed(app, "--size", "WxH", arguments.size, parse_size,
             "Columns and rows of the image; 640x480 if not said")
      ->group(group);
  add_parsed(app, "--eye", "X,Y,Z", arguments.eye, parse_vector,
             "Where the eye is, in the model's units; what is not said is "
             "chosen so that all is seen")
      ->group(group);
  add_parsed(app, "--target", "X,Y,Z", arguments.target, parse_vector,
             "What is seen in the middle of the image")
      ->group(group);
  add_parsed(app, "--up", "X,Y,Z", arguments.up, parse_vector,
             "What points upwards in the image; 0,0,1 if not said")
      ->group(group);
  add_parsed(app, "--fov", "DEG", arguments.fov_deg, parse_real,
             "Angle of view from top to bottom")
      ->group(group);
  app.add_flag("--ortho", arguments.orthographic,
               "Orthographic view: parallel rays")
      ->group(group);
  add_parsed(app, "--height", "LENGTH", arguments.ortho_height, parse_real,
             "Height of an orthographic view, in the model's units")
      ->group(group);
  add_parsed(app, "--near", "LENGTH", arguments.near, parse_real,
             "What is not farther from the eye than this is not seen")
      ->group(group);
  const auto set_cull = [&app, &arguments](const std::string& name, bool cull,
                                           const std::string& meaning) {
    app.add_flag_function(
           name, [&arguments, cull](std::int64_t) { arguments.cull = cull; },
           meaning)
        ->group("Picture");
  };
  set_cull("--cull", true, "Leave out polygons seen from behind");
  set_cull("--no-cull", false, "Do not, though a .scene says so");
  add_choice(app, "--shade", {"file", "flat", "gouraud"}, arguments.shading,
             "Colours: one a polygon, or between the corners; `file` is what "
             "a .scene says, else flat")
      ->group("Picture");
}

Result<ChosenCamera> choose_camera(const SceneFile& file,
                                   const ViewArguments& arguments) {
  if (file.camera && !describes_camera(arguments)) {
    const Size size = {(*file.camera)->width_px, (*file.camera)->height_px};
    if (arguments.size && *arguments.size != size) {
      return Error{ErrorCode::kBadCamera,
                   "--size: the scene's own camera has " + to_text(size) +
                       "; give --eye as well for another camera"};
    }
    return ChosenCamera{*file.camera, 0, true};
  }
  const Size size = arguments.size.value_or(kUsualSize);
  io::ViewOptions view;
  view.width_px = size.width_px;
  view.height_px = size.height_px;
  // A camera that is said in full needs nothing to look at.
  if (!arguments.eye || !arguments.target) {
    const Result<io::Viewed> automatic =
        io::automatic_view(file.scene, size.width_px, size.height_px);
    if (!automatic) return automatic.error();
    if (!describes_camera(arguments)) {
      return ChosenCamera{automatic->camera, automatic->max_move, false};
    }
    view = automatic->options;
  }
  const Result<io::Viewed> viewed =
      io::look_at(file.scene, completed(view, arguments));
  if (!viewed) return viewed.error();
  return ChosenCamera{viewed->camera, viewed->max_move, false};
}

ImageOptions choose_options(const SceneFile& file,
                            const ViewArguments& arguments) {
  ImageOptions options = file.options;
  if (arguments.cull) options.cull = *arguments.cull;
  if (arguments.shading == 1) options.shading = Shading::kFlat;
  if (arguments.shading == kGouraudShading) options.shading = Shading::kGouraud;
  return options;
}

io::ImportOptions import_options(const ViewArguments& arguments,
                                 std::optional<int> grid_bits) {
  return {.grid_bits = grid_bits,
          .refine_bits = kRefineBits,
          .gouraud = arguments.shading == kGouraudShading};
}

}  // namespace halfspace::tools
