#include "identities.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "forms.hpp"
#include "halfspace/fast/boolean.hpp"
#include "halfspace/fast/export.hpp"

namespace halfspace::identities {
namespace {

using fast::Face;
using fast::Solid;
using fast::SolidEdge;

/// Counting modulo a prime of less than 63 bits.
class Field {
 public:
  explicit Field(std::uint64_t prime) : prime_(prime) {}

  std::uint64_t of(Int128 value) const {
    const auto rest = static_cast<std::int64_t>(value % Int128{prime_});
    return rest < 0 ? static_cast<std::uint64_t>(rest) + prime_
                    : static_cast<std::uint64_t>(rest);
  }
  std::uint64_t add(std::uint64_t a, std::uint64_t b) const {
    return (a + b) % prime_;
  }
  std::uint64_t subtract(std::uint64_t a, std::uint64_t b) const {
    return (a + prime_ - b) % prime_;
  }
  std::uint64_t multiply(std::uint64_t a, std::uint64_t b) const {
    // Both have 62 bits.
    return static_cast<std::uint64_t>(Int128{a} * Int128{b} % Int128{prime_});
  }
  std::uint64_t inverse(std::uint64_t a) const {
    std::uint64_t power = 1;
    for (std::uint64_t rest = prime_ - 2; rest != 0; rest /= 2) {
      if (rest % 2 != 0) power = multiply(power, a);
      a = multiply(a, a);
    }
    return power;
  }

 private:
  std::uint64_t prime_;
};

using Vector = std::array<std::uint64_t, 3>;

Vector cross(const Vector& u, const Vector& v, const Field& field) {
  Vector result;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    result[k] =
        field.subtract(field.multiply(u[i], v[j]), field.multiply(u[j], v[i]));
  }
  return result;
}

std::uint64_t dot(const Vector& u, const Vector& v, const Field& field) {
  std::uint64_t sum = 0;
  for (std::size_t k = 0; k < 3; ++k)
    sum = field.add(sum, field.multiply(u[k], v[k]));
  return sum;
}

Vector vector_of(const GridPoint& p, const Field& field) {
  return {field.of(p.x), field.of(p.y), field.of(p.z)};
}

Vector point_at(const Solid& solid, std::int32_t v, const Field& field) {
  const fast::SolidVertex vertex = fast::vertex_at(solid, v);
  if (vertex.is_grid) return vector_of(vertex.point, field);
  // Cramer's rule, as for any three planes.
  std::array<Vector, 3> n;
  std::array<std::uint64_t, 3> offset;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto plane = fast::plane_at(solid, vertex.planes[i]);
    n[i] = {field.of(plane.normal[0]), field.of(plane.normal[1]),
            field.of(plane.normal[2])};
    offset[i] = dot(n[i], vector_of(plane.origin, field), field);
  }
  Vector sum{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector product = cross(n[(i + 1) % 3], n[(i + 2) % 3], field);
    for (std::size_t k = 0; k < 3; ++k)
      sum[k] = field.add(sum[k], field.multiply(offset[i], product[k]));
  }
  const std::uint64_t by =
      field.inverse(dot(n[0], cross(n[1], n[2], field), field));
  for (std::uint64_t& value : sum) value = field.multiply(value, by);
  return sum;
}

std::uint64_t volume_in(const Field& field, const Solid& solid) {
  std::map<std::int32_t, Vector> points;
  const auto point = [&](std::int32_t v) -> const Vector& {
    const auto [at, is_new] = points.try_emplace(v);
    if (is_new) at->second = point_at(solid, v, field);
    return at->second;
  };
  std::uint64_t total = 0;
  for (const Face& face : solid.faces) {
    // Triangles from a corner of the face, wherever they turn.
    const SolidEdge* edges = solid.edges.data() + face.first_edge;
    const Vector& corner = point(edges[0].from);
    for (std::uint32_t i = 0; i < face.edge_count; ++i) {
      total = field.add(
          total,
          dot(corner, cross(point(edges[i].from), point(edges[i].to), field),
              field));
    }
  }
  return total;
}

/// A face in whatever order its edges stand.
using Outline = std::tuple<std::int32_t, bool, std::int32_t, PolygonId,
                           std::vector<std::pair<std::int32_t, std::int32_t>>>;

std::vector<Outline> outlines_of(const Solid& solid) {
  std::vector<Outline> outlines;
  for (const Face& face : solid.faces) {
    Outline outline{face.plane, face.turned, face.part, face.polygon, {}};
    auto& edges = std::get<4>(outline);
    for (std::uint32_t i = 0; i < face.edge_count; ++i) {
      const SolidEdge& edge = solid.edges[face.first_edge + i];
      edges.emplace_back(edge.from, edge.to);
    }
    std::sort(edges.begin(), edges.end());
    outlines.push_back(std::move(outline));
  }
  std::sort(outlines.begin(), outlines.end());
  return outlines;
}

}  // namespace

Solid shipped(BooleanOp operation, const Solid& a, const Solid& b) {
  return fast::boolean(operation, a, b);
}

std::array<std::uint64_t, 2> volume6(const Solid& solid) {
  // 2^61 - 1 and 2^62 - 57.
  return {volume_in(Field((std::uint64_t{1} << 61) - 1), solid),
          volume_in(Field((std::uint64_t{1} << 62) - 57), solid)};
}

bool is_same_set(const Solid& a, const Solid& b) {
  return a.unbounded == b.unbounded && bounds_of(a) == bounds_of(b);
}

