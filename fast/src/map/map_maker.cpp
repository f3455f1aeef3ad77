#include "map/map_maker.hpp"

#include <algorithm>
#include <bit>
#include <string>
#include <vector>

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
                   const Rectangle& part, int depth)
    : feed_(scene, tree, camera, image, part),
      cells_(feed_.lines(), part, depth) {}

void MapMaker::light_all(bool cull, const MapLimits& limits) {
  run(cull, true, limits, [&](std::span<const HalfPlane> sides, PolygonId id) {
    cells_.light(sides, id);
    return !cells_.full();
  });
}

void MapMaker::cover_all(bool cull, const MapLimits& limits,
                         const Layer& layer) {
  run(cull, false, limits, [&](std::span<const HalfPlane> sides, PolygonId id) {
    cells_.cover(sides, [&](PolygonId list) { return layer(list, id); });
    return true;
  });
}

VisibleMap MapMaker::finish(
    const std::function<std::int32_t(PolygonId)>& key_of) {
  feed_.lines().forget_names();
  VisibleMap map = assemble(cells_, feed_.lines(), key_of);
  map.decisions = feed_.lines().stats();
  map.decisions.add(feed_.stats());
  return map;
}

namespace {

/// How many cells a map has that has more than its limit.
///
/// Cells of the whole image are counted if they may be at a time, else those of
/// its halves, or of theirs; what is cut there counts twice. After four times
/// as many the count ends.
std::string count_in_words(const Scene& scene, const BspTree& tree,
                           const Camera& camera, const ImageOptions& image,
                           const MapLimits& limits, const FillCells& fill) {
  const MapLimits at_once = {
      std::max(limits.counted_at_once, limits.most_cells)};
  const std::size_t most = 4 * at_once.most_cells;
  const Rectangle whole = whole_of(camera);
  std::vector<Rectangle> parts = {whole};
  std::size_t count = 0;
  bool is_whole = true;
  while (!parts.empty()) {
    const Rectangle part = parts.back();
    parts.pop_back();
    MapMaker maker(scene, tree, camera, image, part,
                   is_whole ? grid_depth(tree.fragments.size()) : 0);
    fill(maker, at_once);
    const std::int32_t across = part.right - part.left;
    const std::int32_t down = part.bottom - part.top;
    if (!maker.has_too_many()) {
      count += maker.cells().cell_count();
    } else if (across == 1 && down == 1) {
      count = most + 1;
    } else {
      Rectangle low = part;
      Rectangle high = part;
      if (across >= down) {
        low.right = high.left = part.left + across / 2;
      } else {
        low.bottom = high.top = part.top + down / 2;
      }
      parts.push_back(high);
      parts.push_back(low);
      is_whole = false;
    }
    if (count > most) return "more than " + std::to_string(most);
  }
  return (is_whole ? "" : "about ") + std::to_string(count);
}

}  // namespace

Result<VisibleMap> filled_map(
    const Scene& scene, const BspTree& tree, const Camera& camera,
    const ImageOptions& image, const MapLimits& limits, const FillCells& fill,
    const std::function<std::int32_t(PolygonId)>& key_of) {
  {
    MapMaker maker(scene, tree, camera, image);
    fill(maker, limits);
    if (!maker.has_too_many()) return maker.finish(key_of);
  }
  return Error{ErrorCode::kOutOfRange,
               "the visible map needs " +
                   count_in_words(scene, tree, camera, image, limits, fill) +
                   " cells, and the limit is " +
                   std::to_string(limits.most_cells)};
}

}  // namespace halfspace::fast
