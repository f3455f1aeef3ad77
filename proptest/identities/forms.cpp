#include "forms.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "box/bvh.hpp"
#include "halfspace/fast/boolean.hpp"
#include "identities.hpp"
#include "table/shared_table.hpp"

namespace halfspace::identities {
namespace {

using fast::Face;
using fast::Solid;
using fast::SolidEdge;

std::string place(const Solid& solid, std::int32_t v) {
  const fast::Vertex& at = solid.table->vertex(v).approximate;
  return " near " + std::to_string(at.x) + ", " + std::to_string(at.y) + ", " +
         std::to_string(at.z);
}

/// A face whose edges do not make loops.
void find_open_faces(const Solid& solid, std::vector<std::string>& faults) {
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    const Face& face = solid.faces[f];
    std::map<std::int32_t, int> excess;
    for (std::uint32_t i = 0; i < face.edge_count; ++i) {
      const SolidEdge& edge = solid.edges[face.first_edge + i];
      ++excess[edge.from];
      --excess[edge.to];
      if (solid.table->side(face.plane, edge.from) != 0) {
        faults.push_back("face " + std::to_string(f) + " is not flat" +
                         place(solid, edge.from));
        return;
      }
    }
    for (const auto& [v, count] : excess) {
      if (count == 0) continue;
      faults.push_back("face " + std::to_string(f) + " is open" +
                       place(solid, v));
      return;
    }
    if (face.edge_count >= 3) continue;
    faults.push_back("face " + std::to_string(f) + " has " +
                     std::to_string(face.edge_count) + " edges");
    return;
  }
}

/// A vertex that lies within an edge.
void find_vertex_in_edge(const Solid& solid, std::vector<std::string>& faults) {
  const fast::GeometryTable& table = *solid.table;
  std::set<std::int32_t> vertices;
  for (const SolidEdge& edge : solid.edges) vertices.insert(edge.from);
  const std::vector<std::int32_t> items(vertices.begin(), vertices.end());
  const fast::BoxTree tree(
      [&](std::int32_t v) {
        fast::Box box = fast::kEmptyBox;
        fast::extend(box, table.vertex(v).approximate);
        return box;
      },
      items);
  for (const Face& face : solid.faces) {
    for (std::uint32_t i = 0; i < face.edge_count; ++i) {
      const SolidEdge& edge = solid.edges[face.first_edge + i];
      fast::Box box = fast::kEmptyBox;
      fast::extend(box, table.vertex(edge.from).approximate);
      fast::extend(box, table.vertex(edge.to).approximate);
      const int axis = table.edge_axis(edge.from, edge.to);
      bool found = false;
      tree.find(box, [&](std::int32_t v) {
        if (found || v == edge.from || v == edge.to) return;
        if (table.compare(axis, v, edge.from) ==
            table.compare(axis, v, edge.to))
          return;
        for (int k = 0; k < 3; ++k) {
          if (table.turn(k, edge.from, edge.to, v) != 0) return;
        }
        found = true;
        faults.push_back("a vertex within an edge" + place(solid, v));
      });
      if (found) return;
    }
  }
}

}  // namespace

std::vector<Bound> bounds_of(const Solid& solid) {
  const Solid least = fast::merge_faces(solid, fast::Merge::kPlane);
  std::map<Bound, int> count;
  for (const Face& face : least.faces) {
    for (std::uint32_t i = 0; i < face.edge_count; ++i) {
      const SolidEdge& edge = least.edges[face.first_edge + i];
      const auto [low, high] = std::minmax(edge.from, edge.to);
      count[{face.plane, face.flipped, low, high}] += edge.from == low ? 1 : -1;
    }
  }
  std::vector<Bound> bounds;
  for (const auto& [bound, excess] : count) {
    auto [plane, turned, from, to] = bound;
    if (excess < 0) std::swap(from, to);
    for (int i = 0; i < std::abs(excess); ++i)
      bounds.emplace_back(plane, turned, from, to);
  }
  return bounds;
}

std::vector<std::string> faults_of(const Solid& solid) {
  std::vector<std::string> faults;
  const auto bad = fast::bad_edges(solid);
  if (!bad.empty()) {
    faults.push_back(std::to_string(bad.size()) + " bad edges, the first" +
                     place(solid, bad.front().from));
  }
  find_open_faces(solid, faults);
  find_vertex_in_edge(solid, faults);
  return faults;
}

}  // namespace halfspace::identities
