#include "image/viewing.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>

#include "cli/options.hpp"
#include "halfspace/io/view.hpp"

namespace halfspace::tools {
namespace {

/// A camera's lattice is 2^8 times finer than the scene's grid (S4.1), so small
/// integers, such as a cube of side 2, need a finer grid for a smooth choice of
/// eyes. With 20 bits an eye moves by less than a millionth of the scene, and
/// products of three coordinates still fit 64 bits.
constexpr int kRefineBits = 20;

constexpr Word<std::optional<Shading>> kShadingWords[] = {
    {"file", std::nullopt},
    {"flat", Shading::kFlat},
    {"gouraud", Shading::kGouraud}};

/// Whether the arguments describe another camera than the file's, in full or
/// to be completed.
bool describes_camera(const ViewArguments& arguments) {
  return arguments.eye || arguments.view;
}

/// The first option that describes a part of a camera; empty if none does.
std::string_view part_of_camera(const ViewArguments& arguments) {
  if (arguments.target) return "--target";
  if (arguments.up) return "--up";
  if (arguments.fov_deg) return "--fov";
  if (arguments.orthographic) return "--ortho";
  if (arguments.ortho_height) return "--height";
  if (arguments.near) return "--near";
  return {};
}

constexpr io::ViewDirection kFront = {{0, -1, 0}, {0, 0, 1}};
constexpr Word<io::ViewDirection> kViewWords[] = {
    {"front", kFront},
    {"back", {{0, 1, 0}, {0, 0, 1}}},
    {"left", {{-1, 0, 0}, {0, 0, 1}}},
    {"right", {{1, 0, 0}, {0, 0, 1}}},
    {"top", {{0, 0, 1}, {0, 1, 0}}},
    {"bottom", {{0, 0, -1}, {0, -1, 0}}},
    {"iso", io::ViewDirection()}};

}  // namespace

std::optional<Rgb> parse_color(std::string_view text) {
  std::optional<std::uint8_t> channels[3];
  const bool is_hex = text.size() == 7 && text[0] == '#';
  for (std::size_t i = 0; i < 3; ++i) {
    if (is_hex) {
      const std::string_view digits = text.substr(1 + 2 * i, 2);
      std::uint8_t value = 0;
      const auto [end, code] = std::from_chars(
          digits.data(), digits.data() + digits.size(), value, 16);
      if (code != std::errc() || end != digits.data() + 2) return std::nullopt;
      channels[i] = value;
      continue;
    }
    const std::size_t comma = i < 2 ? text.find(',') : text.size();
    if (comma == std::string_view::npos) return std::nullopt;
    channels[i] = parse_number<std::uint8_t>(text.substr(0, comma));
    if (!channels[i]) return std::nullopt;
    text.remove_prefix(std::min(comma + 1, text.size()));
  }
  return Rgb{*channels[0], *channels[1], *channels[2]};
}

namespace {

std::optional<Background> parse_background(std::string_view text) {
  if (text == "gradient") return Background{Background::Style::kGradient, {}};
  if (text == "none") return Background{Background::Style::kNone, {}};
  const std::optional<Rgb> color = parse_color(text);
  return color ? std::optional(Background{Background::Style::kColor, *color})
               : std::nullopt;
}

/// A direction by its angles: how far round from the front, counterclockwise
/// from above, and how high. Units: degrees.
std::optional<io::ViewDirection> parse_orbit(std::string_view text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  const auto azimuth = parse_number<double>(text.substr(0, comma));
  const auto elevation = parse_number<double>(text.substr(comma + 1));
  if (!azimuth || !elevation || std::abs(*azimuth) > 1e6 ||
      std::abs(*elevation) > 90)
    return std::nullopt;
  return orbit(*azimuth, *elevation);
}

CLI::Option* add_color(CLI::App& app, const std::string& name,
                       std::optional<Rgb>& color, const std::string& meaning) {
  return add_parsed(app, name, "R,G,B",
                    "R,G,B, three whole numbers of at least 0 and at most 255, "
                    "or #rrggbb",
                    color, parse_color, meaning);
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
  if (arguments.eye || arguments.target)
    view.up = arguments.up.value_or(usual_up(view.eye, view.target));
  if (arguments.fov_deg) view.fov_deg = *arguments.fov_deg;
  view.near = arguments.near;
  view.orthographic = arguments.orthographic || arguments.ortho_height;
  if (arguments.ortho_height) {
    view.ortho_height = *arguments.ortho_height;
  } else if (view.orthographic &&
             (arguments.eye || arguments.target || arguments.fov_deg)) {
    // As much of the scene, at the target, as in perspective.
    const double half_angle = view.fov_deg * std::numbers::pi / 360;
    view.ortho_height =
        2 * glm::distance(view.eye, view.target) * std::tan(half_angle);
  }
  return view;
}

/// The view from the direction asked for, of a size.
Result<io::ViewOptions> automatic_view(const Scene& scene,
                                       const ViewArguments& arguments,
                                       const Size& size) {
  io::ViewDirection direction = arguments.view.value_or(io::ViewDirection());
  if (arguments.up) {
    if (*arguments.up == glm::dvec3(0)) {
      return Error{ErrorCode::kBadCamera,
                   "the camera's up is zero, which points nowhere"};
    }
    direction = io::turned(direction, *arguments.up);
  }
  return io::automatic_options(
      scene, direction, size.width_px, size.height_px,
      arguments.orthographic || arguments.ortho_height);
}

std::string to_text(const Size& size) {
  return std::to_string(size.width_px) + "x" + std::to_string(size.height_px);
}

/// A light: X,Y,Z, or X,Y,Z,STRENGTH.
std::optional<io::Light> parse_light(std::string_view text) {
  io::Light light;
  std::string_view place = text;
  if (std::count(text.begin(), text.end(), ',') == 3) {
    const std::size_t comma = text.rfind(',');
    const auto strength = parse_number<double>(text.substr(comma + 1));
    if (!strength || *strength < 0 || *strength > 100) return std::nullopt;
    light.strength = *strength;
    place = text.substr(0, comma);
  }
  const std::optional<glm::dvec3> from = parse_vector(place);
  if (!from || !(glm::length(*from) > 0) || !(glm::length(*from) < 1e150))
    return std::nullopt;
  const glm::dvec3 unit = glm::normalize(*from);
  light.to_light = {unit.x, unit.y, unit.z};
  return light;
}

void add_light_options(CLI::App& app, ViewArguments& arguments) {
  const auto add = [&arguments](const std::vector<std::string>& texts) {
    for (const std::string& text : texts)
      arguments.lights.push_back(*parse_light(text));
  };
  const auto complain = [](const std::string& text) {
    return parse_light(text)
               ? std::string()
               : fmt::format(
                     "must be X,Y,Z, three numbers that are not all 0, "
                     "and maybe a strength of at least 0, not '{}'",
                     text);
  };
  app.add_option_function<std::vector<std::string>>(
         "--light", add,
         "From where light comes to a mesh, and how strong it is, 1 if not "
         "said: one light each time; if there is none, from above where --up "
         "is, the left and the front")
      ->check(complain)
      ->allow_extra_args(false)
      ->type_name("X,Y,Z[,S]")
      ->group("Picture");
  app.add_flag("--headlight", arguments.headlight,
               "A light comes to a mesh from where the eye is; with --eye "
               "and no --target, as if it looked at 0,0,0")
      ->group("Picture");
  const auto parse_share = [](std::string_view text) {
    const auto share = parse_number<double>(text);
    return share && *share >= 0 && *share <= 1 ? share : std::nullopt;
  };
  add_parsed(app, "--ambient", "SHARE", "a number from 0 to 1",
             arguments.ambient, parse_share,
             "The light that is everywhere, 0.22 if not said; 1 shows colours "
             "as they are")
      ->group("Picture");
  const auto parse_crease = [](std::string_view text) {
    const auto angle = parse_number<double>(text);
    return angle && *angle >= 0 && *angle <= 180 ? angle : std::nullopt;
  };
  add_parsed(app, "--smooth", "DEG", "a number from 0 to 180",
             arguments.crease_deg, parse_crease,
             "Shade a mesh smoothly, but for edges that turn by more than "
             "this")
      ->group("Picture");
}

void add_picture_options(CLI::App& app, ViewArguments& arguments) {
  const auto set_cull = [&app, &arguments](const std::string& name, bool cull,
                                           const std::string& meaning) {
    app.add_flag_function(
           name, [&arguments, cull](std::int64_t) { arguments.cull = cull; },
           meaning)
        ->group("Picture");
  };
  set_cull("--cull", true, "Leave out polygons seen from behind");
  set_cull("--no-cull", false, "Do not, though a .scene says so");
  add_choice(app, "--shade", kShadingWords, arguments.shading,
             "Colours: one a polygon, or between the corners; `file` is what "
             "a .scene says, else flat")
      ->group("Picture");
  add_parsed(app, "--background", "R,G,B|gradient|none",
             "R,G,B, three whole numbers of at least 0 and at most 255, "
             "#rrggbb, gradient or none",
             arguments.background, parse_background,
             "Colour where nothing is, a gradient, or nothing: an alpha "
             "channel; white, or that of the .scene, if not said")
      ->group("Picture");
  add_color(app, "--color", arguments.surface,
            "Colour of the mesh, instead of its own")
      ->group("Picture");
  add_light_options(app, arguments);
}

}  // namespace

std::optional<io::ViewDirection> view_direction(std::string_view word) {
  for (const Word<io::ViewDirection>& view : kViewWords) {
    if (view.word == word) return view.value;
  }
  return std::nullopt;
}

io::ViewDirection orbit(double azimuth_deg, double elevation_deg) {
  constexpr double kRadians = std::numbers::pi / 180;
  const double a = azimuth_deg * kRadians;
  const double e = elevation_deg * kRadians;
  const glm::dvec3 to_eye = {std::cos(e) * std::sin(a),
                             -std::cos(e) * std::cos(a), std::sin(e)};
  if (std::abs(elevation_deg) < 90) return {to_eye, {0, 0, 1}};
  const double down = elevation_deg > 0 ? 1 : -1;
  return {{0, 0, down}, {-down * std::sin(a), down * std::cos(a), 0}};
}

Rgb gradient_color(std::int32_t row, std::int32_t height_px) {
  constexpr Rgb kTop = {170, 198, 228};
  constexpr Rgb kBottom = {250, 250, 248};
  const auto channel = [&](std::int64_t top, std::int64_t bottom) {
    const std::int64_t twice = 2 * std::int64_t{height_px};
    const std::int64_t value =
        top * twice + (bottom - top) * (2 * std::int64_t{row} + 1);
    return static_cast<std::uint8_t>((value + height_px) / twice);
  };
  return {channel(kTop.r, kBottom.r), channel(kTop.g, kBottom.g),
          channel(kTop.b, kBottom.b)};
}

void add_view_options(CLI::App& app, ViewArguments& arguments) {
  const std::string group = "Camera";
  add_parsed(app, "--size", "WxH", "WxH, columns and rows from 1 to 65536",
             arguments.size, parse_size,
             "Columns and rows of the image; 640x480 if not said")
      ->group(group);
  add_vector(app, "--eye", arguments.eye,
             "Where the eye is, in the model's units; what is not said is "
             "chosen so that all is seen")
      ->group(group);
  add_vector(app, "--target", arguments.target,
             "What is seen in the middle of the image")
      ->group(group);
  add_choice(app, "--view", kViewWords, arguments.view,
             "See the whole from this side; iso, which is usual, is from above "
             "to one side. Turns with --up")
      ->excludes("--eye")
      ->group(group);
  add_parsed(app, "--orbit", "AZIMUTH,ELEVATION",
             "AZIMUTH,ELEVATION in degrees, the second from -90 to 90",
             arguments.view, parse_orbit,
             "See the whole from there: degrees round from the front, and up")
      ->excludes("--eye")
      ->excludes("--view")
      ->group(group);
  add_vector(app, "--up", arguments.up,
             "What points upwards; 0,0,1 if not said")
      ->group(group);
  const auto parse_angle = [](std::string_view text) {
    const std::optional<double> angle = parse_number<double>(text);
    return angle && *angle > 0 && *angle < 180 ? angle : std::nullopt;
  };
  const auto parse_height = [](std::string_view text) {
    const std::optional<double> height = parse_number<double>(text);
    return height && *height > 0 ? height : std::nullopt;
  };
  add_parsed(app, "--fov", "DEG", "a number above 0 and below 180",
             arguments.fov_deg, parse_angle, "Angle of view from top to bottom")
      ->group(group);
  app.add_flag("--ortho", arguments.orthographic,
               "Orthographic view: parallel rays")
      ->group(group);
  add_parsed(app, "--height", "LENGTH", "a number above 0",
             arguments.ortho_height, parse_height,
             "Height of an orthographic view, in the model's units")
      ->group(group);
  add_real(app, "--near", "LENGTH", arguments.near,
           "What is not farther from the eye than this is not seen")
      ->group(group);
  add_picture_options(app, arguments);
}

CLI::Option* add_back_color_option(CLI::App& app, std::optional<Rgb>& color) {
  return add_color(
      app, "--back-color", color,
      "Colour of polygons seen from behind, half dimmed by their light");
}

Result<io::ViewOptions> complete_view(const Scene& scene,
                                      const ViewArguments& arguments) {
  io::ViewOptions view;
  view.width_px = arguments.size->width_px;
  view.height_px = arguments.size->height_px;
  // A camera that is described in full needs nothing to look at.
  if (!arguments.eye || !arguments.target) {
    const Result<io::ViewOptions> automatic =
        automatic_view(scene, arguments, *arguments.size);
    if (!automatic) return automatic.error();
    view = *automatic;
    if (arguments.eye) view.target = io::middle_of(scene);
  }
  return completed(view, arguments);
}

Result<ChosenCamera> choose_camera(const SceneFile& file,
                                   const ViewArguments& arguments) {
  std::optional<Size> own;
  if (file.camera)
    own = Size{(*file.camera)->width_px, (*file.camera)->height_px};
  if (file.camera && !describes_camera(arguments)) {
    const std::string_view part = part_of_camera(arguments);
    const bool resizes = arguments.size && *arguments.size != *own;
    if (part.empty() && !resizes) return ChosenCamera{*file.camera, 0, true};
    return Error{
        ErrorCode::kBadCamera,
        (part.empty() ? "--size: the scene's own camera has " + to_text(*own)
                      : std::string(part) + ": the scene has its own camera") +
            "; give --eye or --view as well for another camera"};
  }
  const Size size = arguments.size.value_or(own.value_or(kUsualSize));
  ViewArguments sized = arguments;
  sized.size = size;
  const Result<io::ViewOptions> view = complete_view(file.scene, sized);
  if (!view) return view.error();
  const Result<io::Viewed> viewed = io::look_at(file.scene, *view);
  if (!viewed) return viewed.error();
  return ChosenCamera{viewed->camera, viewed->max_move, false};
}

Result<ChosenCamera> widened(const ChosenCamera& chosen, std::int32_t width_px,
                             const Scene& scene) {
  CameraData data = chosen.camera.data();
  data.width_px = width_px;
  const Result<Camera> camera = make_camera(data, scene.grid_bits());
  if (!camera) return camera.error();
  return ChosenCamera{*camera, chosen.max_move, chosen.from_file};
}

std::string camera_error(const std::string& path, const Error& error) {
  if (error.code == ErrorCode::kEmpty)
    return io::error_about(path, error).message;
  const bool has_option = error.message.starts_with("--");
  return (has_option ? "" : "camera: ") + error.message;
}

bool changes_colors(const ViewArguments& arguments) {
  return arguments.surface || !arguments.lights.empty() ||
         arguments.headlight || arguments.ambient || arguments.crease_deg;
}

ImageOptions choose_options(const SceneFile& file,
                            const ViewArguments& arguments) {
  ImageOptions options = file.options;
  if (arguments.cull) options.cull = *arguments.cull;
  if (arguments.crease_deg) options.shading = Shading::kGouraud;
  options.shading = arguments.shading.value_or(options.shading);
  if (arguments.background) options.background = arguments.background->color;
  return options;
}

namespace {

/// The usual light, which is above where `up` is. Requires: up is not zero.
io::Light usual_light(const glm::dvec3& up) {
  const auto [x, y, z] = io::Light().to_light;
  const glm::dvec3 turned = io::turned({.to_eye = {x, y, z}}, up).to_eye;
  return {{turned.x, turned.y, turned.z}, 1};
}

/// The light from where the eye is.
io::Light headlight(const ViewArguments& arguments) {
  const io::ViewDirection usual = arguments.view.value_or(io::ViewDirection());
  glm::dvec3 to_light = arguments.up && *arguments.up != glm::dvec3(0)
                            ? io::turned(usual, *arguments.up).to_eye
                            : usual.to_eye;
  if (arguments.eye) {
    const glm::dvec3 from = arguments.target.value_or(glm::dvec3(0));
    if (*arguments.eye != from) to_light = *arguments.eye - from;
  }
  const glm::dvec3 unit = glm::normalize(to_light);
  return {{unit.x, unit.y, unit.z}, 1};
}

}  // namespace

io::ImportOptions import_options(const ViewArguments& arguments,
                                 std::optional<int> grid_bits) {
  io::ImportOptions options;
  options.grid_bits = grid_bits;
  options.refine_bits = kRefineBits;
  options.gouraud =
      arguments.shading.value_or(arguments.crease_deg
                                     ? Shading::kGouraud
                                     : Shading::kFlat) == Shading::kGouraud;
  options.surface = arguments.surface;
  options.light_colors = true;
  options.ambient = arguments.ambient.value_or(options.ambient);
  options.crease_deg = arguments.crease_deg;
  if (!arguments.lights.empty()) {
    options.lights = arguments.lights;
  } else if (arguments.up && *arguments.up != glm::dvec3(0)) {
    options.lights = {usual_light(*arguments.up)};
  }
  if (arguments.headlight) {
    if (arguments.lights.empty()) options.lights.clear();
    options.lights.push_back(headlight(arguments));
  }
  return options;
}

}  // namespace halfspace::tools
