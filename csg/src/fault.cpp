#include "halfspace/csg/fault.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "exact/by_low_end.hpp"
#include "exact/point_ranks.hpp"

namespace halfspace::csg {
namespace {

std::string in_model_units(const GridPoint& p, const Unit& unit) {
  const double step = std::pow(static_cast<double>(unit.base),
                               static_cast<double>(unit.exponent));
  char text[96];
  std::snprintf(
      text, sizeof text, "%.9g, %.9g, %.9g", step * static_cast<double>(p.x),
      step * static_cast<double>(p.y), step * static_cast<double>(p.z));
  return text;
}

/// The use of an edge by a polygon: the ranks of its ends, the lesser first.
struct Use {
  std::uint64_t ends = 0;
  PolygonId polygon = 0;
  bool forward = false;
};

/// An edge that is bad, and the polygons that use it.
struct Bad {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  std::span<const Use> uses;
};

/// All uses, those of one edge in a row, in the order of their polygons.
std::vector<Use> uses_of(const Scene& scene, const PointRanks& ranks) {
  std::vector<Use> uses;
  uses.reserve(scene.data().corners.size());
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    const auto id = static_cast<PolygonId>(p);
    const auto corners = scene.corners(id);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const auto rank = [&](std::size_t k) -> std::uint64_t {
        return ranks
            .of_vertex[static_cast<std::size_t>(corners[k % corners.size()])];
      };
      const auto [low, high] = std::minmax({rank(i), rank(i + 1)});
      uses.push_back({low << 32 | high, id, rank(i) == low});
    }
  }
  // They are in the order of their polygons, and stay so.
  sort_by_low_end(
      uses, ranks.points.size(), [](const Use& use) { return use.ends >> 32; },
      [](const Use& a, const Use& b) { return a.ends < b.ends; });
  return uses;
}

/// The edges that are not used equally often either way, in the order of their
/// ends, as bad_edges() has them.
std::vector<Bad> bad_in(std::span<const Use> uses) {
  std::vector<Bad> bad;
  for (std::size_t i = 0; i < uses.size();) {
    std::size_t end = i;
    std::ptrdiff_t excess = 0;
    for (; end < uses.size() && uses[end].ends == uses[i].ends; ++end)
      excess += uses[end].forward ? 1 : -1;
    const auto low = static_cast<std::uint32_t>(uses[i].ends >> 32);
    const auto high = static_cast<std::uint32_t>(uses[i].ends & 0xffffffff);
    if (excess > 0) bad.push_back({low, high, uses.subspan(i, end - i)});
    if (excess < 0) bad.push_back({high, low, uses.subspan(i, end - i)});
    i = end;
  }
  return bad;
}

/// How many groups the edges fall into that have end points in common.
std::size_t places_of(std::span<const Bad> bad, std::size_t points) {
  std::vector<std::uint32_t> up(points);
  std::iota(up.begin(), up.end(), 0u);
  const auto root = [&up](std::uint32_t at) {
    while (up[at] != at) at = up[at] = up[up[at]];
    return at;
  };
  std::vector<bool> is_end(points);
  std::size_t count = 0;
  for (const Bad& edge : bad) {
    for (const std::uint32_t end : {edge.from, edge.to}) {
      if (!is_end[end]) ++count;
      is_end[end] = true;
    }
    const std::uint32_t a = root(edge.from), b = root(edge.to);
    if (a == b) continue;
    up[std::max(a, b)] = std::min(a, b);
    --count;
  }
  return count;
}

std::string counted(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

}  // namespace

Error open_error(const Scene& scene, std::span<const PolygonId> polygons) {
  const PointRanks ranks = point_ranks(scene.data().vertices);
  const std::vector<Use> uses = uses_of(scene, ranks);
  const std::vector<Bad> bad = bad_in(uses);
  const auto is_border = [](const Bad& edge) { return edge.uses.size() == 1; };
  // A surface with polygons the wrong way round may have holes beside.
  const auto border = std::find_if(bad.begin(), bad.end(), is_border);
  const bool is_open = border != bad.end();
  const Bad& first = is_open ? *border : bad.front();
  const std::size_t places = places_of(bad, ranks.points.size());
  std::vector<PolygonId> there;
  for (const bool forward : {true, false}) {
    for (const Use& use : first.uses) {
      if (use.forward == forward)
        there.push_back(polygons[static_cast<std::size_t>(use.polygon)]);
    }
  }

  std::string sentence = is_open ? "the surface is open: "
                                 : "the surface is not consistently oriented: ";
  sentence += counted(bad.size(), "bad edge") + " in " +
              counted(places, "place") + ", the first from " +
              in_model_units(ranks.points[first.from], scene.unit()) + " to " +
              in_model_units(ranks.points[first.to], scene.unit());
  if (is_open) {
    sentence += " at polygon " + std::to_string(there.front()) +
                ", which has no neighbour there; fill the " +
                (places == 1 ? "hole" : "holes");
  } else if (there.size() == 2) {
    sentence += ", along which polygons " + std::to_string(there[0]) + " and " +
                std::to_string(there[1]) +
                " run the same way; turn one of them round";
  } else {
    sentence += ", which " + counted(there.size(), "polygon") +
                " share, the first polygon " + std::to_string(there.front());
  }
  return {ErrorCode::kOpen, sentence, there.front()};
}

}  // namespace halfspace::csg
