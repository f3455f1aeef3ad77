#include <algorithm>
#include <array>
#include <functional>

#include "both.hpp"
#include "definition.hpp"
#include "law.hpp"
#include "scenes.hpp"

namespace halfspace {
namespace {

using definition::Facet;
using definition::Fraction;
using definition::Integer;
using definition::Plane;
using definition::Point;
using enum BooleanOp;

template <class Impl>
class S6Boolean : public ::testing::Test {};
TYPED_TEST_SUITE(S6Boolean, Implementations);

constexpr int kPairs = 400;
constexpr BooleanOp kOperations[] = {kUnion, kIntersection, kDifference};

std::vector<Facet> facets_of(const std::vector<std::vector<Point>>& polygons) {
  std::vector<Facet> facets;
  for (const auto& polygon : polygons)
    facets.push_back(definition::facet_of(polygon));
  return facets;
}

template <class Impl>
std::vector<Facet> facets_of(const typename Impl::Solid& solid) {
  return facets_of(Impl::polygons_of(solid));
}

/// How two solids may lie against each other.
const std::set<std::string> kSituations = {
    "a polygon of the first spans the second's planes",
    "flush faces",
    "faces that touch from both sides",
    "a vertex in the other's interior",
    "a vertex in the other's exterior",
    "an empty operand",
    "more than one piece or a hollow"};

/// Those of the situations that hold.
void meet_situations(const generate::SolidPair& pair, law::Cases& cases) {
  const Scene& a = pair.a.scene();
  const Scene& b = pair.b.scene();
  const auto whole = [](const Scene& scene, PolygonId id) {
    return definition::points_of(scene, definition::whole(scene, id));
  };
  std::vector<Facet> inside_b;
  for (const PolygonId q : ids_of(b))
    inside_b.push_back(definition::facet_of(whole(b, q)));
  if (a.polygon_count() == 0 || b.polygon_count() == 0)
    cases.meet("an empty operand");
  if (a.polygon_count() > 20) cases.meet("more than one piece or a hollow");
  for (const PolygonId p : ids_of(a)) {
    const Plane n = definition::plane_of(a, p);
    const auto points = whole(a, p);
    for (const PolygonId q : ids_of(b)) {
      const Plane m = definition::plane_of(b, q);
      const Relation relation = definition::relation(points, m);
      if (relation == Relation::kSpanning)
        cases.meet("a polygon of the first spans the second's planes");
      if (relation != Relation::kCoincident) continue;
      const Integer agree = n.a * m.a + n.b * m.b + n.c * m.c;
      cases.meet(agree > 0 ? "flush faces"
                           : "faces that touch from both sides");
    }
    for (const Point& point : points) {
      const bool on_plane =
          std::any_of(inside_b.begin(), inside_b.end(), [&](const Facet& f) {
            return definition::side_of(f.support, point) == 0;
          });
      if (on_plane || inside_b.empty()) continue;
      cases.meet(definition::winding(inside_b, point) == 1
                     ? "a vertex in the other's interior"
                     : "a vertex in the other's exterior");
    }
  }
}

/// Both operands, ready for an implementation.
template <class Impl>
struct Operands {
  typename Impl::Solid a;
  typename Impl::Solid b;
};

template <class Impl>
void for_all_operands(
    const std::function<void(const Operands<Impl>&)>& property,
    int count = kPairs) {
  law::Cases cases(kSituations);
  law::for_all_solids(
      [&](const generate::SolidPair& pair) {
        meet_situations(pair, cases);
        property({Impl::to_solid(pair.a), Impl::to_solid(pair.b)});
      },
      count);
  cases.expect_all();
}

template <class Impl>
Fraction volume(const typename Impl::Solid& solid) {
  return definition::volume6(Impl::polygons_of(solid));
}

template <class Impl>
bool is_empty(const typename Impl::Solid& solid) {
  return Impl::polygons_of(solid).empty();
}

/// Whether the solids are the same point set: neither has what the other
/// has not.
template <class Impl>
bool same_points(const typename Impl::Solid& a, const typename Impl::Solid& b) {
  return volume<Impl>(a) == volume<Impl>(b) &&
         is_empty<Impl>(Impl::boolean(kDifference, a, b)) &&
         is_empty<Impl>(Impl::boolean(kDifference, b, a));
}

/// Points all over the small solids, off the planes of most of them.
std::vector<Point> some_points() {
  std::vector<Point> points;
  for (int k = 0; k < 90; ++k) {
    // Sevenths of grid steps from -6 to 8, without order.
    points.push_back({Integer(k * 37 % 97 - 41), Integer(k * 53 % 97 - 40),
                      Integer(k * 71 % 97 - 42), Integer(7)});
  }
  return points;
}

bool is_on_any_plane(const std::vector<Facet>& facets, const Point& point) {
  return std::any_of(facets.begin(), facets.end(), [&](const Facet& facet) {
    return definition::side_of(facet.support, point) == 0;
  });
}

bool apply(BooleanOp operation, bool a, bool b) {
  switch (operation) {
    case kUnion:
      return a || b;
    case kIntersection:
      return a && b;
    case kDifference:
      return a && !b;
  }
  return false;
}

TYPED_TEST(S6Boolean, L1AClosedSurfaceHasNoBadEdgeAndAnyOtherDoes) {
  int broken = 0;
  law::for_all_solids(
      [&](const generate::SolidPair& pair) {
        const Scene& scene = pair.a.scene();
        HALFSPACE_LAW(bad_edges(scene).empty());
        for (const PolygonId p : ids_of(scene)) {
          // The polygon's edges, as one that is missing leaves them.
          std::vector<BadEdge> missing, turned;
          const auto corners = scene.corners(p);
          for (std::size_t k = 0; k < corners.size(); ++k) {
            const GridPoint& from = scene.point(corners[k]);
            const GridPoint& to =
                scene.point(corners[(k + 1) % corners.size()]);
            missing.push_back({to, from, 1});
            turned.push_back({to, from, 2});
          }
          const auto by_ends = [](const BadEdge& e, const BadEdge& f) {
            return std::minmax(e.from, e.to) < std::minmax(f.from, f.to);
          };
          auto others = ids_of(scene);
          others.erase(others.begin() + p);
          const Scene without = chosen(scene, others);
          SceneData data = scene.data();
          std::reverse(data.corners.begin() +
                           data.first_corner[static_cast<std::size_t>(p)],
                       data.corners.begin() +
                           data.first_corner[static_cast<std::size_t>(p) + 1]);
          const Scene with_turned = *make_scene(std::move(data));
          for (const auto& [spoilt, expected] :
               {std::pair(without, missing), std::pair(with_turned, turned)}) {
            auto found = bad_edges(spoilt);
            auto sorted = expected;
            std::sort(sorted.begin(), sorted.end(), by_ends);
            HALFSPACE_LAW(found == sorted);
            const auto solid = make_solid(spoilt);
            HALFSPACE_LAW(!solid);
            HALFSPACE_LAW(solid.error().code == ErrorCode::kNotClosed);
            HALFSPACE_LAW(solid.error().index ==
                          static_cast<std::int64_t>(expected.size()));
            ++broken;
          }
        }
      },
      kPairs);
  EXPECT_GT(broken, 1000);
}

TYPED_TEST(S6Boolean, L2TheResultOfEveryBooleanIsClosed) {
  int faces = 0;
  for_all_operands<TypeParam>([&](const Operands<TypeParam>& of) {
    for (const BooleanOp operation : kOperations) {
      const auto result = TypeParam::boolean(operation, of.a, of.b);
      const auto polygons = TypeParam::polygons_of(result);
      HALFSPACE_LAW(definition::is_closed(polygons));
      HALFSPACE_LAW(TypeParam::is_closed(result));
      faces += static_cast<int>(polygons.size());
    }
  });
  EXPECT_GT(faces, 1000);
}

TYPED_TEST(S6Boolean, L3VolumesAddUp) {
  int overlapping = 0;
  for_all_operands<TypeParam>([&](const Operands<TypeParam>& of) {
    const auto of_result = [&](BooleanOp operation) {
      const auto result = TypeParam::boolean(operation, of.a, of.b);
      HALFSPACE_LAW(TypeParam::volume6(result) == volume<TypeParam>(result));
      return volume<TypeParam>(result);
    };
    const Fraction a = volume<TypeParam>(of.a);
    const Fraction b = volume<TypeParam>(of.b);
    const Fraction both = of_result(kIntersection);
    HALFSPACE_LAW(a >= 0 && b >= 0 && both >= 0);
    HALFSPACE_LAW(both <= a && both <= b);
    HALFSPACE_LAW(of_result(kUnion) + both == a + b);
    HALFSPACE_LAW(of_result(kDifference) == a - both);
    overlapping += both > 0 ? 1 : 0;
  });
  EXPECT_GT(overlapping, 20);
}

TYPED_TEST(S6Boolean, L4MembershipIsTheBooleanOfMemberships) {
  std::map<std::pair<bool, bool>, int> met;
  for_all_operands<TypeParam>([&](const Operands<TypeParam>& of) {
    const auto a = facets_of<TypeParam>(of.a);
    const auto b = facets_of<TypeParam>(of.b);
    for (const BooleanOp operation : kOperations) {
      const auto result =
          facets_of<TypeParam>(TypeParam::boolean(operation, of.a, of.b));
      for (const Point& point : some_points()) {
        if (is_on_any_plane(a, point) || is_on_any_plane(b, point)) continue;
        const int in_a = definition::winding(a, point);
        const int in_b = definition::winding(b, point);
        HALFSPACE_LAW(definition::winding(result, point) ==
                      (apply(operation, in_a == 1, in_b == 1) ? 1 : 0));
        ++met[{in_a == 1, in_b == 1}];
      }
    }
  });
  for (const bool in_a : {false, true}) {
    for (const bool in_b : {false, true})
      EXPECT_GT((met[{in_a, in_b}]), 50) << in_a << in_b;
  }
}

TYPED_TEST(S6Boolean, L5UnionAndIntersectionAreCommutative) {
  for_all_operands<TypeParam>([](const Operands<TypeParam>& of) {
    for (const BooleanOp operation : {kUnion, kIntersection}) {
      HALFSPACE_LAW(
          same_points<TypeParam>(TypeParam::boolean(operation, of.a, of.b),
                                 TypeParam::boolean(operation, of.b, of.a)));
    }
  });
}

TYPED_TEST(S6Boolean, L6ASolidWithItselfIsItself) {
  for_all_operands<TypeParam>([](const Operands<TypeParam>& of) {
    HALFSPACE_LAW(
        same_points<TypeParam>(TypeParam::boolean(kUnion, of.a, of.a), of.a));
    HALFSPACE_LAW(same_points<TypeParam>(
        TypeParam::boolean(kIntersection, of.a, of.a), of.a));
    HALFSPACE_LAW(
        is_empty<TypeParam>(TypeParam::boolean(kDifference, of.a, of.a)));
  });
}

TYPED_TEST(S6Boolean, L7AgainstTheEmptySolid) {
  const auto empty = TypeParam::to_solid(*make_solid(Scene()));
  for_all_operands<TypeParam>([&](const Operands<TypeParam>& of) {
    for (const BooleanOp operation : {kUnion, kDifference}) {
      const auto result = TypeParam::boolean(operation, of.a, empty);
      HALFSPACE_LAW(TypeParam::polygons_of(result) ==
                    TypeParam::polygons_of(of.a));
    }
    HALFSPACE_LAW(TypeParam::polygons_of(TypeParam::boolean(
                      kUnion, empty, of.a)) == TypeParam::polygons_of(of.a));
    HALFSPACE_LAW(
        is_empty<TypeParam>(TypeParam::boolean(kIntersection, of.a, empty)));
    HALFSPACE_LAW(
        is_empty<TypeParam>(TypeParam::boolean(kIntersection, empty, of.a)));
    HALFSPACE_LAW(
        is_empty<TypeParam>(TypeParam::boolean(kDifference, empty, of.a)));
  });
}

TYPED_TEST(S6Boolean, L8TheDifferenceIsTheIntersectionWithTheComplement) {
  int compared = 0;
  law::for_all_solids(
      [&](const generate::SolidPair& pair) {
        // The complement of nothing has no surface to turn over.
        if (pair.b.scene().polygon_count() == 0) return;
        const auto a = TypeParam::to_solid(pair.a);
        const auto b = TypeParam::to_solid(pair.b);
        const auto complement =
            TypeParam::to_solid(*make_solid(reversed(pair.b.scene())));
        HALFSPACE_LAW(same_points<TypeParam>(
            TypeParam::boolean(kDifference, a, b),
            TypeParam::boolean(kIntersection, a, complement)));
        ++compared;
      },
      kPairs);
  EXPECT_GT(compared, 100);
}

TYPED_TEST(S6Boolean, L9AChainHasTheVolumeAndMembersOfItsSets) {
  law::for_all_solids(
      [&](const generate::SolidPair& pair) {
        const auto a = TypeParam::to_solid(pair.a);
        const auto b = TypeParam::to_solid(pair.b);
        // The second once more, moved so that it meets everything.
        SceneData data = pair.b.scene().data();
        for (GridPoint& p : data.vertices) p = {p.x + 1, p.y - 1, p.z};
        const auto c =
            TypeParam::to_solid(*make_solid(*make_scene(std::move(data))));
        const auto in_a = facets_of<TypeParam>(a);
        const auto in_b = facets_of<TypeParam>(b);
        const auto in_c = facets_of<TypeParam>(c);
        for (const BooleanOp first : kOperations) {
          const auto ab = TypeParam::boolean(first, a, b);
          const Fraction both =
              volume<TypeParam>(TypeParam::boolean(kIntersection, ab, c));
          for (const BooleanOp second : kOperations) {
            const auto result = TypeParam::boolean(second, ab, c);
            HALFSPACE_LAW(
                definition::is_closed(TypeParam::polygons_of(result)));
            const Fraction expected =
                second == kUnion
                    ? volume<TypeParam>(ab) + volume<TypeParam>(c) - both
                : second == kIntersection ? both
                                          : volume<TypeParam>(ab) - both;
            HALFSPACE_LAW(volume<TypeParam>(result) == expected);
            const auto in_result = facets_of<TypeParam>(result);
            for (const Point& point : some_points()) {
              if (is_on_any_plane(in_a, point) ||
                  is_on_any_plane(in_b, point) || is_on_any_plane(in_c, point))
                continue;
              const auto is_in = [&](const std::vector<Facet>& solid) {
                return definition::winding(solid, point) == 1;
              };
              HALFSPACE_LAW(is_in(in_result) ==
                            apply(second,
                                  apply(first, is_in(in_a), is_in(in_b)),
                                  is_in(in_c)));
            }
          }
        }
      },
      40);
}

/// A point inside a convex polygon, on none of its lines of symmetry.
Point inner_point(const std::vector<Point>& polygon) {
  Point sum{0, 0, 0, 0};
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    Integer weight = static_cast<int>(97 + 31 * k * k);
    for (std::size_t l = 0; l < polygon.size(); ++l) {
      if (l != k) weight *= polygon[l].w;
    }
    sum.x += weight * polygon[k].x;
    sum.y += weight * polygon[k].y;
    sum.z += weight * polygon[k].z;
    sum.w += weight * polygon[k].w;
  }
  return sum;
}

/// The class of a point of a polygon in `support` against a solid: by the
/// solid's facets through it, else by how it winds round the point.
SolidClass class_of(const Point& point, const Plane& support,
                    const std::vector<Facet>& solid) {
  for (const Facet& facet : solid) {
    const bool is_in =
        definition::side_of(facet.support, point) == 0 &&
        std::none_of(facet.edges.begin(), facet.edges.end(),
                     [&](const Plane& edge) {
                       return definition::side_of(edge, point) < 0;
                     });
    if (!is_in) continue;
    const Integer agree = facet.support.a * support.a +
                          facet.support.b * support.b +
                          facet.support.c * support.c;
    return agree > 0 ? SolidClass::kSame : SolidClass::kOpposite;
  }
  return definition::winding(solid, point) == 1 ? SolidClass::kInside
                                                : SolidClass::kOutside;
}

TYPED_TEST(S6Boolean, L10ClassifiedPartsMakeUpThePolygonAndHaveItsClasses) {
  std::map<SolidClass, int> met;
  for_all_operands<TypeParam>([&](const Operands<TypeParam>& of) {
    const auto b = facets_of<TypeParam>(of.b);
    const auto polygons = TypeParam::polygons_of(of.a);
    for (std::size_t p = 0; p < polygons.size(); ++p) {
      const auto support = definition::facet_of(polygons[p]).support;
      for (const RootRule rule : {RootRule::kFirst, RootRule::kRandom}) {
        definition::Area area;
        for (const ClassifiedPart& part : TypeParam::classify(
                 of.a, static_cast<PolygonId>(p), of.b, {rule})) {
          area = area + definition::area_of(part.vertices);
          HALFSPACE_LAW(part.solid_class ==
                        class_of(inner_point(part.vertices), support, b));
          ++met[part.solid_class];
        }
        HALFSPACE_LAW(area == definition::area_of(polygons[p]));
      }
    }
  });
  for (const SolidClass solid_class :
       {SolidClass::kInside, SolidClass::kOutside, SolidClass::kSame,
        SolidClass::kOpposite})
    EXPECT_GT(met[solid_class], 20) << static_cast<int>(solid_class);
}

/// Whether two convex polygons lie in one plane and overlap there: no edge of
/// either has all of the other on its far side.
bool overlap(const std::vector<Point>& p, const std::vector<Point>& q) {
  const Facet f = definition::facet_of(p);
  const Facet g = definition::facet_of(q);
  if (definition::relation(q, f.support) != Relation::kCoincident) return false;
  const auto separates = [](const Facet& facet,
                            const std::vector<Point>& points) {
    return std::any_of(
        facet.edges.begin(), facet.edges.end(), [&](const Plane& edge) {
          return std::all_of(points.begin(), points.end(),
                             [&](const Point& point) {
                               return definition::side_of(edge, point) <= 0;
                             });
        });
  };
  return !separates(f, q) && !separates(g, p);
}

TYPED_TEST(S6Boolean, L11NoTwoFragmentsOfAResultOverlap) {
  int pairs = 0;
  for_all_operands<TypeParam>(
      [&](const Operands<TypeParam>& of) {
        for (const BooleanOp operation : kOperations) {
          const auto polygons =
              TypeParam::polygons_of(TypeParam::boolean(operation, of.a, of.b));
          for (std::size_t p = 0; p < polygons.size(); ++p) {
            for (std::size_t q = 0; q < p; ++q) {
              HALFSPACE_LAW(!overlap(polygons[p], polygons[q]));
              ++pairs;
            }
          }
        }
      },
      60);
  EXPECT_GT(pairs, 10000);
}

TYPED_TEST(S6Boolean, L12ThePointSetDoesNotDependOnTheTrees) {
  for_all_operands<TypeParam>(
      [](const Operands<TypeParam>& of) {
        for (const BooleanOp operation : kOperations) {
          const auto result = TypeParam::boolean(operation, of.a, of.b);
          for (const BuildOptions& options :
               {BuildOptions{RootRule::kFirst}, BuildOptions{RootRule::kH2},
                BuildOptions{RootRule::kRandom, 1, 99},
                BuildOptions{RootRule::kH5}}) {
            HALFSPACE_LAW(same_points<TypeParam>(
                TypeParam::boolean(operation, of.a, of.b, options), result));
          }
        }
      },
      60);
}

}  // namespace
}  // namespace halfspace
