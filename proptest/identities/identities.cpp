#include "identities.hpp"

#include <algorithm>
#include <initializer_list>
#include <tuple>
#include <utility>

#include "forms.hpp"
#include "halfspace/fast/boolean.hpp"
#include "halfspace/fast/to_mesh.hpp"
#include "volume.hpp"

namespace halfspace::identities {
namespace {

using fast::Face;
using fast::Solid;
using fast::SolidEdge;

/// A face in whatever order its edges stand.
using Outline = std::tuple<std::int32_t, bool, std::int32_t, PolygonId,
                           std::vector<std::pair<std::int32_t, std::int32_t>>>;

std::vector<Outline> outlines_of(const Solid& solid) {
  std::vector<Outline> outlines;
  for (const Face& face : solid.faces) {
    Outline outline{face.plane, face.flipped, face.part, face.polygon, {}};
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

bool is_same_set(const Solid& a, const Solid& b) {
  return a.unbounded == b.unbounded && bounds_of(a) == bounds_of(b);
}

std::size_t count_foreign_faces(const Solid& a, const Solid& b) {
  const auto x = outlines_of(fast::merge_faces(a, fast::Merge::kOrigin));
  const auto y = outlines_of(fast::merge_faces(b, fast::Merge::kOrigin));
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
         faults_of(fast::merge_faces(result, fast::Merge::kPlane)))
      broken_.push_back(name + ", merged: " + fault);
    return result;
  }
  void expect(bool holds, const char* what) {
    if (!holds) broken_.push_back(what);
  }
  void expect_same(const Solid& x, const Solid& y, const char* what) {
    expect(is_same_set(x, y), what);
  }

  /// Whether the volumes of the solids, with these factors, add up to nothing.
  void expect_nothing(
      std::initializer_list<std::pair<const Solid*, int>> solids,
      const char* what) {
    VolumeSum sum;
    for (const auto& [solid, factor] : solids) sum.add(*solid, factor);
    expect(sum.times6() == 0, what);
  }

  void check_volumes(const Solid& either, const Solid& both, const Solid& first,
                     const Solid& second) {
    expect_nothing({{&a_, 1}, {&b_, 1}, {&either, -1}, {&both, -1}},
                   "vol A + vol B = vol A|B + vol A&B");
    expect_nothing({{&a_, 1}, {&both, -1}, {&first, -1}},
                   "vol A-B = vol A - vol A&B");
    expect_nothing({{&b_, 1}, {&both, -1}, {&second, -1}},
                   "vol B-A = vol B - vol A&B");
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
    const Solid other = fast::boolean(BooleanOp::kSymmetricDifference, a_, b_);
    expect_same(other, boolean_(BooleanOp::kUnion, first, second),
                "A^B = (A-B) | (B-A)");
    expect_same(other, boolean_(BooleanOp::kDifference, either, both),
                "A^B = (A|B) - (A&B)");
    const Solid turned = boolean_(BooleanOp::kUnion, b_, a_);
    expect_same(either, turned, "A|B = B|A");
    const auto x =
        fast::to_mesh(fast::merge_faces(either, fast::Merge::kPlane));
    const auto y =
        fast::to_mesh(fast::merge_faces(turned, fast::Merge::kPlane));
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
    expect(fast::boolean(BooleanOp::kSymmetricDifference, a_, a_).faces.empty(),
           "A^A is empty");
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
