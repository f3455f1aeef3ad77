#include "papers/frames.hpp"

#include <array>
#include <functional>
#include <string>
#include <utility>

#include "ours.hpp"
#include "scenes.hpp"
#include "timing.hpp"
#include "views.hpp"

namespace halfspace::bench {
namespace {

/// F2B's four ways to display a tree. Units: ms of processor time.
struct Displays {
  double back_constant = 0;
  double front_constant = 0;
  double back_gouraud = 0;
  double front_gouraud = 0;
};

/// The median over the cameras, each measured by its own median.
Displays display_times(const Scene& scene, const fast::BspTree& tree,
                       const std::vector<Camera>& cameras) {
  std::array<std::vector<double>, 4> times;
  for (const Camera& camera : cameras) {
    Ours ours(scene, tree, camera);
    const auto add = [&](std::size_t variant,
                         const std::function<void()>& frame) {
      times[variant].push_back(
          processor_time(frame, {.most = 3, .budget_ms = 400}).median);
    };
    add(0, [&] { ours.paint(Shading::kFlat); });
    add(1, [&] { ours.draw(Shading::kFlat); });
    add(2, [&] { ours.paint(Shading::kGouraud); });
    add(3, [&] { ours.draw(Shading::kGouraud); });
  }
  return {median(times[0]), median(times[1]), median(times[2]),
          median(times[3])};
}

std::string percent(double part, double whole) {
  return digits(100 * part / whole) + " %";
}

const std::vector<std::string> kHead = {"figure",         "S",
                                        "triangles",      "in the tree",
                                        "constant, back", "constant, front",
                                        "front / back",   "paper",
                                        "Gouraud, back",  "Gouraud, front",
                                        "front / back",   "paper"};

/// The paper's text on a point of its figures; empty if it has none.
struct Said {
  const char* constant;
  const char* gouraud;
};

void add_row(const char* figure, std::int64_t size, std::int64_t count,
             std::size_t in_tree, const Displays& times, const Said& said,
             Table& table) {
  table.rows.push_back(
      {figure, std::to_string(size), std::to_string(count),
       std::to_string(in_tree), digits(times.back_constant),
       digits(times.front_constant),
       percent(times.front_constant, times.back_constant), said.constant,
       digits(times.back_gouraud), digits(times.front_gouraud),
       percent(times.front_gouraud, times.back_gouraud), said.gouraud});
}

/// The two lines of one shading, as the paper draws them.
class Lines {
 public:
  explicit Lines(const std::string& suffix)
      : back_{"back to front" + suffix, {}},
        front_{"front to back" + suffix, {}} {}

  void add(std::int64_t count, double back, double front) {
    back_.points.emplace_back(count, back);
    front_.points.emplace_back(count, front);
  }
  void add_to(Chart& chart) {
    chart.series.push_back(std::move(back_));
    chart.series.push_back(std::move(front_));
  }

