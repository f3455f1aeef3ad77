#include "map/exact_moments.hpp"

#include <algorithm>
#include <vector>

namespace halfspace::fast {

ExactPoint point_of(const VisibleMap& map, std::int32_t v) {
  const MapVertex& vertex = map.vertices[static_cast<std::size_t>(v)];
  const MapLine& l = map.lines[static_cast<std::size_t>(vertex.lines[0])];
  const MapLine& m = map.lines[static_cast<std::size_t>(vertex.lines[1])];
  const auto minor = [](const auto& p, const auto& q, const auto& r,
                        const auto& s) -> BigInteger {
    return to_big_integer(p) * to_big_integer(q) -
           to_big_integer(r) * to_big_integer(s);
  };
  const BigInteger twice = 2 * minor(l.a, m.b, l.b, m.a);
  return {quotient_of(minor(l.b, m.c, l.c, m.b), twice),
          quotient_of(minor(l.c, m.a, l.a, m.c), twice)};
}

namespace {

/// The integrals of 1, x and y between an arc and the pixel's right side, in
/// the pixel's rows; the arc goes down from `from` to `to`, both from the
/// pixel's left top corner.
ExactMoments right_of(const ExactPoint& from, const ExactPoint& to) {
  const auto unit = [](const BigRational& value) {
    return std::clamp(value, BigRational(0), BigRational(1));
  };
  const BigRational slope = (to.x - from.x) / (to.y - from.y);
  const auto x_at = [&](const BigRational& y) -> BigRational {
    return unit(from.x + slope * (y - from.y));
  };
  std::vector<BigRational> cuts = {unit(from.y), unit(to.y)};
  if (slope != 0) {
    for (const int x : {0, 1}) {
      const BigRational y = from.y + (x - from.x) / slope;
      if (cuts[0] < y && y < cuts[1]) cuts.push_back(y);
    }
  }
  std::sort(cuts.begin(), cuts.end());
  ExactMoments sum;
  for (std::size_t k = 1; k < cuts.size(); ++k) {
    // As cut_row() has them: p and q are distances to the right side.
    const BigRational& y = cuts[k - 1];
    const BigRational& to_y = cuts[k];
    const BigRational dy = to_y - y;
    const BigRational p = 1 - x_at(y);
    const BigRational q = 1 - x_at(to_y);
    const BigRational area = dy * (p + q) / 2;
    sum.area += area;
    sum.x += area - dy * (p * p + p * q + q * q) / 6;
    sum.y += dy * (y * (2 * p + q) + to_y * (p + 2 * q)) / 6;
  }
  return sum;
}

/// What arcs that are left of the pixel add for a key: as often as it gains the
/// height above each of their ends, whose parts at most vertices cancel out.
using HeightCounts = std::map<std::int32_t, int>;  ///< by vertex

constexpr std::int32_t kRowTop = -1;
constexpr std::int32_t kRowBottom = -2;

void add_heights(const VisibleMap& map, const HeightCounts& counts,
                 std::int32_t row, ExactMoments& sum) {
  for (const auto& [vertex, count] : counts) {
    if (count == 0 || vertex == kRowTop) continue;
    const BigRational y = vertex == kRowBottom
                              ? BigRational(1)
                              : BigRational(point_of(map, vertex).y - row);
    sum.area += count * y;
    sum.x += count * y / 2;
    sum.y += count * y * y / 2;
  }
}

}  // namespace

std::map<std::int32_t, ExactMoments> exact_moments(const VisibleMap& map,
                                                   std::int32_t column,
                                                   std::int32_t row) {
  const auto key_of = [&](std::int32_t region) {
    return region < 0 ? kOutsideKey
                      : map.regions[static_cast<std::size_t>(region)].key;
  };
  std::map<std::int32_t, ExactMoments> moments;
  std::map<std::int32_t, HeightCounts> heights;
  for (const MapArc& arc : map.arcs) {
    const bool down = map.vertices[static_cast<std::size_t>(arc.from)].y <
                      map.vertices[static_cast<std::size_t>(arc.to)].y;
    const std::int32_t from = down ? arc.from : arc.to;
    const std::int32_t to = down ? arc.to : arc.from;
    const std::int32_t gains = key_of(down ? arc.left : arc.right);
    const std::int32_t loses = key_of(down ? arc.right : arc.left);
    const MapVertex& p = map.vertices[static_cast<std::size_t>(from)];
    const MapVertex& q = map.vertices[static_cast<std::size_t>(to)];
    // Nearest doubles are on the side of an integer that the number is on, or
    // on the integer.
    if (q.y < row || p.y > row + 1 || std::min(p.x, q.x) > column + 1) continue;
    if (std::max(p.x, q.x) < column && p.y != row && p.y != row + 1 &&
        q.y != row && q.y != row + 1) {
      const std::int32_t top = p.y < row ? kRowTop : from;
      const std::int32_t bottom = q.y > row + 1 ? kRowBottom : to;
      ++heights[gains][bottom];
      --heights[gains][top];
      --heights[loses][bottom];
      ++heights[loses][top];
      continue;
    }
    ExactPoint f = point_of(map, from);
    ExactPoint g = point_of(map, to);
    // Both keys are in the pixel, or at it, though a level arc adds nothing.
    moments[gains];
    moments[loses];
    if (f.y == g.y) continue;
    // Their doubles may be equal.
    const bool turned = f.y > g.y;
    if (turned) std::swap(f, g);
    for (ExactPoint* end : {&f, &g}) {
      end->x -= column;
      end->y -= row;
    }
    const ExactMoments part = right_of(f, g);
    for (const std::int32_t key : {gains, loses}) {
      const int count = (key == gains) != turned ? 1 : -1;
      ExactMoments& sum = moments[key];
      sum.area += count * part.area;
      sum.x += count * part.x;
      sum.y += count * part.y;
    }
  }
  for (auto& [key, sum] : moments) add_heights(map, heights[key], row, sum);
  moments.erase(kOutsideKey);
  return moments;
}

}  // namespace halfspace::fast
