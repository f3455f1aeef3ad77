#include "peers/row.hpp"

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>
#include <unordered_set>

#include "peers/peer.hpp"

namespace halfspace::bench {
namespace {

/// Resets the peak of this process's memory.
void forget_peak() { std::ofstream("/proc/self/clear_refs") << "5"; }

/// The peak since then; 0 where the system does not report it.
std::size_t peak_bytes() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind("VmHWM:", 0) != 0) continue;
    std::size_t kibibytes = 0;
    std::istringstream(line.substr(6)) >> kibibytes;
    return kibibytes * 1024;
  }
  return 0;
}

/// The most polygons for which the painter is measured, over a tree of the
/// paper. Larger scenes would take hours.
constexpr std::size_t kMostPainted = 10'000;

void measure_painter(const Scene& scene, const Camera& camera, const Plan& plan,
                     const fast::Rendering& flat, const fast::Rendering& smooth,
                     OurCosts& costs,
                     std::vector<WrongPicture>& wrong_pictures) {
  const Built built = build_by_rule(scene, {});
  Ours ours(scene, built.tree, camera, plan.simd);
  const auto time = [&](Shading shading) {
    return processor_time([&] { ours.paint(shading); }, plan.repeats).least;
  };
  costs.painter_flat = time(Shading::kFlat);
  if (ours.frame().colors != flat.colors) {
    wrong_pictures.push_back({"ours, back to front, flat", 0});
  }
  costs.painter_smooth = time(Shading::kGouraud);
  if (ours.frame().colors != smooth.colors) {
    wrong_pictures.push_back({"ours, back to front, smooth", 0});
  }
}

/// Exact decisions over the image's pixels.
double exact_share(const fast::Rendering& frame) {
  return static_cast<double>(frame.decisions.exact) /
         static_cast<double>(frame.colors.pixels.size());
}

OurCosts measure_ours(const Scene& scene, const Camera& camera,
                      const Plan& plan, std::vector<PolygonId>& items,
                      std::vector<WrongPicture>& wrong_pictures) {
  OurCosts costs;
  forget_peak();
  const Built built = build_for_display(scene);
  costs.build = built.build_ms;
  costs.build_peak_bytes = peak_bytes();
  costs.tree_bytes = built.bytes;
  costs.stats = built.stats;

  Ours ours(scene, built.tree, camera, plan.simd);
  const auto flat = [&] { ours.draw(Shading::kFlat); };
  const auto smooth = [&] { ours.draw(Shading::kGouraud); };
  costs.smooth = processor_time(smooth, plan.repeats).least;
  const ColorImage smooth_colors = ours.frame().colors;
  ours.draw_all(Shading::kGouraud);
  const fast::Rendering smooth_frame = ours.frame();
  costs.flat = processor_time(flat, plan.repeats).least;
  const ColorImage flat_colors = ours.frame().colors;
  ours.draw_all(Shading::kFlat);
  const fast::Rendering flat_frame = ours.frame();
  if (smooth_colors != smooth_frame.colors ||
      flat_colors != flat_frame.colors) {
    wrong_pictures.push_back({"ours, colours alone", 0});
  }
  items = flat_frame.items.pixels;
  costs.flat_share = exact_share(flat_frame);
  costs.smooth_share = exact_share(smooth_frame);
  costs.fragments_displayed = flat_frame.fragments_displayed;
  costs.tiles_touched = flat_frame.tiles_touched;
  costs.elapsed_one = elapsed_time(flat, plan.repeats).least;
  costs.elapsed_two =
      elapsed_time([&] { ours.draw(Shading::kFlat, 2); }, plan.repeats).least;
  if (ours.frame().colors != flat_frame.colors) {
    wrong_pictures.push_back({"ours, two threads", 0});
  }
  if (plan.back_to_front && scene.polygon_count() <= kMostPainted) {
    measure_painter(scene, camera, plan, flat_frame, smooth_frame, costs,
                    wrong_pictures);
  }
  return costs;
}

}  // namespace

Row measure_row(const Workload& workload, const Scene& scene,
                const Plan& plan) {
  Row row;
  row.name = workload.name;
  row.polygons = scene.polygon_count();
  const Camera camera = workload.camera(scene, plan.view, plan.size_px);
  std::vector<PolygonId> items;
  row.ours = measure_ours(scene, camera, plan, items, row.wrong_pictures);

  std::unordered_set<PolygonId> seen(items.begin(), items.end());
  seen.erase(kBackground);
  row.visible = seen.size();
  const Soup soup = make_soup(scene, camera);
  row.overdraw = overdraw_of(soup);
  const Checks checks = {items, workload.parallel && plan.view == View::kFront};
  if (plan.peers) {
    row.peers = measure_peers(soup, checks, plan.repeats, row.wrong_pictures);
  }
  return row;
}

}  // namespace halfspace::bench
