#include "intersect/flat_stars.hpp"

#include <array>

#include "base/id_map.hpp"

namespace halfspace::fast {
namespace {

bool is_triangle(const Face& face, const SolidEdge* e) {
  return face.edge_count == 3 && e[0].to == e[1].from && e[1].to == e[2].from &&
         e[2].to == e[0].from;
}

/// From where the face is seen.
std::uint8_t sides_of(const Face& face, const GeometryTable& table) {
  // A double is 0 for 0 alone.
  const Plane& n = table.plane(face.plane).filter.plane;
  const std::uint8_t positive = axis_bits(n.a > 0, n.b > 0, n.c > 0);
  const std::uint8_t negative = axis_bits(n.a < 0, n.b < 0, n.c < 0);
  return face.flipped ? seen_sides(negative, positive)
                      : seen_sides(positive, negative);
}

}  // namespace

FlatStars::FlatStars(const Solid& solid, bool is_closed)
    : table_(*solid.table) {
  if (!kHasFlatStars || !is_closed || solid.edges.empty()) return;
  IdRange extent;
  for (const SolidEdge& edge : solid.edges) {
    extent.add(edge.from);
    extent.add(edge.to);
  }
  IdMap places(extent);
  List<FlatStar> stars(places.size());
  // Step 1: what each face says of the stars that it is in. Of each turn of a
  // row of triangles one goes, at the vertex, from points before it to those
  // after it; a triangle does so at one of its corners, or at none.
  for (const Face& face : solid.faces) {
    const SolidEdge* edges = solid.edges.data() + face.first_edge;
    if (!is_triangle(face, edges)) {
      for (std::uint32_t i = 0; i < face.edge_count; ++i) {
        stars[places(edges[i].from)].spoil();
        stars[places(edges[i].to)].spoil();
      }
      continue;
    }
    std::uint8_t sides = sides_of(face, table_);
    std::array<std::uint8_t, 3> before;
    for (std::size_t i = 0; i < 3; ++i) {
      const TableVertex& from = table_.vertex(edges[i].from);
      before[i] =
          axes_before(from.approximate, table_.vertex(edges[i].to).approximate);
      if (!from.is_grid()) sides = 0;
    }
    for (std::size_t i = 0; i < 3; ++i)
      stars[places(edges[i].from)].add(sides, before[i], before[(i + 2) % 3]);
  }
  // Step 2: the triangles.
  triangles_.reserve(solid.faces.size());
  for (const Face& face : solid.faces) {
    const SolidEdge* edges = solid.edges.data() + face.first_edge;
    if (!is_triangle(face, edges)) {
      const auto none = -1 - static_cast<std::int32_t>(triangles_.size());
      triangles_.push_back(StarCorners{none, none, none, -1});
      continue;
    }
    const auto corner = [&](std::size_t i) {
      const std::int32_t v = edges[i].from;
      return stars[places.find(v)].is_flat() ? v : ~v;
    };
    triangles_.push_back(
        StarCorners{corner(0), corner(1), corner(2), face.plane});
  }
}

}  // namespace halfspace::fast
