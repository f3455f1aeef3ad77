#include "intersect/flat_stars.hpp"

#include <array>

#include "base/id_map.hpp"

namespace halfspace::fast {
namespace {

/// What is known of the triangles round a vertex: bits for axes.
struct Star {
  /// From which they are seen: in the direction of an axis, and against it.
  std::uint8_t seen_from = 0x3f;
  std::uint8_t once = 0;   ///< along which one of them passes the vertex
  std::uint8_t twice = 0;  ///< along which two do

  bool is_flat() const {
    return ((seen_from | seen_from >> 3) & once & ~twice & 0b111) != 0;
  }
};

bool is_triangle(const Face& face, const SolidEdge* e) {
  return face.edge_count == 3 && e[0].to == e[1].from && e[1].to == e[2].from &&
         e[2].to == e[0].from;
}

std::uint8_t bits_of(bool x, bool y, bool z) {
  return static_cast<std::uint8_t>(int{x} | int{y} << 1 | int{z} << 2);
}

/// From where the face is seen.
std::uint8_t sides_of(const Face& face, const GeometryTable& table) {
  // A double is 0 for 0 alone.
  const Plane& n = table.plane(face.plane).filter.plane;
  const std::uint8_t positive = bits_of(n.a > 0, n.b > 0, n.c > 0);
  const std::uint8_t negative = bits_of(n.a < 0, n.b < 0, n.c < 0);
  return static_cast<std::uint8_t>(face.flipped ? negative | positive << 3
                                                : positive | negative << 3);
}

/// By axis: whether a point comes before another one in the projection along
/// it, by the coordinate after the axis, then by the one after that.
std::uint8_t is_before(const Vertex& u, const Vertex& v) {
  const int less = bits_of(u.x < v.x, u.y < v.y, u.z < v.z);
  const int equal = bits_of(u.x == v.x, u.y == v.y, u.z == v.z);
  const int next = (less >> 1 | less << 2) & 0b111;
  const int by_next = less | (equal & next);
  return static_cast<std::uint8_t>((by_next >> 1 | by_next << 2) & 0b111);
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
  List<Star> stars(places.size());
  // Step 1: what each face says of the stars that it is in. Of each turn of a
  // row of triangles one goes, at the vertex, from points before it to those
  // after it; a triangle does so at one of its corners, or at none.
  for (const Face& face : solid.faces) {
    const SolidEdge* edges = solid.edges.data() + face.first_edge;
    if (!is_triangle(face, edges)) {
      for (std::uint32_t i = 0; i < face.edge_count; ++i) {
        stars[places(edges[i].from)].seen_from = 0;
        stars[places(edges[i].to)].seen_from = 0;
      }
      continue;
    }
    std::uint8_t sides = sides_of(face, table_);
    std::array<std::uint8_t, 3> before;
    for (std::size_t i = 0; i < 3; ++i) {
      const TableVertex& from = table_.vertex(edges[i].from);
      before[i] =
          is_before(from.approximate, table_.vertex(edges[i].to).approximate);
      if (!from.is_grid()) sides = 0;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      Star& star = stars[places(edges[i].from)];
      const int passes = ~(before[i] | before[(i + 2) % 3]) & 0b111;
      star.seen_from = static_cast<std::uint8_t>(star.seen_from & sides);
      star.twice = static_cast<std::uint8_t>(star.twice | (star.once & passes));
      star.once = static_cast<std::uint8_t>(star.once | passes);
    }
  }
  // Step 2: the triangles.
  triangles_.reserve(solid.faces.size());
  for (const Face& face : solid.faces) {
    const SolidEdge* edges = solid.edges.data() + face.first_edge;
    if (!is_triangle(face, edges)) {
      const auto none = -1 - static_cast<std::int32_t>(triangles_.size());
      triangles_.push_back(Four{none, none, none, -1});
      continue;
    }
    const auto corner = [&](std::size_t i) {
      const std::int32_t v = edges[i].from;
      return stars[places.find(v)].is_flat() ? v : ~v;
    };
    triangles_.push_back(Four{corner(0), corner(1), corner(2), face.plane});
  }
}

}  // namespace halfspace::fast
