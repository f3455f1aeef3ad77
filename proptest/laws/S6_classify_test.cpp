#include <algorithm>
#include <map>

#include "adapters/both.hpp"
#include "definition/definition.hpp"
#include "laws/law.hpp"
#include "laws/operands.hpp"

namespace halfspace {
namespace {

using definition::Facet;
using definition::Integer;
using definition::Plane;
using definition::Point;
using enum BooleanOp;

template <class Impl>
class S6Classify : public ::testing::Test {};
TYPED_TEST_SUITE(S6Classify, ClassifyImplementations);

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

TYPED_TEST(S6Classify, L10ClassifiedPartsMakeUpThePolygonAndHaveItsClasses) {
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

TYPED_TEST(S6Classify, L12ThePointSetDoesNotDependOnTheTrees) {
  for_all_operands<TypeParam>(
      [](const Operands<TypeParam>& of) {
        for (const BooleanOp operation : kBooleanOps) {
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
