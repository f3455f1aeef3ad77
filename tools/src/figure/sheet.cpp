#include "figure/sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string_view>
#include <utility>

#include "cli/options.hpp"
#include "halfspace/io/view.hpp"
#include "image/viewing.hpp"

namespace halfspace::tools {
namespace {

/// Millimetres round a sheet and between its views.
constexpr double kMarginMm = 10;
/// Pixels of the cameras a millimetre: only a unit, as points are exact.
constexpr double kPixelsPerMm = 10;

std::optional<std::pair<double, double>> parse_sheet(std::string_view text) {
  constexpr std::pair<std::string_view, std::pair<double, double>> kNames[] = {
      {"a0", {1189, 841}},
      {"a1", {841, 594}},
      {"a2", {594, 420}},
      {"a3", {420, 297}},
      {"a4", {297, 210}}};
  for (const auto& [name, size] : kNames) {
    if (text == name) return size;
  }
  const std::size_t by = text.find('x');
  if (by == std::string_view::npos) return std::nullopt;
  const auto width = parse_number<double>(text.substr(0, by));
  const auto height = parse_number<double>(text.substr(by + 1));
  const auto fits = [](const std::optional<double>& length) {
    return length && *length >= 30 && *length <= 5000;
  };
  if (!fits(width) || !fits(height)) return std::nullopt;
  return std::pair{*width, *height};
}

std::optional<double> parse_scale(std::string_view text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) return std::nullopt;
  const auto paper = parse_number<double>(text.substr(0, colon));
  const auto model = parse_number<double>(text.substr(colon + 1));
  if (!paper || !model || !(*paper > 0) || !(*model > 0)) return std::nullopt;
  return *paper / *model;
}

std::optional<std::vector<std::string>> parse_views(std::string_view text) {
  std::vector<std::string> views;
  while (true) {
    const std::size_t comma = text.find(',');
    const std::string_view word = text.substr(0, comma);
    if (!view_direction(word) || views.size() == 9) return std::nullopt;
    views.emplace_back(word);
    if (comma == std::string_view::npos) return views;
    text.remove_prefix(comma + 1);
  }
}

/// The size of a scene as seen from a direction. Units: model units.
glm::dvec2 extent_of(const Scene& scene, const io::ViewDirection& direction,
                     const glm::dvec3& middle) {
  const glm::dvec3 back = glm::normalize(direction.to_eye);
  const glm::dvec3 right = glm::normalize(glm::cross(direction.up, back));
  const glm::dvec3 up = glm::cross(back, right);
  const double unit =
      std::pow(static_cast<double>(scene.unit().base), scene.unit().exponent);
  glm::dvec2 most(0);
  for (const VertexId v : scene.data().corners) {
    const GridPoint& g = scene.point(v);
    const glm::dvec3 p =
        unit * glm::dvec3(static_cast<double>(g.x), static_cast<double>(g.y),
                          static_cast<double>(g.z)) -
        middle;
    most.x = std::max(most.x, std::abs(glm::dot(p, right)));
    most.y = std::max(most.y, std::abs(glm::dot(p, up)));
  }
  return 2.0 * most;
}

/// The greatest usual scale that is not above `most`.
double usual_scale(double most) {
  const double tens = std::pow(10, std::floor(std::log10(most)));
  for (const double step : {5.0, 2.0, 1.0}) {
    if (step * tens <= most) return step * tens;
  }
  return tens;
}

}  // namespace

void add_sheet_options(CLI::App& app, SheetArguments& arguments) {
  const std::string group = "Sheet";
  add_parsed(app, "--sheet", "SIZE",
             "a0, a1, a2, a3, a4, or WxH in millimetres, from 30 to 5000",
             arguments.size, parse_sheet,
             "Draw several orthographic views on paper, lying")
      ->group(group);
  add_parsed(app, "--views", "VIEW,...",
             "up to nine of front, back, left, right, top, bottom, iso, with "
             "commas",
             arguments.views, parse_views,
             "What stands on the sheet; front,left,top,iso if not said")
      ->group(group);
  add_parsed(app, "--scale", "A:B", "two numbers above 0, such as 1:2",
             arguments.scale, parse_scale,
             "Of paper to model, whose unit is a millimetre")
      ->group(group);
}

std::string scale_text(double scale) {
  return scale >= 1 ? fmt::format("{:.6g}:1", scale)
                    : fmt::format("1:{:.6g}", 1 / scale);
}

Result<std::vector<SheetView>> views_on(const SheetArguments& sheet,
                                        const Scene& scene) {
  const std::size_t count = sheet.views.size();
  const std::size_t columns = count > 4 ? 3 : count > 1 ? 2 : 1;
  const std::size_t rows = (count + columns - 1) / columns;
  const auto part = [](double length, std::size_t parts) {
    const auto n = static_cast<double>(parts);
    return (length - kMarginMm * (n + 1)) / n;
  };
  const double width = part(sheet.width_mm(), columns);
  const double height = part(sheet.height_mm(), rows);
  const glm::dvec3 middle = io::middle_of(scene);
  double most = 1e300;
  for (const std::string& view : sheet.views) {
    const glm::dvec2 size = extent_of(scene, *view_direction(view), middle);
    most = std::min({most, width / size.x, height / size.y});
  }
  if (!(width > 1 && height > 1) || (sheet.scale && *sheet.scale > most)) {
    return Error{ErrorCode::kBadCamera,
                 "the views have no room on the sheet; give a larger --sheet "
                 "or a --scale of at most " +
                     scale_text(usual_scale(most))};
  }
  const double scale = sheet.scale.value_or(usual_scale(most));
  std::vector<SheetView> views;
  for (std::size_t k = 0; k < count; ++k) {
    const io::ViewDirection direction = *view_direction(sheet.views[k]);
    io::ViewOptions options;
    options.orthographic = true;
    options.target = middle;
    options.eye = middle + glm::normalize(direction.to_eye) * height / scale;
    options.up = direction.up;
    options.width_px = static_cast<std::int32_t>(width * kPixelsPerMm);
    options.height_px = static_cast<std::int32_t>(height * kPixelsPerMm);
    options.ortho_height = options.height_px / (kPixelsPerMm * scale);
    const Result<io::Viewed> viewed = io::look_at(scene, options);
    if (!viewed) return viewed.error();
    const auto place = [](std::size_t index, double size) {
      return kMarginMm + static_cast<double>(index) * (size + kMarginMm);
    };
    views.push_back({viewed->camera,
                     {place(k % columns, width), place(k / columns, height),
                      1 / kPixelsPerMm},
                     scale});
  }
  return views;
}

}  // namespace halfspace::tools
