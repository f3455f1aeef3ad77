#include <utility>

#include "sah/sah_builder.hpp"

namespace halfspace::fast {
namespace {

/// How often progress is told, at most.
constexpr double kToldShare = 1.0 / 256;

}  // namespace

DisplayWork::DisplayWork(const Scene& a_scene,
                         const DisplayTreeOptions& the_options)
    : scene(a_scene), options(the_options) {
  if (scene.data().vertices.empty()) return;
  GridPoint low = scene.data().vertices.front();
  GridPoint high = low;
  for (const GridPoint& p : scene.data().vertices) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y),
            std::max(high.z, p.z)};
  }
  const auto length = [](std::int64_t from, std::int64_t to) {
    return static_cast<double>(to - from);
  };
  scene_size =
      std::max(1.0, half_surface(length(low.x, high.x), length(low.y, high.y),
                                 length(low.z, high.z)) /
                        2);
  origin = {low.x + (high.x - low.x) / 2, low.y + (high.y - low.y) / 2,
            low.z + (high.z - low.z) / 2};
}

Item DisplayWork::item_of(PolygonId polygon) const {
  const auto corners = scene.corners(polygon);
  GridPoint low = scene.point(corners[0]);
  GridPoint high = low;
  for (const VertexId v : corners.subspan(1)) {
    const GridPoint& p = scene.point(v);
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y),
            std::max(high.z, p.z)};
  }
  // Differences of at most 54 bits and a sign: rounded once, outwards.
  const auto down = [](std::int64_t a, std::int64_t b) {
    return below(static_cast<double>(a - b));
  };
  const auto up = [](std::int64_t a, std::int64_t b) {
    return above(static_cast<double>(a - b));
  };
  return {{down(low.x, origin.x), down(low.y, origin.y), down(low.z, origin.z)},
          polygon,
          {up(high.x, origin.x), up(high.y, origin.y), up(high.z, origin.z)},
          kWhole};
}

void DisplayWork::add_done(double share) {
  const std::lock_guard<std::mutex> lock(mutex_);
  done_ += share;
  if (is_stopped() || done_ < told_ + kToldShare) return;
  told_ = done_;
  if (!options.progress(std::min(done_, 1.0))) stopped_ = true;
}

/// A job of its own for some of the items: with copies of what they refer to.
DisplayJob DisplayWorker::job_of(const Item* items, std::size_t count,
                                 const Box& box, double share,
                                 double allowance) const {
  DisplayJob job;
  job.items.assign(items, items + count);
  job.box = box;
  job.share = share;
  job.allowance = allowance;
  job.tree.free_planes = job_.tree.free_planes;
  job.inherited_planes = job_.tree.free_planes.size();
  const auto vertex_count =
      static_cast<std::int32_t>(work_.scene.data().vertices.size());
  std::vector<std::int32_t> copies(job_.tree.cut_vertices.size(), -1);
  for (Item& item : job.items) {
    if (item.part == kWhole) continue;
    const Part& part = job_.parts[static_cast<std::size_t>(item.part)];
    item.part = static_cast<std::int32_t>(job.parts.size());
    job.parts.push_back({part.source,
                         static_cast<std::uint32_t>(job.tree.corners.size()),
                         part.count});
    for (std::uint32_t k = 0; k < part.count; ++k) {
      Corner corner = job_.tree.corners[part.first + k];
      if (corner.vertex >= vertex_count) {
        const auto old = static_cast<std::size_t>(corner.vertex - vertex_count);
        if (copies[old] < 0) {
          copies[old] = static_cast<std::int32_t>(job.tree.cut_vertices.size());
          job.tree.cut_vertices.push_back(job_.tree.cut_vertices[old]);
        }
        corner.vertex = vertex_count + copies[old];
      }
      job.tree.corners.push_back(corner);
    }
  }
  return job;
}

}  // namespace halfspace::fast