std::size_t count_foreign_faces(const Solid& a, const Solid& b) {
  const auto x = outlines_of(fast::merged(a, fast::Merge::kOrigin));
  const auto y = outlines_of(fast::merged(b, fast::Merge::kOrigin));
  std::vector<Outline> foreign;
  std::set_symmetric_difference(x.begin(), x.end(), y.begin(), y.end(),
                                std::back_inserter(foreign));
  return foreign.size();
}

namespace {

/// One pair of solids, and what was found.
class Pair {
 public:
  Pair(const Solid& a, const Solid& b, const Boolean& boolean)
      : a_(a), b_(b), boolean_(boolean) {}

  std::vector<std::string> broken() {
    const Solid either = made("A | B", BooleanOp::kUnion, a_, b_);
    const Solid both = made("A & B", BooleanOp::kIntersection, a_, b_);
    const Solid first = made("A - B", BooleanOp::kDifference, a_, b_);
    const Solid second = made("B - A", BooleanOp::kDifference, b_, a_);
    check_volumes(either, both, first, second);
    check_parts(either, both, first, second);
    check_complements(either, both, first);
    check_with_itself();
    return std::move(broken_);
  }

 private:
  Solid made(const std::string& name, BooleanOp operation, const Solid& x,
             const Solid& y) {
    Solid result = boolean_(operation, x, y);
    for (const std::string& fault : faults_of(result))
      broken_.push_back(name + ": " + fault);
    for (const std::string& fault :
         faults_of(fast::merged(result, fast::Merge::kPlane)))
      broken_.push_back(name + ", merged: " + fault);
    return result;
  }
  void expect(bool holds, const char* what) {
    if (!holds) broken_.push_back(what);
  }
  void expect_same(const Solid& x, const Solid& y, const char* what) {
    expect(is_same_set(x, y), what);
  }

  void check_volumes(const Solid& either, const Solid& both, const Solid& first,
                     const Solid& second) {
    const auto a = volume6(a_), b = volume6(b_), u = volume6(either),
               i = volume6(both), d = volume6(first), e = volume6(second);
    const std::array<Field, 2> fields{Field((std::uint64_t{1} << 61) - 1),
                                      Field((std::uint64_t{1} << 62) - 57)};
    for (std::size_t k = 0; k < 2; ++k) {
      const Field& f = fields[k];
      expect(f.add(a[k], b[k]) == f.add(u[k], i[k]),
             "vol A + vol B = vol A|B + vol A&B");
      expect(a[k] == f.add(d[k], i[k]), "vol A-B = vol A - vol A&B");
      expect(b[k] == f.add(e[k], i[k]), "vol B-A = vol B - vol A&B");
    }
  }

  void check_parts(const Solid& either, const Solid& both, const Solid& first,
                   const Solid& second) {
    const Solid again =
        made("(A - B) | (A & B)", BooleanOp::kUnion, first, both);
    expect_same(again, a_, "(A-B) | (A&B) = A");
    const std::size_t foreign = count_foreign_faces(again, a_);
    if (foreign != 0) {
      broken_.push_back("(A-B) | (A&B) has A's polygons: " +
                        std::to_string(foreign) + " differ");
    }
    const Solid other = fast::symmetric_difference(a_, b_);
    expect_same(other, boolean_(BooleanOp::kUnion, first, second),
                "A^B = (A-B) | (B-A)");
    expect_same(other, boolean_(BooleanOp::kDifference, either, both),
                "A^B = (A|B) - (A&B)");
    const Solid turned = boolean_(BooleanOp::kUnion, b_, a_);
    expect_same(either, turned, "A|B = B|A");
    const auto x = fast::exported(fast::merged(either, fast::Merge::kPlane));
    const auto y = fast::exported(fast::merged(turned, fast::Merge::kPlane));
    expect(x.vertices == y.vertices && x.corners == y.corners &&
               x.first_corner == y.first_corner,
           "A|B and B|A are one mesh");
  }

  void check_complements(const Solid& either, const Solid& both,
                         const Solid& first) {
    const Solid not_a = fast::complement(a_), not_b = fast::complement(b_);
    expect_same(boolean_(BooleanOp::kIntersection, not_a, not_b),
                fast::complement(either), "~(A|B) = ~A & ~B");
    expect_same(boolean_(BooleanOp::kUnion, not_a, not_b),
                fast::complement(both), "~(A&B) = ~A | ~B");
    expect_same(boolean_(BooleanOp::kIntersection, a_, not_b), first,
                "A & ~B = A-B");
    expect_same(boolean_(BooleanOp::kUnion, not_a, b_), fast::complement(first),
                "~A | B = ~(A-B)");
  }

  void check_with_itself() {
    expect_same(boolean_(BooleanOp::kUnion, a_, a_), a_, "A|A = A");
    expect_same(boolean_(BooleanOp::kIntersection, a_, a_), a_, "A&A = A");
    expect(boolean_(BooleanOp::kDifference, a_, a_).faces.empty(),
           "A-A is empty");
    expect(fast::symmetric_difference(a_, a_).faces.empty(), "A^A is empty");
  }

  const Solid& a_;
  const Solid& b_;
  const Boolean& boolean_;
  std::vector<std::string> broken_;
};

}  // namespace

std::vector<std::string> broken_identities(const Solid& a, const Solid& b,
                                           const Boolean& boolean) {
  return Pair(a, b, boolean).broken();
}

}  // namespace halfspace::identities
