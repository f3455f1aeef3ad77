#include "halfspace/shadow/boolean.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

#include "halfspace/ref/predicate.hpp"
#include "halfspace/splitmix.hpp"

namespace halfspace::shadow {
namespace {

using ref::Point;
using ref::Rational;

/// A solid in rationals. Points are computed on demand.
class Exact {
 public:
  explicit Exact(const fast::Solid& solid) : solid_(solid) {}

  const fast::Solid& solid() const { return solid_; }
  const Point& point(std::int32_t id) {
    const auto [at, is_new] = points_.try_emplace(id);
    if (is_new) at->second = computed(fast::vertex_at(solid_, id));
    return at->second;
  }

  /// The winding number of the point (JKS13); nothing if it is on the surface,
  /// or if the ray from it along the first axis meets an edge.
  std::optional<int> winding(const Point& p,
                             const std::array<double, 3>& near) {
    int winding = solid_.unbounded ? 1 : 0;
    for (const fast::Face& face : solid_.faces) {
      if (is_aside(face.box, near)) continue;
      const fast::SolidPlane plane = fast::plane_at(solid_, face.plane);
      const Rational a(plane.normal[0]);
      const Rational value =
          a * (p.x - Rational(plane.origin.x)) +
          Rational(plane.normal[1]) * (p.y - Rational(plane.origin.y)) +
          Rational(plane.normal[2]) * (p.z - Rational(plane.origin.z));
      if (sign(a) == 0) continue;  // parallel to the ray
      const std::optional<bool> covers = is_over(face, p);
      if (!covers || (*covers && sign(value) == 0)) return {};
      if (!*covers || sign(value) * sign(a) > 0) continue;
      winding += (sign(a) > 0) != face.flipped ? 1 : -1;
    }
    return winding;
  }

 private:
  /// Whether the ray along the first axis certainly misses the box. The doubles
  /// of a point have errors below 2^-40 of their size.
  static bool is_aside(const fast::Box& box, const std::array<double, 3>& p) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double doubt = std::abs(p[k]) * 0x1p-40 + 0x1p-40;
      if (p[k] - doubt > double{box.high[k]}) return true;
      if (k > 0 && p[k] + doubt < double{box.low[k]}) return true;
    }
    return false;
  }

