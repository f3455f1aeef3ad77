#include "core/measure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "core/combine.hpp"
#include "core/moves.hpp"
#include "halfspace/io/stop.hpp"

namespace halfspace::viewer {

using glm::dvec2;
using glm::dvec3;

std::optional<dvec2> projected(const io::ViewOptions& camera,
                               const dvec3& point) {
  const CameraAxes axes = axes_of(camera);
  const dvec3 from_eye = point - camera.eye;
  const double depth = -glm::dot(from_eye, axes.back);
  double px_per_unit = camera.height_px;
  if (camera.orthographic) {
    px_per_unit /= camera.ortho_height;
  } else {
    if (!(depth > 0)) return std::nullopt;
    px_per_unit /=
        2 * depth * std::tan(camera.fov_deg * std::numbers::pi / 360);
  }
  return dvec2(camera.width_px / 2.0, camera.height_px / 2.0) +
         px_per_unit * dvec2(glm::dot(from_eye, axes.right),
                             -glm::dot(from_eye, axes.up));
}

double angle_deg(const dvec3& a, const dvec3& apex, const dvec3& b) {
  const dvec3 u = a - apex, v = b - apex;
  const double sine = glm::length(glm::cross(u, v));
  const double cosine = glm::dot(u, v);
  return sine == 0 && cosine == 0
             ? 0
             : std::atan2(sine, cosine) * 180 / std::numbers::pi;
}

double six_digits(double value) {
  return std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr);
}

double triangle_area(const dvec3& a, const dvec3& b, const dvec3& c) {
  return glm::length(glm::cross(b - a, c - a)) / 2;
}

namespace {

/// The area of a loop of points in a plane, with a sign, times its normal.
dvec3 area_vector(const std::vector<Point>& loop) {
  dvec3 sum(0);
  const auto at = [&loop](std::size_t i) {
    const Point& p = loop[i % loop.size()];
    return dvec3(p.x, p.y, p.z);
  };
  for (std::size_t i = 0; i < loop.size(); ++i)
    sum += glm::cross(at(i) - at(0), at(i + 1) - at(0));
  return sum / 2.0;
}

/// The areas of the cuts, of each section that is on.
Result<std::vector<double>> section_areas(const Solid& solid,
                                          const State& state) {
  std::vector<double> areas;
  for (const Section& section : state.sections) {
    if (!section.is_on) continue;
    const auto& [x, y, z] = section.normal;
    const auto regions = solid.section({{x, y, z}, section.offset});
    if (!regions) return regions.error();
    double area = 0;
    for (const Region& region : *regions) {
      // Holes go round the other way.
      dvec3 sum = area_vector(region.boundary);
      for (const auto& hole : region.holes) sum += area_vector(hole);
      area += glm::length(sum);
    }
    areas.push_back(area);
  }
  return areas;
}

/// The areas of the cuts, a line each, and below those of each part where parts
/// are beside each other: where they overlap, these are more.
Result<std::string> section_lines(const Solid& solid, const State& state) {
  const auto all = section_areas(solid, state);
  if (!all) return all.error();
  std::vector<std::string> lines;
  for (const double area : *all)
    lines.push_back(fmt::format("\nsection of area {:.12g}", area));
  const auto shown =
      std::count_if(state.parts.begin(), state.parts.end(),
                    [](const Part& part) { return part.is_visible; });
  const bool has_parts =
      shown > 1 && state.combination == Combination::kNone && !lines.empty();
  for (std::size_t p = 0; has_parts && p < state.parts.size(); ++p) {
    if (!state.parts[p].is_visible) continue;
    State alone = state;
    for (std::size_t other = 0; other < alone.parts.size(); ++other)
      alone.parts[other].is_visible = other == p;
    const auto own = section_areas(solid_of(alone), alone);
    if (!own) return own.error();
    const std::filesystem::path path = state.parts[p].path;
    for (std::size_t k = 0; k < lines.size(); ++k) {
      lines[k] +=
          fmt::format("\n  {} {:.12g}", path.filename().string(), (*own)[k]);
    }
  }
  std::string text;
  for (const std::string& line : lines) text += line;
  return text;
}

}  // namespace

Result<std::string> measures_of(const State& state, const Report& report) {
  // The boolean counts its progress. Reading comes before it, and the numbers
  // come after: a quarter of the bar each.
  const auto part = [&report](double from, double to) {
    return [&report, from, to](double share) {
      return report("measuring", from + (to - from) * share);
    };
  };
  if (!report("measuring", 0)) return io::stopped();
  const Solid solid = solid_of(state);
  WorkOptions options;
  options.progress = part(0.25, 0.75);
  const auto done = solid.evaluate(options);
  if (!done) return done.error();
  if (!part(0.75, 1)(0)) return io::stopped();
  const auto volume = solid.exact_volume();
  if (!volume) return volume.error();
  const auto area = solid.area();
  if (!area) return area.error();
  const auto exact_area = solid.exact_area();
  const auto bounds = solid.bounds();
  if (!bounds) return bounds.error();
  const auto rounding = solid.rounding();
  if (!rounding) return rounding.error();
  const std::string rounded =
      rounding->moved == 0
          ? std::string()
          : fmt::format("\nof coordinates rounded by {:.2g} at most",
                        rounding->max_move);
  if (!part(0.75, 1)(0.5)) return io::stopped();
  const auto sections = section_lines(solid, state);
  if (!sections) return sections.error();
  const Point& low = bounds->low;
  const Point& high = bounds->high;
  return fmt::format(
      "volume {} = {}\narea {}{}\nbox {:.6g} x {:.6g} x {:.6g}{}{}",
      *solid.volume(), *volume, *area,
      exact_area && *exact_area ? " = " + **exact_area : std::string(),
      high.x - low.x, high.y - low.y, high.z - low.z, *sections, rounded);
}

}  // namespace halfspace::viewer
