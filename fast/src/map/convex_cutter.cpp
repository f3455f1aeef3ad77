#include "map/convex_cutter.hpp"

namespace halfspace::fast {

std::vector<CellEdge> ConvexCutter::rectangle() const {
  const auto side = [&](LineId line, LineId before, std::int32_t inside,
                        CellNodeId node) {
    return CellEdge{line, inside, node, lines_.point(before, line)};
  };
  return {side(kTopSide, kLeftSide, 1, -3), side(kRightSide, kTopSide, -1, -2),
          side(kBottomSide, kRightSide, -1, -1),
          side(kLeftSide, kBottomSide, 1, -4)};
}

int ConvexCutter::classify(std::span<const CellEdge> polygon, LineId line) {
  signs_.resize(polygon.size());
  int found = 0;
  LineId before = polygon.back().line;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const CellEdge& edge = polygon[k];
    const int side = lines_.side_of(line, before, edge.line, edge.start);
    signs_[k] = static_cast<std::int8_t>(side);
    found |= side < 0 ? kSomeNegative : side > 0 ? kSomePositive : 0;
    before = edge.line;
  }
  return found;
}

void ConvexCutter::cut(std::span<const CellEdge> polygon, LineId line,
                       CellNodeId node, std::vector<CellEdge>& positive,
                       std::vector<CellEdge>& negative) const {
  const std::size_t n = polygon.size();
  for (std::size_t k = 0; k < n; ++k) {
    const CellEdge& edge = polygon[k];
    const int here = signs_[k];
    const int next = signs_[k + 1 == n ? 0 : k + 1];
    auto& own = here > 0 || (here == 0 && next > 0) ? positive : negative;
    if (here == 0) {
      // The new edge of the side that is left begins here.
      auto& other = next > 0 ? negative : positive;
      other.push_back({line, next > 0 ? -1 : 1, node, edge.start});
      own.push_back(edge);
      continue;
    }
    own.push_back(edge);
    if (here * next < 0) {
      const MapPoint point = lines_.point(edge.line, line);
      auto& other = here > 0 ? negative : positive;
      own.push_back({line, here, node, point});
      CellEdge rest = edge;
      rest.start = point;
      other.push_back(rest);
    }
  }
}

bool ConvexCutter::clip(std::vector<CellEdge>& polygon, const HalfPlane& side,
                        CellNodeId node) {
  const int found = classify(polygon, side.line);
  const int inside = side.side > 0 ? kSomePositive : kSomeNegative;
  if ((found & inside) == 0) return false;
  if (found == inside) return true;
  positive_.clear();
  negative_.clear();
  cut(polygon, side.line, node, positive_, negative_);
  polygon.swap(side.side > 0 ? positive_ : negative_);
  return true;
}

}  // namespace halfspace::fast
