#include "papers/depth_sort.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "halfspace/fast/image/depth_sort.hpp"
#include "ours.hpp"
#include "scenes.hpp"
#include "timing.hpp"
#include "views.hpp"

namespace halfspace::bench {
namespace {

constexpr Repeats kFewSorts = {.most = 3, .budget_ms = 300};

/// Medians over three eyes. Units: ms of processor time, but for fragments.
struct PriorityTimes {
  double tree_fragments = 0;
  double build = 0;
  double tree_front = 0;
  double tree_back = 0;
  double list_fragments = 0;
  double sort = 0;
  double list_front = 0;
  double list_back = 0;
};

PriorityTimes priority_times(const Scene& scene,
                             const std::vector<Camera>& cameras) {
  const Built built = build_by_rule(scene, {.rule = RootRule::kFirst});
  std::array<std::vector<double>, 6> values;
  for (const Camera& camera : cameras) {
    fast::DepthSort sort;
    values[0].push_back(
        processor_time([&] { sort = fast::depth_sort(scene, camera); },
                       kFewSorts)
            .median);
    values[1].push_back(static_cast<double>(sort.list.fragments.size()));
    const auto draw = [&](const fast::BspTree& tree, std::size_t front,
                          std::size_t back) {
      Ours ours(scene, tree, camera);
      values[front].push_back(
          processor_time([&] { ours.draw(Shading::kFlat); }, kFewSorts).median);
      values[back].push_back(
          processor_time([&] { ours.paint(Shading::kFlat); }, kFewSorts)
              .median);
    };
    draw(built.tree, 2, 3);
    draw(sort.list, 4, 5);
  }
  PriorityTimes times;
  times.tree_fragments = static_cast<double>(built.stats.fragments);
  times.build = built.build_ms;
  times.sort = median(values[0]);
  times.list_fragments = median(values[1]);
  times.tree_front = median(values[2]);
  times.tree_back = median(values[3]);
  times.list_front = median(values[4]);
  times.list_back = median(values[5]);
  return times;
}

void add_priorities(const std::string& name, const Scene& scene,
                    const PriorityTimes& times, Table& table) {
  table.rows.push_back({name, std::to_string(scene.polygon_count()),
                        digits(times.tree_fragments, 9), digits(times.build),
                        digits(times.tree_front), digits(times.tree_back),
                        digits(times.list_fragments, 9), digits(times.sort),
                        digits(times.list_front), digits(times.list_back)});
}

std::vector<Camera> universe_cameras(std::int32_t size_px) {
  return {universe_camera(View::kFront, size_px),
          universe_camera(View::kCorner, size_px),
          universe_camera(View::kAskew, size_px)};
}

}  // namespace

Report f2b_depth_sort(const std::vector<Model>& models, const Effort& effort) {
  Report report = {"f2b-depth-sort",
                   "F2B: depth sort beside the BSP tree, times in ms",
                   {},
                   {}};
  report.table.head = {"scene",          "polygons",      "in the tree",
                       "build the tree", "tree, front",   "tree, back",
                       "in the list",    "sort the list", "list, front",
                       "list, back"};
  Chart fragments = {"Fragments of triangles of size 500",
                     "triangles",
                     "fragments",
                     false,
                     {{"BSP tree, all", {}}, {"depth sort, one eye", {}}}};
  Chart frames = {"A frame of triangles of size 500, front to back",
                  "triangles",
                  "processor time, ms",
                  true,
                  {{"BSP tree, built beforehand", {}},
                   {"BSP tree, built for it", {}},
                   {"depth sort for it", {}},
                   {"depth sort, its list alone", {}}}};
  for (const std::int64_t size : {50, 300, 500}) {
    for (const std::int64_t count : {100, 200, 300, 400, 500}) {
      const Scene scene = random_triangles({size, count, false, effort.seed});
      const PriorityTimes times =
          priority_times(scene, universe_cameras(effort.size_px));
      add_priorities("triangles, S = " + std::to_string(size), scene, times,
                     report.table);
      if (size != 500) continue;
      const auto x = static_cast<double>(count);
      fragments.series[0].points.emplace_back(x, times.tree_fragments);
      fragments.series[1].points.emplace_back(x, times.list_fragments);
      frames.series[0].points.emplace_back(x, times.tree_front);
      frames.series[1].points.emplace_back(x, times.build + times.tree_front);
      frames.series[2].points.emplace_back(x, times.sort + times.list_front);
      frames.series[3].points.emplace_back(x, times.list_front);
    }
  }
  for (const std::int64_t count : {1000, 10'000}) {
    if (count > effort.most_parallel) continue;
    const Scene scene = random_triangles({50, count, true, effort.seed});
    add_priorities("parallel triangles, S = 50", scene,
                   priority_times(scene, universe_cameras(effort.size_px)),
                   report.table);
  }
  for (const Model& model : models) {
    const std::vector<Camera> cameras = {
        scene_camera(model.scene, View::kFront, effort.size_px),
        scene_camera(model.scene, View::kCorner, effort.size_px),
        scene_camera(model.scene, View::kAskew, effort.size_px)};
    add_priorities(model.name, model.scene,
                   priority_times(model.scene, cameras), report.table);
  }
  report.figures.push_back({"f2b-depth-sort-fragments", std::move(fragments)});
  report.figures.push_back({"f2b-depth-sort-frames", std::move(frames)});
  return report;
}

}  // namespace halfspace::bench
