#include "papers/screens.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "halfspace/fast/image/screens.hpp"
#include "halfspace/fast/painter.hpp"
#include "halfspace/fast/render.hpp"
#include "ours.hpp"
#include "scenes.hpp"
#include "timing.hpp"
#include "views.hpp"

namespace halfspace::bench {
namespace {

constexpr std::array<std::pair<ScreenKind, const char*>, 4> kKinds = {{
    {ScreenKind::kList, "lists"},
    {ScreenKind::kBsp1, "1-D trees"},
    {ScreenKind::kQuad, "quadtree"},
    {ScreenKind::kBsp2, "2-D tree"},
}};

/// Times of a frame on each screen and, last, on tiles. Units: ms.
using ScreenTimes = std::array<double, 5>;

/// Measures one scene at one size, and adds its row.
ScreenTimes add_screens(std::int64_t size, std::int64_t count,
                        std::int32_t size_px, std::uint64_t seed,
                        Table& table) {
  const Scene scene = random_triangles({size, count, false, seed});
  const Built built = build_by_rule(scene, {.rule = RootRule::kFirst});
  const Camera camera = universe_camera(View::kAskew, size_px);
  const ImageOptions options;
  ScreenTimes times{};
  std::array<std::size_t, 4> parts{};
  for (std::size_t k = 0; k < kKinds.size(); ++k) {
    fast::ScreenWork work;
    times[k] = processor_time(
                   [&] {
                     fast::render_on(scene, built.tree, camera, options,
                                     kKinds[k].first, &work);
                   },
                   {.most = 3, .budget_ms = 300})
                   .median;
    parts[k] = work.parts;
  }
  fast::Rendering image;
  times[4] =
      processor_time(
          [&] { fast::render(scene, built.tree, camera, options, {}, image); },
          {.most = 3, .budget_ms = 300})
          .median;
  const auto painted =
      fast::paint(scene, built.tree, camera, options).pixels_painted;
  const double overdraw =
      static_cast<double>(painted) /
      static_cast<double>(std::max<std::size_t>(image.pixels_painted, 1));
  std::vector<std::string> row = {std::to_string(size), std::to_string(count),
                                  std::to_string(built.stats.fragments),
                                  std::to_string(size_px), digits(overdraw)};
  for (const double time : times) row.push_back(digits(time));
  for (const std::size_t part : parts) row.push_back(std::to_string(part));
  table.rows.push_back(std::move(row));
  return times;
}

std::vector<Series> empty_series() {
  std::vector<Series> series;
  for (const auto& [kind, name] : kKinds) series.push_back({name, {}});
  series.push_back({"tiles (the usual screen)", {}});
  return series;
}

void add_points(double x, const ScreenTimes& times, Chart& chart) {
  for (std::size_t k = 0; k < times.size(); ++k)
    chart.series[k].points.emplace_back(x, times[k]);
}

}  // namespace

Report faq_screens(const Effort& effort) {
  Report report = {"faq-screens",
                   "FAQ: screens of four kinds, times of a frame in ms",
                   {},
                   {}};
  report.table.head = {
      "S",        "triangles", "in the tree",   "pixels a side",
      "overdraw", "lists",     "1-D trees",     "quadtree",
      "2-D tree", "tiles",     "segments left", "nodes",
      "squares",  "cells"};
  const std::string y = "processor time of a frame, ms";
  Chart by_size = {"Screens by the size of 200 triangles", "S", y, true,
                   empty_series()};
  for (const std::int64_t size : {25, 50, 100, 200, 400}) {
    add_points(
        static_cast<double>(size),
        add_screens(size, 200, effort.size_px / 3, effort.seed, report.table),
        by_size);
  }
  Chart by_resolution = {"Screens by resolution, 200 triangles of size 100",
                         "pixels a side", y, true, empty_series()};
  for (const std::int32_t part : {16, 8, 4, 2, 1}) {
    const std::int32_t pixels = std::max(4, effort.size_px / part);
    add_points(pixels, add_screens(100, 200, pixels, effort.seed, report.table),
               by_resolution);
  }
  Chart by_overdraw = {"Screens by the number of triangles of size 300",
                       "triangles", y, true, empty_series()};
  for (const std::int64_t count : {25, 50, 100, 200, 400}) {
    add_points(
        static_cast<double>(count),
        add_screens(300, count, effort.size_px / 3, effort.seed, report.table),
        by_overdraw);
  }
  report.figures.push_back({"faq-screens-size", std::move(by_size)});
  report.figures.push_back(
      {"faq-screens-resolution", std::move(by_resolution)});
  report.figures.push_back({"faq-screens-overdraw", std::move(by_overdraw)});
  return report;
}

}  // namespace halfspace::bench
