#include "halfspace/csg/fault.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "halfspace/boolean.hpp"

namespace halfspace::csg {
namespace {

using Ends = std::pair<GridPoint, GridPoint>;  // the lesser one first

/// The polygons that use the edges, in either direction.
struct Uses {
  std::vector<PolygonId> forward, backward;
};

std::string in_model_units(const GridPoint& p, const Unit& unit) {
  const double step = std::pow(static_cast<double>(unit.base),
                               static_cast<double>(unit.exponent));
  char text[96];
  std::snprintf(
      text, sizeof text, "%.9g, %.9g, %.9g", step * static_cast<double>(p.x),
      step * static_cast<double>(p.y), step * static_cast<double>(p.z));
  return text;
}

std::map<Ends, Uses> uses_of(const Scene& scene, std::span<const BadEdge> bad) {
  std::map<Ends, Uses> uses;
  for (const BadEdge& edge : bad) uses[std::minmax(edge.from, edge.to)];
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    const auto id = static_cast<PolygonId>(p);
    const auto corners = scene.corners(id);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const GridPoint& from = scene.point(corners[i]);
      const GridPoint& to = scene.point(corners[(i + 1) % corners.size()]);
      const auto at = uses.find(std::minmax(from, to));
      if (at == uses.end()) continue;
      (from < to ? at->second.forward : at->second.backward).push_back(id);
    }
  }
  return uses;
}

/// How many groups the edges fall into that have end points in common.
std::size_t places_of(std::span<const BadEdge> bad) {
  std::map<GridPoint, std::vector<std::size_t>> at;
  for (std::size_t i = 0; i < bad.size(); ++i) {
    at[bad[i].from].push_back(i);
    at[bad[i].to].push_back(i);
  }
  std::vector<bool> is_seen(bad.size());
  std::vector<std::size_t> waiting;
  std::size_t count = 0;
  for (std::size_t i = 0; i < bad.size(); ++i) {
    if (is_seen[i]) continue;
    ++count;
    is_seen[i] = true;
    waiting.push_back(i);
    while (!waiting.empty()) {
      const BadEdge& edge = bad[waiting.back()];
      waiting.pop_back();
      for (const GridPoint& end : {edge.from, edge.to}) {
        for (const std::size_t other : at[end]) {
          if (is_seen[other]) continue;
          is_seen[other] = true;
          waiting.push_back(other);
        }
      }
    }
  }
  return count;
}

std::string counted(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

}  // namespace

Error open_error(const Scene& scene, std::span<const PolygonId> polygons) {
  const std::vector<BadEdge> bad = bad_edges(scene);
  const auto uses = uses_of(scene, bad);
  const auto in_file = [&](PolygonId p) {
    return polygons[static_cast<std::size_t>(p)];
  };
  std::size_t borders = 0;
  for (const auto& [ends, use] : uses)
    borders += use.forward.size() + use.backward.size() == 1 ? 1u : 0u;
  // A surface with polygons the wrong way round may have holes beside.
  const bool is_open = borders > 0;
  const auto shown =
      std::find_if(bad.begin(), bad.end(), [&](const BadEdge& edge) {
        const Uses& use = uses.at(std::minmax(edge.from, edge.to));
        return (use.forward.size() + use.backward.size() == 1) == is_open;
      });
  const BadEdge& first = shown == bad.end() ? bad.front() : *shown;
  const Uses& use = uses.at(std::minmax(first.from, first.to));
  std::vector<PolygonId> there = use.forward;
  there.insert(there.end(), use.backward.begin(), use.backward.end());
  for (PolygonId& p : there) p = in_file(p);

  std::string sentence = is_open ? "the surface is open: "
                                 : "the surface is not consistently oriented: ";
  sentence += counted(bad.size(), "bad edge") + " in " +
              counted(places_of(bad), "place") + ", the first from " +
              in_model_units(first.from, scene.unit()) + " to " +
              in_model_units(first.to, scene.unit());
  if (is_open) {
    sentence += " at polygon " + std::to_string(there.front()) +
                ", which has no neighbour there; fill the " +
                (places_of(bad) == 1 ? "hole" : "holes");
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