 private:
  Series back_, front_;
};

Chart empty_chart(const std::string& title, bool logarithmic) {
  return {title, "triangles", "processor time of a frame, ms", logarithmic, {}};
}

}  // namespace

Report f2b_figures_12_to_14(const Effort& effort) {
  Report report = {"f2b-figures-12-to-14",
                   "F2B fig. 12 to 14: times of a frame, in ms",
                   {},
                   {}};
  report.table.head = kHead;
  Chart small = empty_chart("F2B fig. 12: triangles of size 50", false);
  Chart constant = empty_chart("F2B fig. 13: constant shading", false);
  Chart gouraud = empty_chart("F2B fig. 14: interpolation shading", false);
  const std::vector<Camera> cameras = {
      universe_camera(View::kFront, effort.size_px),
      universe_camera(View::kCorner, effort.size_px),
      universe_camera(View::kAskew, effort.size_px)};
  for (const std::int64_t size : {50, 300, 500}) {
    const std::string suffix = ", S " + std::to_string(size);
    Lines constant_lines(suffix + ", constant");
    Lines gouraud_lines(suffix + ", Gouraud");
    for (std::int64_t count = 100; count <= 500; count += 100) {
      const Scene scene = random_triangles({size, count, false, effort.seed});
      const Built built = build_by_rule(scene, {.rule = RootRule::kFirst});
      const Displays times = display_times(scene, built.tree, cameras);
      const bool known = size == 500 && count == 500;
      add_row(size == 50 ? "12" : "13, 14", size, count, built.stats.fragments,
              times, {"", known ? "about 14 %" : ""}, report.table);
      constant_lines.add(count, times.back_constant, times.front_constant);
      gouraud_lines.add(count, times.back_gouraud, times.front_gouraud);
    }
    constant_lines.add_to(size == 50 ? small : constant);
    gouraud_lines.add_to(size == 50 ? small : gouraud);
  }
  report.figures.push_back({"f2b-figure-12", std::move(small)});
  report.figures.push_back({"f2b-figure-13", std::move(constant)});
  report.figures.push_back({"f2b-figure-14", std::move(gouraud)});
  return report;
}

Report f2b_figures_15_16(const Effort& effort) {
  Report report = {"f2b-figures-15-16",
                   "F2B fig. 15 and 16: parallel triangles, in ms",
                   {},
                   {}};
  report.table.head = kHead;
  Chart constant =
      empty_chart("F2B fig. 15: parallel triangles, constant shading", true);
  Chart gouraud = empty_chart(
      "F2B fig. 16: parallel triangles, interpolation shading", true);
  const std::vector<Camera> cameras = {
      universe_camera(View::kFront, effort.size_px)};
  constexpr std::int64_t kSize = 500;
  Lines constant_lines(", constant");
  Lines gouraud_lines(", Gouraud");
  for (const std::int64_t count : {1'000, 3'000, 10'000, 30'000, 100'000}) {
    if (count > effort.most_parallel) continue;
    const Scene scene = random_triangles({kSize, count, true, effort.seed});
    const Built built = build_by_rule(scene, {.rule = RootRule::kFirst});
    const Displays times = display_times(scene, built.tree, cameras);
    const bool known = count >= 10'000;
    add_row("15, 16", kSize, count, built.stats.fragments, times,
            {known ? "about 30 %" : "", known ? "under 8 %" : ""},
            report.table);
    constant_lines.add(count, times.back_constant, times.front_constant);
    gouraud_lines.add(count, times.back_gouraud, times.front_gouraud);
  }
  constant_lines.add_to(constant);
  gouraud_lines.add_to(gouraud);
  report.figures.push_back({"f2b-figure-15", std::move(constant)});
  report.figures.push_back({"f2b-figure-16", std::move(gouraud)});
  return report;
}

Report fag83_table_2(const std::vector<Model>& models, const Effort& effort) {
  // The Ikonas of the paper shows 512 x 512 pixels.
  constexpr std::int32_t kSizePx = 512;
  Report report = {
      "fag83-table-2", "FAG83 table 2: frames in a second", {}, {}};
  report.table.head = {"model",           "polygons in the tree",
                       "back to front",   "front to back",
                       "paper, polygons", "paper, frames"};
  for (const Model& model : models) {
    const Built built = build_by_rule(
        model.scene,
        {.rule = RootRule::kRandom, .candidates = 5, .seed = effort.seed});
    std::vector<Camera> cameras;
    for (const View view : kViews) {
      cameras.push_back(scene_camera(model.scene, view, kSizePx));
    }
    const Displays times = display_times(model.scene, built.tree, cameras);
    report.table.rows.push_back({model.name,
                                 std::to_string(built.stats.fragments),
                                 digits(1000 / times.back_constant),
                                 digits(1000 / times.front_constant),
                                 model.paper_frames[0], model.paper_frames[1]});
  }
  return report;
}

}  // namespace halfspace::bench
