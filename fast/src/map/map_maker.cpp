#include "map/map_maker.hpp"

#include <algorithm>
#include <bit>
#include <string>

#include "map/assembly.hpp"

namespace halfspace::fast {
namespace {

/// How often the image is halved beforehand, so that a cell meets few
/// fragments if they are small.
int grid_depth(std::size_t fragments) {
  constexpr int kMostHalvings = 14;
  return std::clamp(static_cast<int>(std::bit_width(fragments)) - 4, 0,
                    kMostHalvings);
}

Rectangle whole_of(const Camera& camera) {
  return {0, 0, camera->width_px, camera->height_px};
}

}  // namespace

MapMaker::MapMaker(const Scene& scene, const BspTree& tree,
                   const Camera& camera, const ImageOptions& image)
    : feed_(scene, tree, camera, image, whole_of(camera)),
      cells_(feed_.lines(), whole_of(camera),
             grid_depth(tree.fragments.size())) {}

MapMaker::MapMaker(const Scene& scene, const BspTree& tree,
                   const Camera& camera, const ImageOptions& image,
                   const Rectangle& part)
    : feed_(scene, tree, camera, image, part), cells_(feed_.lines(), part, 0) {}

void MapMaker::light_all(bool cull, const MapLimits& limits) {
  const auto light = [&](std::span<const HalfPlane> sides, PolygonId item) {
    cells_.light(sides, item);
    return goes_on(limits);
  };
  // What is kept is behind the planes that the eye is behind (S10, "Caps need
  // no depth order").
  feed_.run_caps(-1, light);
  run(cull, true, limits, [&](std::span<const HalfPlane> sides, PolygonId id) {
    cells_.light(sides, id);
    return !cells_.full();
  });
  if (!cull && !too_many_) feed_.run_caps(1, light);
}

Result<VisibleMap> MapMaker::finish(
    const MapLimits& limits,
    const std::function<std::int32_t(PolygonId)>& key_of) {
  if (too_many_) {
    return Error{ErrorCode::kOutOfRange, "the visible map has more than " +
                                             std::to_string(limits.most_cells) +
                                             " cells, which is the limit"};
  }
  feed_.lines().forget_names();
  VisibleMap map = assemble(cells_, feed_.lines(), key_of);
  map.decisions = feed_.lines().stats();
  map.decisions.add(feed_.stats());
  return map;
}

}  // namespace halfspace::fast
