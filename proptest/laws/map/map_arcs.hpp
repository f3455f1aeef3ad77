#pragma once

#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include "definition/definition.hpp"
#include "halfspace/fast/visible_map.hpp"
#include "halfspace/ref/visible_map.hpp"

/// Maps of both implementations as lists of arcs between exact points, so that
/// they can be compared.
namespace halfspace::map_arcs {

using definition::Fraction;
using definition::Integer;

struct Place {
  Fraction x, y;
  friend bool operator==(const Place&, const Place&) = default;
};
inline bool operator<(const Place& p, const Place& q) {
  return p.x == q.x ? p.y < q.y : p.x < q.x;
}

struct Arc {
  Place from, to;
  std::int32_t left, right;
  friend bool operator==(const Arc&, const Arc&) = default;
};
using Arcs = std::vector<Arc>;

inline Integer integer_of(const fast::MapLine::Integer& words) {
  Integer value = 0;
  for (std::size_t k = words.size(); k-- > 0;) value = (value << 64) + words[k];
  if (words.back() >> 63 != 0) value -= Integer(1) << 512;
  return value;
}

inline Arcs exact_arcs(const std::vector<ref::MapArc>& map) {
  const auto fraction = [](const ref::Rational& value) {
    const auto big = value.big();
    return Fraction(Integer(numerator(big).str()),
                    Integer(denominator(big).str()));
  };
  const auto place = [&](const ref::ImagePoint& p) {
    return Place{fraction(p.x), fraction(p.y)};
  };
  Arcs arcs;
  for (const ref::MapArc& arc : map)
    arcs.push_back({place(arc.from), place(arc.to), arc.left, arc.right});
  return arcs;
}

/// The vertices of a map, from the lines that meet there.
inline std::vector<Place> exact_places(const fast::VisibleMap& map) {
  std::vector<Place> places;
  for (const fast::MapVertex& vertex : map.vertices) {
    const auto line = [&](std::size_t k) -> const fast::MapLine& {
      return map.lines[static_cast<std::size_t>(vertex.lines[k])];
    };
    const auto [a, b, c] = std::tuple{
        integer_of(line(0).a), integer_of(line(0).b), integer_of(line(0).c)};
    const auto [d, e, f] = std::tuple{
        integer_of(line(1).a), integer_of(line(1).b), integer_of(line(1).c)};
    const Integer w = 2 * (a * e - b * d);
    places.push_back({Fraction(b * f - c * e) / Fraction(w),
                      Fraction(c * d - a * f) / Fraction(w)});
  }
  return places;
}

inline Arcs exact_arcs(const fast::VisibleMap& map) {
  const std::vector<Place> places = exact_places(map);
  const auto key_of = [&](std::int32_t region) {
    return region < 0 ? kOutsideKey
                      : map.regions[static_cast<std::size_t>(region)].key;
  };
  Arcs arcs;
  for (const fast::MapArc& arc : map.arcs) {
    arcs.push_back({places[static_cast<std::size_t>(arc.from)],
                    places[static_cast<std::size_t>(arc.to)], key_of(arc.left),
                    key_of(arc.right)});
  }
  return arcs;
}

/// The key at the sample of pixel (i, j): that to the right of the last arc
/// before it on its line, which is the height j + 1/2 and an infinitely small
/// step further down.
inline std::int32_t key_at(const Arcs& arcs, std::int32_t i, std::int32_t j) {
  const Fraction x = Fraction(2 * i + 1) / 2;
  const Fraction y = Fraction(2 * j + 1) / 2;
  std::int32_t key = kOutsideKey;
  std::pair<Fraction, Fraction> last;
  for (const Arc& arc : arcs) {
    const bool down = arc.from.y < arc.to.y;
    const Place& high = down ? arc.from : arc.to;
    const Place& low = down ? arc.to : arc.from;
    if (!(high.y <= y && y < low.y)) continue;
    const Fraction slope = (low.x - high.x) / (low.y - high.y);
    const std::pair<Fraction, Fraction> place = {high.x + slope * (y - high.y),
                                                 slope};
    if (place.first > x) continue;
    if (key != kOutsideKey && place < last) continue;
    last = place;
    key = down ? arc.left : arc.right;
  }
  return key;
}

}  // namespace halfspace::map_arcs
