#include "figure/bands.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "halfspace/assert.hpp"
#include "halfspace/fast/shade/color_forms.hpp"

namespace halfspace::tools {
namespace {

/// The colour of a number (S11.3).
Rgb scale_color(const ColorScale& scale, double value) {
  if (std::isnan(value)) return scale.no_data;
  if (scale.limits && (value < scale.limits->low || value > scale.limits->high))
    return scale.limits->color;
  const auto above =
      std::upper_bound(scale.steps.begin(), scale.steps.end(), value);
  return scale.colors[static_cast<std::size_t>(above - scale.steps.begin())];
}

/// A colour in the light that falls on it (S11.4).
Rgb dimmed(Rgb color, Rgb light) {
  const auto channel = [](int m, int c) {
    return static_cast<std::uint8_t>((2 * m * c + 255) / (2 * 255));
  };
  return {channel(color.r, light.r), channel(color.g, light.g),
          channel(color.b, light.b)};
}

/// The numbers at which colours change, those within two others alone.
std::vector<double> changes_between(const ColorScale& scale, double low,
                                    double high) {
  std::vector<double> changes;
  const auto add = [&](double value) {
    if (low < value && value <= high) changes.push_back(value);
  };
  if (scale.limits) add(scale.limits->low);
  for (const double step : scale.steps) add(step);
  if (scale.limits && scale.limits->high < high)
    add(std::nextafter(scale.limits->high, high));
  return changes;
}

struct Extent {
  double low = 0;
  double high = 0;
};

/// The least and the greatest number of a polygon; nothing where one is
/// missing.
std::optional<Extent> extent_of(std::span<const double> values) {
  Extent extent = {values[0], values[0]};
  for (const double value : values) {
    if (std::isnan(value)) return std::nullopt;
    extent = {std::min(extent.low, value), std::max(extent.high, value)};
  }
  return extent;
}

}  // namespace

std::vector<bool> banded_polygons(const Scene& scene, const ScalarField& field,
                                  const ColorScale& scale) {
  std::vector<bool> banded;
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    const auto extent = extent_of(field.of(scene, static_cast<PolygonId>(p)));
    banded.push_back(
        extent && !changes_between(scale, extent->low, extent->high).empty());
  }
  return banded;
}

Scene scalar_scene(const Scene& scene, const ShownScalars& scalars) {
  SceneData data = scene.data();
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    if (scalars.banded[p]) continue;
    const auto values = scalars.field.of(scene, static_cast<PolygonId>(p));
    const double value = extent_of(values) ? values[0] : kNoData;
    data.colors[p] =
        dimmed(scale_color(scalars.legend.scale, value), data.colors[p]);
  }
  Result<Scene> made = make_scene(std::move(data));
  HALFSPACE_ASSERT(made.has_value());
  return std::move(*made);
}

BandCutter::BandCutter(const Scene& scene, const Camera& camera,
                       const ShownScalars& scalars)
    : scene_(scene), camera_(camera), scalars_(scalars) {
  constexpr std::array<Rgb, 3> kShares = {
      {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}}};
  SceneData data = scene.data();
  data.corner_colors.clear();
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    const std::size_t count = scene.corners(static_cast<PolygonId>(p)).size();
    for (std::size_t k = 0; k < count; ++k)
      data.corner_colors.push_back(kShares[count == 3 ? k : 0]);
  }
  Result<Scene> made = make_scene(std::move(data));
  HALFSPACE_ASSERT(made.has_value());
  shares_ = std::move(*made);
}

/// A number is the quotient of S = sum(w[k] v[k]) and D = sum(w[k]), so that
/// it is a step t on the line S - t D = 0 of the image.
std::vector<io::FigureRegion> BandCutter::cut(const io::FigureRegion& region,
                                              PolygonId polygon,
                                              const Placing& placing) const {
  const auto values = scalars_.field.of(scene_, polygon);
  const auto forms = fast::color_forms(shares_, camera_, polygon);
  const std::optional<Extent> extent = extent_of(values);
  HALFSPACE_ASSERT(forms && extent);
  const Rgb light = scene_.color(polygon);
  const auto line_of = [&](double step) {
    std::array<double, 3> line{};
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t k = 0; k < 3; ++k)
        line[c] += forms->forms[k][c] / 255 * (values[k] - step);
    }
    return std::array<double, 3>{
        line[0] / placing.scale, line[1] / placing.scale,
        line[2] - (line[0] * placing.x + line[1] * placing.y) / placing.scale};
  };
  std::vector<io::FigureRegion> bands;
  const ColorScale& scale = scalars_.legend.scale;
  auto rest = region.loops;
  const auto add = [&](std::vector<std::vector<io::FigurePoint>> loops,
                       double value) {
    if (loops.empty()) return;
    const Rgb color = dimmed(scale_color(scale, value), light);
    io::FigureRegion band = region;
    band.fill = color;
    band.loops = std::move(loops);
    bands.push_back(std::move(band));
  };
  double value = extent->low;
  for (const double step : changes_between(scale, extent->low, extent->high)) {
    const auto line = line_of(step);
    add(io::cut_loops(rest, line, true), value);
    rest = io::cut_loops(rest, line, false);
    value = step;
  }
  add(std::move(rest), value);
  return bands;
}

}  // namespace halfspace::tools
