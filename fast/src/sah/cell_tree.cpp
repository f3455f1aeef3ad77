#include "sah/cell_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace halfspace::fast {
namespace {

std::int64_t coordinate_at(const GridPoint& p, std::size_t axis) {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

}  // namespace

void KeptCells::note_polygon(std::int32_t object, PolygonId polygon) {
  const Lock lock(mutex_);
  const std::pair<std::int32_t, PolygonId> found = {object, polygon};
  if (!filled_ || found < *filled_) filled_ = found;
}

void KeptCells::note_locked(std::int32_t object) {
  const Lock lock(mutex_);
  if (!locked_ || object < *locked_) locked_ = object;
}

std::optional<CellSplit> balanced_split(
    const KeptCells& cells, const std::vector<std::int32_t>& regions) {
  std::optional<CellSplit> best;
  std::size_t best_less = 0;  // regions in the smaller part
  std::vector<std::int32_t> order = regions;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto low = [&](std::int32_t r) {
      return coordinate_at(cells.region(r).low, axis);
    };
    std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
      return std::pair(low(a), a) < std::pair(low(b), b);
    });
    std::int64_t end = coordinate_at(cells.region(order[0]).high, axis);
    for (std::size_t k = 1; k < order.size(); ++k) {
      const std::size_t less = std::min(k, order.size() - k);
      if (low(order[k]) >= end && less > best_less) {
        best_less = less;
        // In the middle of the gap, where it serves both.
        const std::int64_t gap = low(order[k]) - end;
        best = CellSplit{static_cast<std::int32_t>(axis), end + gap / 2};
      }
      end = std::max(end, coordinate_at(cells.region(order[k]).high, axis));
    }
  }
  return best;
}

std::optional<FaceChoice> best_face(const Region& region, std::uint32_t used,
                                    const PrimitiveList& list,
                                    const GridPoint& origin) {
  if (list.count == 0 || used == 63u) return std::nullopt;
  std::optional<FaceChoice> best;
  double best_value = -1;
  for (std::uint32_t index = 0; index < 6; ++index) {
    if ((used >> index & 1u) != 0) continue;
    const std::size_t axis = index / 2;
    const bool is_high = index % 2 == 1;
    const std::int64_t at =
        coordinate_at(is_high ? region.high : region.low, axis);
    const auto face = static_cast<double>(at - coordinate_at(origin, axis));
    std::size_t beyond = 0;
    bool is_reached = false;
    for (const Primitive& p : list) {
      const double inner = is_high ? p.low[axis] : -double{p.high[axis]};
      const double outer = is_high ? p.high[axis] : -double{p.low[axis]};
      const double here = is_high ? face : -face;
      beyond += inner >= here ? 1 : 0;
      is_reached = is_reached || outer >= here;
    }
    const double value = static_cast<double>(beyond) + (is_reached ? 0.5 : 0.0);
    if (value <= best_value) continue;
    best_value = value;
    best = FaceChoice{index, {static_cast<std::int32_t>(axis), at}};
  }
  return best;
}

}  // namespace halfspace::fast