  Point computed(const fast::SolidVertex& v) const {
    if (v.is_grid) return ref::to_point(v.point);
    // Cramer's rule.
    Rational n[3][4];
    for (std::size_t i = 0; i < 3; ++i) {
      const auto p = fast::plane_at(solid_, v.planes[i]);
      for (std::size_t k = 0; k < 3; ++k) n[i][k] = Rational(p.normal[k]);
      n[i][3] = n[i][0] * Rational(p.origin.x) +
                n[i][1] * Rational(p.origin.y) + n[i][2] * Rational(p.origin.z);
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

  /// Whether the face holds the point in the projection along the first axis;
  /// nothing if the point is on an edge, or level with a vertex.
  std::optional<bool> is_over(const fast::Face& face, const Point& p) {
    bool inside = false;
    for (std::uint32_t i = 0; i < face.edge_count; ++i) {
      const fast::SolidEdge& edge = solid_.edges[face.first_edge + i];
      const Point& u = point(edge.from);
      const Point& v = point(edge.to);
      const int from = sign(u.y - p.y);
      const int to = sign(v.y - p.y);
      if (from == 0 || to == 0) return {};
      if (from == to) continue;
      const int turn =
          sign((v.y - u.y) * (p.z - u.z) - (v.z - u.z) * (p.y - u.y));
      if (turn == 0) return {};
      if ((turn > 0) == (to > 0)) inside = !inside;
    }
    return inside;
  }

  const fast::Solid& solid_;
  std::map<std::int32_t, Point> points_;
};

/// Random numbers of one operation's check.
class Stream {
 public:
  explicit Stream(std::uint64_t seed) : generator_(mix(seed) + kSplitMixStep) {}
  std::int64_t below(std::size_t count) {
    return static_cast<std::int64_t>(generator_.next() % count);
  }

 private:
  SplitMix64 generator_;
};

/// A point near a face: the centroid of three of its vertices, moved by between
/// 2^-24 of the face's size and all of it. The odd denominator keeps rays off
/// edges.
Point point_near(Exact& exact, Stream& stream) {
  const fast::Solid& solid = exact.solid();
  const auto f = static_cast<std::size_t>(stream.below(solid.faces.size()));
  const fast::Face& face = solid.faces[f];
  const auto corner = [&]() -> const Point& {
    const auto at = static_cast<std::uint32_t>(stream.below(face.edge_count));
    return exact.point(solid.edges[face.first_edge + at].from);
  };
  const Point u = corner(), v = corner(), w = corner();
  constexpr std::int64_t kDenominator = 1000003;
  double size = 1;
  for (std::size_t k = 0; k < 3; ++k)
    size = std::max(size, double{face.box.high[k]} - double{face.box.low[k]});
  const std::int64_t fall = std::int64_t{1} << stream.below(25);
  const auto off = [&] {
    return Rational(stream.below(2 * kDenominator) - kDenominator) *
           Rational(static_cast<std::int64_t>(std::min(size, 0x1p54))) /
           (Rational(kDenominator) * Rational(fall));
  };
  const Rational three(3);
  return {(u.x + v.x + w.x) / three + off(), (u.y + v.y + w.y) / three + off(),
          (u.z + v.z + w.z) / three + off()};
}

std::string text_of(const Rational& value) { return value.big().str(); }

const char* name_of(BooleanOp operation) {
  switch (operation) {
    case BooleanOp::kUnion:
      return "union";
    case BooleanOp::kIntersection:
      return "intersection";
    case BooleanOp::kDifference:
      return "difference";
    case BooleanOp::kSymmetricDifference:
      break;
  }
  return "symmetric difference";
}

/// Writes the solid, one face a line: the vertices of each edge, as fractions.
void describe(Exact& exact, std::ostream& out) {
  const fast::Solid& solid = exact.solid();
  out << "solid " << solid.faces.size()
      << (solid.unbounded ? " unbounded\n" : "\n");
  for (const fast::Face& face : solid.faces) {
    out << "face";
    for (std::uint32_t i = 0; i < face.edge_count; ++i) {
      const fast::SolidEdge& edge = solid.edges[face.first_edge + i];
      for (const std::int32_t v : {edge.from, edge.to}) {
        const Point& p = exact.point(v);
        out << ' ' << text_of(p.x) << ',' << text_of(p.y) << ','
            << text_of(p.z);
      }
    }
    out << '\n';
  }
}

}  // namespace

void check(BooleanOp operation, const fast::Solid& a, const fast::Solid& b,
           const fast::Solid& result, const BooleanOptions& how,
           BooleanReport& report) {
  ++report.checked;
  std::array<Exact, 3> solids{Exact(a), Exact(b), Exact(result)};
  Stream stream(how.seed + 0x2545f4914f6cdd1du * report.operations);
  for (std::size_t n = 0; n < how.points; ++n) {
    Exact& of = solids[n % 3];
    if (of.solid().faces.empty()) continue;
    const Point p = point_near(of, stream);
    const std::array<double, 3> near{nearest_double(p.x), nearest_double(p.y),
                                     nearest_double(p.z)};
    std::array<std::optional<int>, 3> in;
    for (std::size_t s = 0; s < 3; ++s) in[s] = solids[s].winding(p, near);
    if (!in[0] || !in[1] || !in[2]) continue;
    ++report.points;
    const bool are_solids = std::all_of(
        in.begin(), in.end(), [](const auto& w) { return *w == 0 || *w == 1; });
    if (are_solids &&
        (*in[2] == 1) == is_member(operation, *in[0] == 1, *in[1] == 1))
      continue;
    ++report.mismatches;
    if (report.first.size() >= how.kept) continue;
    std::ostringstream text;
    text << name_of(operation) << '\n';
    describe(solids[0], text);
    describe(solids[1], text);
    report.first.push_back({report.operations,
                            {text_of(p.x), text_of(p.y), text_of(p.z)},
                            {*in[0], *in[1], *in[2]},
                            text.str()});
  }
}

namespace {

/// Whether the next operation is checked: one in each group of 1/share, which
/// the seed chooses.
bool is_chosen(const BooleanOptions& how, const BooleanReport& report) {
  const auto group = static_cast<std::uint64_t>(
      std::max(1.0, std::round(1 / std::clamp(how.share, 1e-9, 1.0))));
  const std::uint64_t chosen =
      mix(how.seed + report.operations / group) % group;
  return report.operations % group == chosen;
}

}  // namespace

fast::Solid boolean(BooleanOp operation, const fast::Solid& a,
                    const fast::Solid& b, const BooleanOptions& how,
                    BooleanReport& report) {
  fast::Solid result = fast::boolean(operation, a, b, how.threads);
  if (is_chosen(how, report)) check(operation, a, b, result, how, report);
  ++report.operations;
  return result;
}

std::string to_string(const PointMismatch& mismatch) {
  const auto where = [&](std::size_t s, const char* name) {
    const int winding = mismatch.windings[s];
    return winding == 0   ? std::string("outside ") + name
           : winding == 1 ? std::string("inside ") + name
                          : std::string("with winding number ") +
                                std::to_string(winding) + " in " + name;
  };
  return "operation " + std::to_string(mismatch.operation) + ": (" +
         mismatch.point[0] + ", " + mismatch.point[1] + ", " +
         mismatch.point[2] + ") is " + where(0, "the first operand") + ", " +
         where(1, "the second") + " and " + where(2, "the result");
}

}  // namespace halfspace::shadow
