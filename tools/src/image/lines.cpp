#include "image/lines.hpp"

#include <cmath>
#include <numbers>
#include <string_view>

#include "cli/options.hpp"
#include "image/viewing.hpp"

namespace halfspace::tools {
namespace {

constexpr Word<ShownEdges> kEdgeWords[] = {{"outline", ShownEdges::kOutline},
                                           {"features", ShownEdges::kFeatures},
                                           {"wire", ShownEdges::kWire}};

constexpr double kUsualWidth = 1.25;
constexpr double kUsualCrease = 20;

}  // namespace

void add_line_options(CLI::App& app, LineArguments& arguments) {
  const std::string group = "Lines";
  add_choice(app, "--lines,--edges", kEdgeWords, arguments.edges,
             "Draw edges that are seen over the picture: borders, silhouettes "
             "and intersections; creases, too; or all edges between faces that "
             "do not lie in one plane")
      ->group(group);
  const auto parse_width = [](std::string_view text) {
    const auto width = parse_number<double>(text);
    return width && *width >= 1.0 / 16 && *width <= kMostLineWidth / 16.0
               ? width
               : std::nullopt;
  };
  add_parsed(app, "--line-width", "PX", "a number from 0.0625 to 256",
             arguments.width_px, parse_width,
             "Their width, in sixteenths of a pixel; 1.25 if not said")
      ->group(group);
  add_parsed(app, "--line-color", "R,G,B",
             "R,G,B, three whole numbers of at least 0 and at most 255, or "
             "#rrggbb",
             arguments.color, parse_color, "Their colour")
      ->group(group);
  const auto parse_angle = [](std::string_view text) {
    const auto angle = parse_number<double>(text);
    return angle && *angle >= 0 && *angle <= 180 ? angle : std::nullopt;
  };
  add_parsed(app, "--line-crease", "DEG", "a number from 0 to 180",
             arguments.crease_deg, parse_angle,
             "Creases are edges that turn by more than this; 20 if not said")
      ->group(group);
}

std::string line_complaint(const LineArguments& arguments) {
  if (arguments.edges) return {};
  return arguments.width_px || arguments.color || arguments.crease_deg
             ? "--line-width and what goes with it: needs --lines, which says "
               "what is drawn"
             : "";
}

ShownLines shown_lines(const LineArguments& arguments,
                       const ImageOptions& image) {
  ShownLines shown;
  shown.style.width = static_cast<std::int32_t>(
      std::lround(16 * arguments.width_px.value_or(kUsualWidth)));
  shown.style.color = arguments.color.value_or(shown.style.color);
  if (arguments.edges == ShownEdges::kOutline)
    shown.style.classes &= ~set_of(EdgeClass::kCrease);
  shown.drawing = drawing_over(image);
  if (arguments.edges != ShownEdges::kWire) {
    const double angle = arguments.crease_deg.value_or(kUsualCrease);
    shown.drawing.crease_cosine = static_cast<std::int32_t>(std::lround(
        std::ldexp(std::cos(angle * std::numbers::pi / 180), kCosineBits)));
  }
  return shown;
}

}  // namespace halfspace::tools
