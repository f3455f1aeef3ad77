#include <algorithm>
#include <array>
#include <functional>

#include "adapters/both.hpp"
#include "adapters/scenes.hpp"
#include "definition/definition.hpp"
#include "laws/law.hpp"
#include "laws/operands.hpp"

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
TYPED_TEST_SUITE(S6Boolean, BooleanImplementations);

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
    case kSymmetricDifference:
      return a != b;
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
            HALFSPACE_LAW(solid.error().code == ErrorCode::kOpen);
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
    for (const BooleanOp operation : kBooleanOps) {
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
    HALFSPACE_LAW(of_result(kSymmetricDifference) + both + both == a + b);
    overlapping += both > 0 ? 1 : 0;
  });
  EXPECT_GT(overlapping, 20);
}

TYPED_TEST(S6Boolean, L4MembershipIsTheBooleanOfMemberships) {
  std::map<std::pair<bool, bool>, int> met;
  for_all_operands<TypeParam>([&](const Operands<TypeParam>& of) {
    const auto a = facets_of<TypeParam>(of.a);
    const auto b = facets_of<TypeParam>(of.b);
    for (const BooleanOp operation : kBooleanOps) {
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

TYPED_TEST(S6Boolean, L5AllButTheDifferenceAreCommutative) {
  for_all_operands<TypeParam>([](const Operands<TypeParam>& of) {
    for (const BooleanOp operation :
         {kUnion, kIntersection, kSymmetricDifference}) {
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
    for (const BooleanOp operation : {kDifference, kSymmetricDifference}) {
      HALFSPACE_LAW(
          is_empty<TypeParam>(TypeParam::boolean(operation, of.a, of.a)));
    }
  });
}

TYPED_TEST(S6Boolean, L7AgainstTheEmptySolid) {
  const auto empty = TypeParam::to_solid(*make_solid(Scene()));
  for_all_operands<TypeParam>([&](const Operands<TypeParam>& of) {
    for (const BooleanOp operation :
         {kUnion, kDifference, kSymmetricDifference}) {
      const auto result = TypeParam::boolean(operation, of.a, empty);
      HALFSPACE_LAW(TypeParam::polygons_of(result) ==
                    TypeParam::polygons_of(of.a));
    }
    for (const BooleanOp operation : {kUnion, kSymmetricDifference}) {
      const auto result = TypeParam::boolean(operation, empty, of.a);
      HALFSPACE_LAW(TypeParam::polygons_of(result) ==
                    TypeParam::polygons_of(of.a));
    }
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
        const auto complement = TypeParam::complement_of(pair.b);
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
        for (const BooleanOp first : kBooleanOps) {
          const auto ab = TypeParam::boolean(first, a, b);
          const Fraction both =
              volume<TypeParam>(TypeParam::boolean(kIntersection, ab, c));
          for (const BooleanOp second : kBooleanOps) {
            const auto result = TypeParam::boolean(second, ab, c);
            HALFSPACE_LAW(
                definition::is_closed(TypeParam::polygons_of(result)));
            const Fraction expected =
                second == kUnion
                    ? volume<TypeParam>(ab) + volume<TypeParam>(c) - both
                : second == kIntersection ? both
                : second == kDifference
                    ? volume<TypeParam>(ab) - both
                    : volume<TypeParam>(ab) + volume<TypeParam>(c) - both -
                          both;
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

TYPED_TEST(S6Boolean, L11NoTwoFragmentsOfAResultOverlap) {
  int pairs = 0;
  for_all_operands<TypeParam>(
      [&](const Operands<TypeParam>& of) {
        for (const BooleanOp operation : kBooleanOps) {
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

}  // namespace
}  // namespace halfspace
