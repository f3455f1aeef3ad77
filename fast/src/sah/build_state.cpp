#include "sah/build_state.hpp"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <span>

namespace halfspace::fast {
namespace {

/// Progress is reported after this share of the work, or when that much time
/// has passed: whoever wants to stop waits no longer. Untuned.
constexpr double kReportedPart = 1.0 / 256;
constexpr std::chrono::milliseconds kReportedTime(5);

/// The least box of points: its corners of least and greatest coordinates.
struct GridBox {
  GridPoint low;
  GridPoint high;

  explicit GridBox(const GridPoint& first) : low(first), high(first) {}
  void add(const GridPoint& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y),
            std::max(high.z, p.z)};
  }
  double most() const {
    return static_cast<double>(
        std::max({std::abs(low.x), std::abs(low.y), std::abs(low.z),
                  std::abs(high.x), std::abs(high.y), std::abs(high.z)}));
  }
};

}  // namespace

BuildState::BuildState(const Scene& a_scene,
                       const DisplayTreeOptions& the_options,
                       KeptCells* the_cells)
    : scene(a_scene), options(the_options), cells(the_cells) {
  if (scene.data().vertices.empty()) return;
  GridBox box(scene.data().vertices.front());
  for (const GridPoint& p : scene.data().vertices) box.add(p);
  range = {{box.low.x, box.low.y, box.low.z},
           {box.high.x, box.high.y, box.high.z}};
  const GridPoint size = {box.high.x - box.low.x, box.high.y - box.low.y,
                          box.high.z - box.low.z};
  const double half =
      half_surface(static_cast<double>(size.x), static_cast<double>(size.y),
                   static_cast<double>(size.z));
  scene_size = std::max(1.0, half / 2);
  origin = {box.low.x + size.x / 2, box.low.y + size.y / 2,
            box.low.z + size.z / 2};
  // Cells reach beyond the scene. Boxes of floats round outwards, and free
  // planes are in them.
  if (cells == nullptr || cells->count() == 0)
    most = std::min(most, box.most() * (1 + 0x1p-20) + 1);
}

BuildState::BuildState(const Scene& a_scene, const BuildState& frame)
    : scene(a_scene),
      options(frame.options),
      cells(nullptr),
      range(frame.range),
      origin(frame.origin),
      scene_size(frame.scene_size) {}

Primitive BuildState::primitive_of(PolygonId polygon) const {
  const auto corners = scene.corners(polygon);
  GridBox box(scene.point(corners[0]));
  for (const VertexId v : corners.subspan(1)) box.add(scene.point(v));
  // Differences of at most 54 bits and a sign: rounded once, outwards.
  const auto down = [](std::int64_t a, std::int64_t b) {
    return float_below(static_cast<double>(a - b));
  };
  const auto up = [](std::int64_t a, std::int64_t b) {
    return float_above(static_cast<double>(a - b));
  };
  return {{down(box.low.x, origin.x), down(box.low.y, origin.y),
           down(box.low.z, origin.z)},
          polygon,
          {up(box.high.x, origin.x), up(box.high.y, origin.y),
           up(box.high.z, origin.z)},
          kWholePolygon};
}

void BuildState::add_done(double share) {
  const Lock lock(mutex_);
  done_ += share;
  if (is_stopped()) return;
  const auto now = std::chrono::steady_clock::now();
  if (done_ < reported_ + kReportedPart && now < reported_at_ + kReportedTime)
    return;
  reported_ = done_;
  reported_at_ = now;
  if (!options.progress(std::min(done_, 1.0))) stopped_ = true;
}

}  // namespace halfspace::fast
