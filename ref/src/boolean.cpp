#include "halfspace/ref/boolean.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "halfspace/assert.hpp"

namespace halfspace::ref {
namespace {

/// Turns the face over.
void flip(Face& face) {
  face.plane = {-face.plane.a, -face.plane.b, -face.plane.c, -face.plane.d};
  std::reverse(face.vertices.begin(), face.vertices.end());
}

/// Adds what the boolean takes of one operand, whose other operand's tree is
/// `tree`, to the result.
void take(BooleanOp operation, const Solid& operand, bool first_operand,
          const BspTree& tree, Solid& result) {
  for (std::size_t f = 0; f < operand.faces.size(); ++f) {
    const auto id = static_cast<PolygonId>(f);
    const Face& face = operand.faces[f];
    for (Classified& part : classify(tree, whole(operand, id), face.plane)) {
      const Keep what = keep(operation, part.solid_class, first_operand);
      if (what == Keep::kDrop) continue;
      result.faces.push_back({face.plane, std::move(part.fragment.vertices),
                              face.color, first_operand, id});
      if (what == Keep::kFlip) flip(result.faces.back());
    }
  }
}

/// The vertices of the faces, each once, in order.
std::vector<Point> vertices_of(const Solid& solid) {
  std::vector<Point> vertices;
  for (const Face& face : solid.faces) {
    vertices.insert(vertices.end(), face.vertices.begin(), face.vertices.end());
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

/// Whether `r` is on the line through `p` and `q`.
bool is_on_line(const Point& r, const Point& p, const Point& q) {
  // Seen along each axis.
  const auto is_on = [&](Rational Point::*a, Rational Point::*b) {
    return (q.*a - p.*a) * (r.*b - p.*b) == (q.*b - p.*b) * (r.*a - p.*a);
  };
  return is_on(&Point::x, &Point::y) && is_on(&Point::y, &Point::z) &&
         is_on(&Point::z, &Point::x);
}

/// Those of `vertices`, which are in order, that lie strictly between `p` and
/// `q` on the edge, in the direction from `p` to `q`.
std::vector<Point> inside_edge(const std::vector<Point>& vertices,
                               const Point& p, const Point& q) {
  // Along a line the order of points is that of their coordinates.
  const bool ascends = p < q;
  const auto first =
      std::upper_bound(vertices.begin(), vertices.end(), ascends ? p : q);
  const auto last = std::lower_bound(first, vertices.end(), ascends ? q : p);
  std::vector<Point> found;
  for (auto it = first; it != last; ++it) {
    if (is_on_line(*it, p, q)) found.push_back(*it);
  }
  if (!ascends) std::reverse(found.begin(), found.end());
  return found;
}

/// One grid step in model units (S1.1).
Rational step_of(Unit unit) {
  Rational step = 1;
  for (int i = 0; i < unit.exponent; ++i) step *= unit.base;
  for (int i = unit.exponent; i < 0; ++i) step = step / unit.base;
  return step;
}

}  // namespace

Keep keep(BooleanOp operation, SolidClass solid_class, bool first_operand) {
  constexpr Keep X = Keep::kKeep;
  constexpr Keep F = Keep::kFlip;
  constexpr Keep o = Keep::kDrop;
  struct Row {
    Keep and_a, and_b, or_a, or_b, minus_a, minus_b, xor_a, xor_b;
  };
  // clang-format off
  constexpr Row kTable[] = {
      // AND   OR    A - B XOR
      // A  B  A  B  A  B  A  B
        {X, X, o, o, o, F, F, F},  // SolidClass::kInside
        {o, o, X, X, X, o, X, X},  // SolidClass::kOutside
        {X, o, X, o, o, o, o, o},  // SolidClass::kSame
        {o, o, o, o, X, o, o, o},  // SolidClass::kOpposite
  };
  // clang-format on
  const Row& row = kTable[static_cast<std::size_t>(solid_class)];
  switch (operation) {
    case BooleanOp::kIntersection:
      return first_operand ? row.and_a : row.and_b;
    case BooleanOp::kUnion:
      return first_operand ? row.or_a : row.or_b;
    case BooleanOp::kDifference:
      return first_operand ? row.minus_a : row.minus_b;
    case BooleanOp::kSymmetricDifference:
      return first_operand ? row.xor_a : row.xor_b;
  }
  HALFSPACE_ASSERT(false && "an operation of S6.4");
  return o;
}

void close_junctions(Solid& solid) {
  const std::vector<Point> vertices = vertices_of(solid);
  for (Face& face : solid.faces) {
    std::vector<Point> corners;
    const std::size_t count = face.vertices.size();
    for (std::size_t i = 0; i < count; ++i) {
      const Point& p = face.vertices[i];
      const Point& q = face.vertices[(i + 1) % count];
      corners.push_back(p);
      for (Point& point : inside_edge(vertices, p, q)) {
        corners.push_back(std::move(point));
      }
    }
    face.vertices = std::move(corners);
  }
}

Solid boolean(BooleanOp operation, const Solid& a, const Solid& b,
              const BuildOptions& options) {
  Solid result;
  // Step 1: push the faces of each operand down the other's tree, and take what
  // the table says.
  take(operation, a, /*first_operand=*/true, build(b, options), result);
  take(operation, b, /*first_operand=*/false, build(a, options), result);
  // Step 2: where cuts ended in mid-edge, make them meet.
  close_junctions(result);
  return result;
}

std::vector<BadEdge> bad_edges(const Solid& solid) {
  // Uses from the lesser end to the greater one count up, the others down.
  std::map<std::pair<Point, Point>, std::int64_t> balance;
  for (const Face& face : solid.faces) {
    const std::size_t count = face.vertices.size();
    for (std::size_t i = 0; i < count; ++i) {
      const Point& from = face.vertices[i];
      const Point& to = face.vertices[(i + 1) % count];
      if (from < to) {
        ++balance[{from, to}];
      } else {
        --balance[{to, from}];
      }
    }
  }
  std::vector<BadEdge> bad;
  for (const auto& [ends, excess] : balance) {
    if (excess > 0) bad.push_back({ends.first, ends.second, excess});
    if (excess < 0) bad.push_back({ends.second, ends.first, -excess});
  }
  return bad;
}

Rational volume6(const Solid& solid) {
  // The tetrahedra from the origin to the triangles of each face's fan.
  Rational sum = 0;
  for (const Face& face : solid.faces) {
    const Point& p = face.vertices[0];
    for (std::size_t i = 2; i < face.vertices.size(); ++i) {
      const Point& q = face.vertices[i - 1];
      const Point& r = face.vertices[i];
      sum += p.x * (q.y * r.z - q.z * r.y) + p.y * (q.z * r.x - q.x * r.z) +
             p.z * (q.x * r.y - q.y * r.x);
    }
  }
  return sum;
}

RoundedSolid rounded(const Solid& solid, Unit unit) {
  const Rational step = step_of(unit);
  RoundedSolid result;
  Rational max_move = 0;
  const auto round = [&](const Rational& coordinate) {
    const Rational exact = coordinate * step;
    const double nearest = nearest_double(exact);
    if (std::isinf(nearest)) {
      ++result.moved;
      result.max_move = std::abs(nearest);
      return nearest;
    }
    const Rational move = exact - Rational(BigRational(nearest));
    if (sign(move) != 0) ++result.moved;
    max_move = std::max({max_move, move, -move});
    return nearest;
  };

  std::map<Point, VertexId> ids;
  for (const Face& face : solid.faces) {
    for (const Point& p : face.vertices) {
      const auto next = static_cast<VertexId>(result.vertices.size());
      const auto [place, is_new] = ids.try_emplace(p, next);
      if (is_new)
        result.vertices.push_back({round(p.x), round(p.y), round(p.z)});
      result.corners.push_back(place->second);
    }
    result.first_corner.push_back(
        static_cast<std::uint32_t>(result.corners.size()));
    result.colors.push_back(face.color);
  }
  if (!std::isinf(result.max_move)) result.max_move = nearest_double(max_move);
  return result;
}

}  // namespace halfspace::ref
