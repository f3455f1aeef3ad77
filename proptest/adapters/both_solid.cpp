#include "adapters/both_solid.hpp"

#include <algorithm>
#include <array>
#include <map>

namespace halfspace {
namespace {

using definition::Fraction;
using definition::Integer;

/// Coordinates by axis.
using Coordinates = std::array<Fraction, 3>;

Integer integer(Int128 value) {
  const Int128 base = Int128{1} << 62;
  return Integer(static_cast<std::int64_t>(value / base)) * (Integer(1) << 62) +
         static_cast<std::int64_t>(value % base);
}

Coordinates coordinates(const GridPoint& p) { return {p.x, p.y, p.z}; }

/// Where a solid's vertex is.
Coordinates place_of(const fast::Solid& solid, std::int32_t id) {
  const fast::SolidVertex vertex = fast::vertex_at(solid, id);
  if (vertex.is_grid) return coordinates(vertex.point);
  // Three planes, each as normal . p = offset, by Cramer's rule.
  Integer m[3][4];
  for (std::size_t r = 0; r < 3; ++r) {
    const fast::SolidPlane plane = fast::plane_at(solid, vertex.planes[r]);
    for (std::size_t k = 0; k < 3; ++k) m[r][k] = integer(plane.normal[k]);
    m[r][3] = m[r][0] * plane.origin.x + m[r][1] * plane.origin.y +
              m[r][2] * plane.origin.z;
  }
  const auto determinant = [&m](std::size_t a, std::size_t b, std::size_t c) {
    return m[0][a] * (m[1][b] * m[2][c] - m[1][c] * m[2][b]) -
           m[0][b] * (m[1][a] * m[2][c] - m[1][c] * m[2][a]) +
           m[0][c] * (m[1][a] * m[2][b] - m[1][b] * m[2][a]);
  };
  // Boost 1.74 takes no negative denominators.
  const Integer w = determinant(0, 1, 2);
  const int sigma = w.sign();
  return {Fraction(sigma * determinant(3, 1, 2), sigma * w),
          Fraction(sigma * determinant(0, 3, 2), sigma * w),
          Fraction(sigma * determinant(0, 1, 3), sigma * w)};
}

/// The places of a solid's vertices, each worked out once.
class Places {
 public:
  explicit Places(const fast::Solid& solid) : solid_(solid) {}
  const Coordinates& operator[](std::int32_t id) {
    const auto [at, is_new] = places_.try_emplace(id);
    if (is_new) at->second = place_of(solid_, id);
    return at->second;
  }

 private:
  const fast::Solid& solid_;
  std::map<std::int32_t, Coordinates> places_;
};

definition::Point to_point(const Coordinates& p) {
  const auto over = [](const Fraction& f) { return denominator(f); };
  const Integer w = over(p[0]) * over(p[1]) * over(p[2]);
  const auto scaled = [&](const Fraction& f) {
    return numerator(f) * (w / over(f));
  };
  return {scaled(p[0]), scaled(p[1]), scaled(p[2]), w};
}

/// An edge of a face, from its lower end along an axis.
struct Edge {
  const Coordinates* low;
  const Coordinates* high;

  Coordinates at(const Fraction& value, std::size_t axis) const {
    const Fraction share =
        (value - (*low)[axis]) / ((*high)[axis] - (*low)[axis]);
    Coordinates p;
    for (std::size_t k = 0; k < 3; ++k)
      p[k] = (*low)[k] + share * ((*high)[k] - (*low)[k]);
    return p;
  }
};

/// A part of a strip, between two edges: three or four corners.
std::vector<definition::Point> part_between(
    const std::pair<Coordinates, Coordinates>& below,
    const std::pair<Coordinates, Coordinates>& above, bool turned) {
  std::vector<Coordinates> ring = {below.first, below.second};
  if (above.second != below.second) ring.push_back(above.second);
  if (above.first != below.first) ring.push_back(above.first);
  if (turned) std::reverse(ring.begin(), ring.end());
  std::vector<definition::Point> polygon;
  for (const Coordinates& p : ring) polygon.push_back(to_point(p));
  return polygon;
}

void add_parts(const fast::Solid& solid, const fast::Face& face, Places& places,
               std::vector<std::vector<definition::Point>>& polygons) {
  const auto normal = fast::plane_at(solid, face.plane).normal;
  std::size_t across = 0;
  while (normal[across] == 0) ++across;
  const std::size_t u = (across + 1) % 3;
  const std::size_t v = (across + 2) % 3;
  std::vector<Edge> edges;
  std::vector<Fraction> cuts;
  for (std::uint32_t k = 0; k < face.edge_count; ++k) {
    const fast::SolidEdge& edge = solid.edges[face.first_edge + k];
    const Coordinates* low = &places[edge.from];
    const Coordinates* high = &places[edge.to];
    cuts.push_back((*low)[u]);
    if ((*low)[u] == (*high)[u]) continue;
    if ((*high)[u] < (*low)[u]) std::swap(low, high);
    edges.push_back({low, high});
  }
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  for (std::size_t n = 0; n + 1 < cuts.size(); ++n) {
    // No two edges cross within the strip.
    std::vector<std::pair<Coordinates, Coordinates>> crossing;
    for (const Edge& edge : edges) {
      if ((*edge.low)[u] > cuts[n] || (*edge.high)[u] < cuts[n + 1]) continue;
      crossing.push_back({edge.at(cuts[n], u), edge.at(cuts[n + 1], u)});
    }
    std::sort(crossing.begin(), crossing.end(),
              [v](const auto& a, const auto& b) {
                return a.first[v] + a.second[v] < b.first[v] + b.second[v];
              });
    for (std::size_t k = 0; k + 1 < crossing.size(); k += 2) {
      polygons.push_back(part_between(crossing[k], crossing[k + 1],
                                      (normal[across] < 0) != face.flipped));
    }
  }
}

}  // namespace

std::vector<std::vector<definition::Point>> polygons_of(
    const fast::Solid& solid) {
  Places places(solid);
  std::vector<std::vector<definition::Point>> polygons;
  for (const fast::Face& face : solid.faces)
    add_parts(solid, face, places, polygons);
  return polygons;
}

definition::Fraction volume6_of(const fast::Solid& solid) {
  Places places(solid);
  Fraction sum = 0;
  for (const fast::Face& face : solid.faces) {
    // Any point of the face will do; in all, its triangles with the edges are
    // the face.
    const Coordinates p = places[solid.edges[face.first_edge].from];
    for (std::uint32_t k = 0; k < face.edge_count; ++k) {
      const fast::SolidEdge& edge = solid.edges[face.first_edge + k];
      const Coordinates q = places[edge.from];
      const Coordinates r = places[edge.to];
      sum += p[0] * (q[1] * r[2] - q[2] * r[1]) +
             p[1] * (q[2] * r[0] - q[0] * r[2]) +
             p[2] * (q[0] * r[1] - q[1] * r[0]);
    }
  }
  return sum;
}

}  // namespace halfspace
