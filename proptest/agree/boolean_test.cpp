#include "halfspace/fast/boolean.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "generate/random_solids.hpp"
#include "halfspace/fast/chain.hpp"
#include "halfspace/fast/resolve.hpp"
#include "halfspace/fast/to_mesh.hpp"
#include "halfspace/ref/boolean.hpp"

/// Solids are compared by their faces' boundaries: of each face that the result
/// has parts of, the lines on which they begin or end, and from where to where.
/// That forgets how the parts were cut, and nothing else.
namespace halfspace::agree {
namespace {

using ref::Point;
using ref::Rational;

/// A line: the axis along which it runs first, how it rises along it, and
/// where it passes 0.
using Line = std::tuple<int, Point, Point>;

/// From where on how many more edges run up the line than down.
using Runs = std::map<Rational, int>;

/// By operand, face and whether it is turned over.
using Outline =
    std::map<std::tuple<bool, PolygonId, bool>, std::map<Line, Runs>>;

const Rational& coordinate(const Point& p, int axis) {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

void add_edge(const Point& p, const Point& q, std::map<Line, Runs>& lines) {
  int axis = 0;
  while (coordinate(p, axis) == coordinate(q, axis)) ++axis;
  const Rational length = coordinate(q, axis) - coordinate(p, axis);
  const Point rise{(q.x - p.x) / length, (q.y - p.y) / length,
                   (q.z - p.z) / length};
  const Rational& at = coordinate(p, axis);
  const Point start{p.x - at * rise.x, p.y - at * rise.y, p.z - at * rise.z};
  Runs& runs = lines[{axis, rise, start}];
  const auto add = [&](const Rational& from, int change) {
    int& sum = runs[from];
    sum += change;
    if (sum == 0) runs.erase(from);
  };
  add(coordinate(p, axis), 1);
  add(coordinate(q, axis), -1);
}

/// Leaves out what cancels.
Outline without_nothing(Outline outline) {
  for (auto& [face, lines] : outline)
    std::erase_if(lines, [](const auto& line) { return line.second.empty(); });
  std::erase_if(outline, [](const auto& face) { return face.second.empty(); });
  return outline;
}

Point point_of(const fast::Solid& solid, std::int32_t id) {
  const fast::SolidVertex v = fast::vertex_at(solid, id);
  if (v.is_grid) return ref::to_point(v.point);
  // Cramer's rule.
  Rational n[3][4];
  for (int i = 0; i < 3; ++i) {
    const auto p = fast::plane_at(solid, v.planes[static_cast<std::size_t>(i)]);
    for (int k = 0; k < 3; ++k)
      n[i][k] = Rational(p.normal[static_cast<std::size_t>(k)]);
    n[i][3] = n[i][0] * Rational(p.origin.x) + n[i][1] * Rational(p.origin.y) +
              n[i][2] * Rational(p.origin.z);
  }
  const auto determinant = [&](int a, int b, int c) {
    return n[0][a] * (n[1][b] * n[2][c] - n[1][c] * n[2][b]) +
           n[0][b] * (n[1][c] * n[2][a] - n[1][a] * n[2][c]) +
           n[0][c] * (n[1][a] * n[2][b] - n[1][b] * n[2][a]);
  };
  const Rational w = determinant(0, 1, 2);
  return {determinant(3, 1, 2) / w, determinant(0, 3, 2) / w,
          determinant(0, 1, 3) / w};
}

/// By ids, so that each point is worked out once.
class Points {
 public:
  explicit Points(const fast::Solid& solid) : solid_(solid) {}
  const Point& operator[](std::int32_t id) {
    const auto [at, is_new] = points_.try_emplace(id);
    if (is_new) at->second = point_of(solid_, id);
    return at->second;
  }

 private:
  const fast::Solid& solid_;
  std::map<std::int32_t, Point> points_;
};

Rational volume6(const fast::Solid& solid) {
  Points points(solid);
  Rational sum = 0;
  for (const fast::Face& face : solid.faces) {
    const Point p = points[solid.edges[face.first_edge].from];
    for (std::uint32_t i = 0; i < face.edge_count; ++i) {
      const Point& q = points[solid.edges[face.first_edge + i].from];
      const Point& r = points[solid.edges[face.first_edge + i].to];
      sum += p.x * (q.y * r.z - q.z * r.y) + p.y * (q.z * r.x - q.x * r.z) +
             p.z * (q.x * r.y - q.y * r.x);
    }
  }
  return sum;
}

/// Whether a solid's triangles are closed and hold what it holds, as far as
/// doubles tell.
bool has_right_triangles(const fast::Solid& solid) {
  const fast::ExportedMesh mesh = fast::to_mesh(solid, {.triangles = true});
  std::map<std::pair<VertexId, VertexId>, int> uses;
  double sum = 0, most = 1;
  for (std::size_t i = 0; i < mesh.corners.size(); i += 3) {
    std::array<std::array<double, 3>, 3> at;
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId from = mesh.corners[i + k];
      const VertexId to = mesh.corners[i + (k + 1) % 3];
      ++uses[{from, to}];
      --uses[{to, from}];
      at[k] = mesh.vertices[static_cast<std::size_t>(from)];
    }
    const auto& [p, q, r] = at;
    const double part = p[0] * (q[1] * r[2] - q[2] * r[1]) +
                        p[1] * (q[2] * r[0] - q[0] * r[2]) +
                        p[2] * (q[0] * r[1] - q[1] * r[0]);
    sum += part;
    most += std::abs(part);
  }
  const double expected = nearest_double(volume6(solid));
  return std::abs(sum - expected) <= 1e-9 * most &&
         std::all_of(uses.begin(), uses.end(),
                     [](const auto& use) { return use.second == 0; });
}

Outline outline_of(const fast::Solid& solid, const fast::Solid& a,
                   const fast::Solid& b) {
  Points points(solid);
  Outline outline;
  for (const fast::Face& face : solid.faces) {
    const fast::Face& source =
        (face.from_first ? a : b).faces[static_cast<std::size_t>(face.source)];
    auto& lines =
        outline[{face.from_first, face.source, face.flipped != source.flipped}];
    for (std::uint32_t i = 0; i < face.edge_count; ++i) {
      const fast::SolidEdge& edge = solid.edges[face.first_edge + i];
      const Point from = points[edge.from];
      add_edge(from, points[edge.to], lines);
    }
  }
  return without_nothing(std::move(outline));
}

bool same_direction(const ref::Plane& p, const ref::Plane& q) {
  return sign(p.a * q.a + p.b * q.b + p.c * q.c) > 0;
}

Outline outline_of(const ref::Solid& solid, const ref::Solid& a,
                   const ref::Solid& b) {
  Outline outline;
  for (const ref::Face& face : solid.faces) {
    const ref::Face& source =
        (face.from_first ? a : b).faces[static_cast<std::size_t>(face.source)];
    auto& lines = outline[{face.from_first, face.source,
                           !same_direction(face.plane, source.plane)}];
    const std::size_t count = face.vertices.size();
    for (std::size_t i = 0; i < count; ++i)
      add_edge(face.vertices[i], face.vertices[(i + 1) % count], lines);
  }
  return without_nothing(std::move(outline));
}

/// Whether the solids have one surface: every byte of their meshes is alike
/// once all that can be merged is.
bool same_surface(const fast::Solid& a, const fast::Solid& b) {
  const auto m = fast::to_mesh(fast::merge_faces(a, fast::Merge::kPlane));
  const auto n = fast::to_mesh(fast::merge_faces(b, fast::Merge::kPlane));
  return m.vertices == n.vertices && m.first_corner == n.first_corner &&
         m.corners == n.corners;
}

/// `touches`: one of them may touch itself where it has no edge.
void compare(const GridSolid& first, const GridSolid& second, bool touches) {
  const ref::Solid ref_a = ref::to_solid(first);
  const ref::Solid ref_b = ref::to_solid(second);
  const fast::Solid a = fast::to_solid(first);
  const fast::Solid b = fast::to_solid(second);
  for (const BooleanOp operation : kBooleanOps) {
    SCOPED_TRACE("operation " + std::to_string(static_cast<int>(operation)));
    const ref::Solid expected = ref::boolean(operation, ref_a, ref_b);
    const fast::Solid found = fast::boolean(operation, a, b);
    ASSERT_TRUE(fast::bad_edges(found).empty());
    ASSERT_TRUE(outline_of(found, a, b) == outline_of(expected, ref_a, ref_b));
    ASSERT_EQ(volume6(found) == ref::volume6(expected), true);
    ASSERT_TRUE(has_right_triangles(found));
    // Every vertex on an edge is a corner there, if it is in the operands.
    ASSERT_TRUE(touches || fast::resolve(found).faces_cut == 0);
    fast::Chain chain(a);
    chain.apply(operation, b);
    ASSERT_TRUE(same_surface(chain.solid(), found));
  }
}

/// The faces of one part by the polygons they come from.
Outline outline_of_part(const fast::Solid& solid, std::int32_t part) {
  Points points(solid);
  Outline outline;
  for (const fast::Face& face : solid.faces) {
    auto& lines = outline[{face.part == part, face.polygon, face.flipped}];
    for (std::uint32_t i = 0; i < face.edge_count; ++i) {
      const fast::SolidEdge& edge = solid.edges[face.first_edge + i];
      const Point from = points[edge.from];
      add_edge(from, points[edge.to], lines);
    }
  }
  return without_nothing(std::move(outline));
}

/// What holds of two solids without a reference.
/// `touches`: the first solid may touch itself where it has no edge.
void check_identities(const GridSolid& first, const GridSolid& second,
                      bool touches) {
  using enum BooleanOp;
  const fast::Solid a = fast::to_solid(first, 1);
  const fast::Solid b = fast::to_solid(second, 2);
  const fast::Solid both = fast::boolean(kIntersection, a, b);
  const fast::Solid any = fast::boolean(kUnion, a, b);
  const fast::Solid less = fast::boolean(kDifference, a, b);
  const fast::Solid one = fast::boolean(kSymmetricDifference, a, b);
  ASSERT_TRUE(volume6(any) + volume6(both) == volume6(a) + volume6(b));
  ASSERT_TRUE(volume6(one) == volume6(any) - volume6(both));
  ASSERT_TRUE(fast::bad_edges(one).empty());
  ASSERT_TRUE(same_surface(any, fast::boolean(kUnion, b, a)));
  ASSERT_TRUE(same_surface(both, fast::boolean(kIntersection, b, a)));
  // De Morgan: a less b, and a or b.
  ASSERT_TRUE(
      same_surface(less, fast::boolean(kIntersection, a, fast::complement(b))));
  ASSERT_TRUE(same_surface(
      any, fast::complement(fast::boolean(kIntersection, fast::complement(a),
                                          fast::complement(b)))));
  // What was taken apart is put together again, polygon by polygon.
  const fast::Solid again = fast::boolean(kUnion, less, both);
  ASSERT_TRUE(outline_of_part(again, 1) == outline_of_part(a, 1));
  const fast::Solid parts = fast::merge_faces(again, fast::Merge::kOrigin);
  // An edge right across a face parts it.
  ASSERT_TRUE(parts.faces.size() == a.faces.size() ||
              (touches && parts.faces.size() > a.faces.size()));
  ASSERT_TRUE(outline_of_part(parts, 1) == outline_of_part(a, 1));
}

/// The parts on either side of a plane through corners of the other solid.
/// `touches`: likewise.
void check_halves(const GridSolid& first, const GridSolid& second, bool touches,
                  Draws& draws) {
  const auto& points = second.scene().data().vertices;
  if (points.empty()) return;
  std::array<GridPoint, 3> corners;
  for (GridPoint& corner : corners) {
    corner = points[static_cast<std::size_t>(
        draws.from_to(0, static_cast<std::int64_t>(points.size()) - 1))];
  }
  const auto point = [&](std::size_t i) { return ref::to_point(corners[i]); };
  const Point u{point(1).x - point(0).x, point(1).y - point(0).y,
                point(1).z - point(0).z};
  const Point v{point(2).x - point(0).x, point(2).y - point(0).y,
                point(2).z - point(0).z};
  const Point normal{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z,
                     u.x * v.y - u.y * v.x};
  if (normal == Point{}) return;
  const fast::Solid a = fast::to_solid(first);
  const fast::Halves halves = fast::split(a, corners);
  const auto sides_are = [&](const fast::Solid& half, int side) {
    Points at(half);
    return std::all_of(half.edges.begin(), half.edges.end(),
                       [&](const auto& edge) {
                         const Point& p = at[edge.from];
                         const Rational value = normal.x * (p.x - point(0).x) +
                                                normal.y * (p.y - point(0).y) +
                                                normal.z * (p.z - point(0).z);
                         return sign(value) * side >= 0;
                       });
  };
  ASSERT_TRUE(fast::bad_edges(halves.positive).empty());
  ASSERT_TRUE(fast::bad_edges(halves.negative).empty());
  ASSERT_TRUE(sides_are(halves.positive, 1));
  ASSERT_TRUE(sides_are(halves.negative, -1));
  ASSERT_TRUE(volume6(halves.positive) + volume6(halves.negative) ==
              volume6(a));
  // The plane may have told the parts where they touch themselves.
  const auto told = [&](const fast::Solid& solid) {
    return touches ? fast::resolve(solid).solid : solid;
  };
  ASSERT_TRUE(same_surface(
      told(a), told(fast::boolean(BooleanOp::kUnion, halves.positive,
                                  halves.negative))));
}

/// How many seeds: more where the environment asks for a campaign.
std::uint64_t times(std::uint64_t seeds) {
  const char* asked = std::getenv("HALFSPACE_BOOLEAN_TIMES");
  return asked != nullptr ? seeds * std::strtoull(asked, nullptr, 10) : seeds;
}

void compare_kinds(std::uint64_t seeds, std::int64_t scale) {
  for (const SolidKind first : kSolidKinds) {
    for (const SolidKind second : kSolidKinds) {
      // Solids that may touch themselves anywhere rarely do so in a new way.
      const bool is_rare =
          first == SolidKind::kTouching || second == SolidKind::kTouching;
      const std::uint64_t last = times(is_rare ? 3 * seeds : seeds);
      for (std::uint64_t seed = 1; seed <= last; ++seed) {
        SCOPED_TRACE(std::to_string(static_cast<int>(first)) + " and " +
                     std::to_string(static_cast<int>(second)) + ", seed " +
                     std::to_string(seed));
        Draws draws(seed);
        const GridSolid a = random_solid(first, scale, draws);
        const GridSolid b = random_solid(second, scale, draws);
        const bool touches = first == SolidKind::kTouching;
        check_identities(a, b, touches);
        check_halves(a, b, touches, draws);
        compare(a, b, touches || second == SolidKind::kTouching);
        if (::testing::Test::HasFatalFailure()) return;
      }
    }
  }
}

TEST(AgreeBoolean, SmallSolids) { compare_kinds(4, 1); }
TEST(AgreeBoolean, SolidsOnTheGridOf40Bits) {
  compare_kinds(2, std::int64_t{1} << 34);
}
TEST(AgreeBoolean, SolidsOnTheGridOf54Bits) {
  compare_kinds(2, (std::int64_t{1} << 48) + 1);
}

}  // namespace
}  // namespace halfspace::agree
