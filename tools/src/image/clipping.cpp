#include "image/clipping.hpp"

#include <string_view>

#include "cli/options.hpp"
#include "halfspace/boolean.hpp"
#include "halfspace/cap_parts.hpp"
#include "halfspace/io/clip.hpp"
#include "image/viewing.hpp"

namespace halfspace::tools {

std::optional<ClipNumbers> parse_clip_numbers(std::string_view text) {
  ClipNumbers numbers;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t comma = k < 3 ? text.find(',') : text.size();
    if (comma == std::string_view::npos) return std::nullopt;
    const auto number = io::parse_number(text.substr(0, comma));
    if (!number) return std::nullopt;
    numbers[k] = *number;
    text.remove_prefix(std::min(comma + 1, text.size()));
  }
  return numbers;
}

std::optional<double> parse_yon(std::string_view text) {
  const auto length = parse_number<double>(text);
  return length && *length > 0 ? length : std::nullopt;
}

namespace {

std::optional<CapChoice> parse_caps(std::string_view text) {
  constexpr Rgb kLines = {60, 60, 60};
  if (text == "hatch") return CapChoice{{{235, 235, 225}, kLines}};
  // Where several are, which is a fault more often than not.
  const CapStyle several = {{235, 110, 90}, kLines};
  if (text == "part") return CapChoice{several, CapsBy::kPart};
  if (text == "file") return CapChoice{several, CapsBy::kFile};
  const std::optional<Rgb> color = parse_color(text);
  return color ? std::optional(CapChoice{{*color, std::nullopt}})
               : std::nullopt;
}

}  // namespace

void add_clip_options(CLI::App& app, ClipArguments& arguments) {
  const std::string group = "Section";
  const auto add = [&arguments](const std::vector<std::string>& texts) {
    for (const std::string& text : texts)
      arguments.planes.push_back(*parse_clip_numbers(text));
  };
  const auto complain = [](const std::string& text) {
    return parse_clip_numbers(text)
               ? std::string()
               : fmt::format("must be A,B,C,D, four numbers, not '{}'", text);
  };
  app.add_option_function<std::vector<std::string>>(
         "--clip", add,
         "Keep what has A x + B y + C z + D >= 0 in the model's units; up to "
         "eight such planes, one each time")
      ->check(complain)
      ->allow_extra_args(false)
      ->type_name("A,B,C,D")
      ->group(group);
  add_parsed(app, "--yon", "LENGTH", "a number above 0", arguments.yon,
             parse_yon,
             "What is farther from the eye than this is not seen; one of the "
             "eight planes")
      ->group(group);
  add_parsed(app, "--cap", "COLOR|hatch|part|file",
             "R,G,B, three whole numbers of at least 0 and at most 255, "
             "#rrggbb, hatch, part or file",
             arguments.caps, parse_caps,
             "Fill the cuts of a closed solid, in a colour or hatched; or each "
             "connected part, or each FILE, in a colour and with lines of its "
             "own, and where several overlap, lines both ways on red")
      ->group(group);
}

Result<std::vector<ClipPlane>> clip_planes(const Scene& scene,
                                           const ClipArguments& arguments) {
  std::vector<ClipPlane> planes;
  for (const ClipNumbers& numbers : arguments.planes) {
    const Result<ClipPlane> plane = io::clip_plane(scene, numbers);
    if (!plane)
      return Error{plane.error().code, "--clip: " + plane.error().message};
    planes.push_back(*plane);
  }
  return planes;
}

Result<Done> add_clips(const Scene& scene, const Camera& camera,
                       const ClipArguments& arguments, ImageOptions& options) {
  const auto own = clip_planes(scene, arguments);
  if (!own) return own.error();
  std::vector<ClipPlane> planes = options.clips;
  planes.insert(planes.end(), own->begin(), own->end());
  if (arguments.yon) {
    const Result<ClipPlane> plane =
        io::yon_plane(scene, camera, *arguments.yon);
    if (!plane)
      return Error{plane.error().code, "--yon: " + plane.error().message};
    planes.push_back(*plane);
  }
  const auto made = make_clips(planes, scene.grid_bits());
  if (!made) return Error{made.error().code, "--clip: " + made.error().message};
  options.clips = *made;
  if (arguments.caps) options.caps = arguments.caps->style;
  return Done{};
}

std::string cut_complaint(const ClipArguments& arguments,
                          std::optional<double> near) {
  if (near && arguments.yon && *near >= *arguments.yon) {
    return fmt::format(
        "--yon: must be more than --near, for what is seen is between them, "
        "not {} and {}",
        *arguments.yon, *near);
  }
  return arguments.caps && !arguments.cuts()
             ? "--cap: needs --clip, which says what is cut"
             : "";
}

std::string prepare_caps(SceneFile& file, const ClipArguments& arguments,
                         const std::vector<std::int32_t>& files) {
  if (!arguments.caps) return {};
  const Scene& scene = file.scene;
  file.options.parts = nullptr;
  if (!bad_edges(scene).empty()) {
    return "--cap: only cuts of solids are filled, and this surface is not "
           "closed";
  }
  const auto& [style, by] = *arguments.caps;
  if (by == CapsBy::kPart) {
    file.options.parts = told_apart(connected_parts(scene), style);
  } else if (by == CapsBy::kFile) {
    if (files.empty())
      return "--cap: file is for draw, which takes several; give part";
    file.options.parts = told_apart({files.begin(), files.end()}, style);
  }
  if (by == CapsBy::kFile &&
      !are_parts_closed(scene, file.options.parts->part_of)) {
    return "--cap: only cuts of solids are filled, and one of the files is not "
           "closed by itself";
  }
  return {};
}

}  // namespace halfspace::tools
