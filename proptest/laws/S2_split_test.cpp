#include <algorithm>
#include <set>

#include "adapters/both.hpp"
#include "adapters/scenes.hpp"
#include "definition/definition.hpp"
#include "generate/shapes.hpp"
#include "laws/law.hpp"
#include "laws/turned_over.hpp"

namespace halfspace {
namespace {

using definition::Integer;
using definition::Point;

template <class Impl>
class S2Split : public ::testing::Test {};
TYPED_TEST_SUITE(S2Split, Implementations);

/// A spanning fragment, its parts, and what they are by the definition.
template <class Impl>
struct Cut {
  const Scene& scene;
  typename Impl::Fragment fragment;
  PolygonId splitter;
  std::pair<typename Impl::Fragment, typename Impl::Fragment> parts;
  std::vector<Point> whole;
  std::vector<Point> positive;
  std::vector<Point> negative;
  definition::Plane plane;

  Cut(const Scene& in, const typename Impl::Fragment& of, PolygonId by)
      : scene(in),
        fragment(of),
        splitter(by),
        parts(Impl::split(in, of, by)),
        whole(definition::points_of(in, Impl::name_of(of))),
        positive(definition::points_of(in, Impl::name_of(parts.first))),
        negative(definition::points_of(in, Impl::name_of(parts.second))),
        plane(definition::plane_of(in, by)) {}
};

/// Checks a property of every cut of every fragment of generated views.
template <class Impl>
void for_all_cuts(const std::function<void(const Cut<Impl>&)>& property) {
  law::Cases on_plane({"0 vertices on the splitter", "1", "2"});
  law::for_all_views([&](const SceneFile& view) {
    for (const auto& fragment : fragments_of<Impl>(view.scene)) {
      for (const PolygonId q : ids_of(view.scene)) {
        if (Impl::relation(view.scene, fragment, q) != Relation::kSpanning)
          continue;
        const Cut<Impl> cut(view.scene, fragment, q);
        const auto on = std::count_if(
            cut.whole.begin(), cut.whole.end(), [&](const Point& p) {
              return definition::side_of(cut.plane, p) == 0;
            });
        on_plane.meet(on == 0   ? "0 vertices on the splitter"
                      : on == 1 ? "1"
                                : "2");
        property(cut);
      }
    }
  });
  on_plane.expect_all();
}

/// Triangles of the grid of 3 x 3 x 3 points: of those that symmetries of the
/// cube take into each other, one; and all.
struct SmallTriangles {
  std::vector<std::vector<GridPoint>> some;
  std::vector<std::vector<GridPoint>> all;
};

GridPoint small_point(int k) { return {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1}; }

/// The least of the images of a set of points under the cube's symmetries.
std::vector<GridPoint> canonical(const std::vector<GridPoint>& points) {
  std::vector<GridPoint> least;
  for (int symmetry = 0; symmetry < 48; ++symmetry) {
    int order[3] = {0, 1, 2};
    for (int k = 0; k < symmetry / 8; ++k)
      std::next_permutation(order, order + 3);
    std::vector<GridPoint> image;
    for (const GridPoint& p : points) {
      const std::int64_t c[3] = {p.x, p.y, p.z};
      const auto at = [&](int axis) {
        return (symmetry >> axis & 1) == 0 ? c[order[axis]] : -c[order[axis]];
      };
      image.push_back({at(0), at(1), at(2)});
    }
    std::sort(image.begin(), image.end());
    if (least.empty() || image < least) least = image;
  }
  return least;
}

SmallTriangles small_triangles() {
  SmallTriangles triangles;
  std::set<std::vector<GridPoint>> seen;
  for (int a = 0; a < 27; ++a) {
    for (int b = a + 1; b < 27; ++b) {
      for (int c = b + 1; c < 27; ++c) {
        const std::vector<GridPoint> triangle = {small_point(a), small_point(b),
                                                 small_point(c)};
        if (!generate::is_valid(triangle)) continue;
        triangles.all.push_back(triangle);
        if (seen.insert(canonical(triangle)).second)
          triangles.some.push_back(triangle);
      }
    }
  }
  return triangles;
}

/// Calls `visit` with a scene of two triangles, for all small ones.
template <class Visit>
void for_all_small_pairs(const Visit& visit) {
  const SmallTriangles triangles = small_triangles();
  ASSERT_GT(triangles.some.size(), 50u);
  ASSERT_GT(triangles.all.size(), 2800u);
  for (const auto& first : triangles.some) {
    for (const auto& second : triangles.all)
      visit(generate::scene_of({first, second}, {}));
  }
}

TYPED_TEST(S2Split, L1TheRelationIsWhatTheSidesOfTheVerticesSay) {
  std::set<Relation> met;
  const auto check = [&](const Scene& scene) {
    // One at a time: a fragment's names are those of its source as it is.
    std::vector<Scene> turned;
    for (const PolygonId q : ids_of(scene))
      turned.push_back(turned_over(scene, q));
    for (const auto& fragment : fragments_of<TypeParam>(scene)) {
      const auto points =
          definition::points_of(scene, TypeParam::name_of(fragment));
      for (const PolygonId q : ids_of(scene)) {
        const Relation expected =
            definition::relation(points, definition::plane_of(scene, q));
        HALFSPACE_LAW(TypeParam::relation(scene, fragment, q) == expected);
        const Relation exchanged =
            expected == Relation::kPositive   ? Relation::kNegative
            : expected == Relation::kNegative ? Relation::kPositive
                                              : expected;
        if (TypeParam::name_of(fragment).source != q) {
          HALFSPACE_LAW(TypeParam::relation(turned[static_cast<std::size_t>(q)],
                                            fragment, q) == exchanged);
        }
        met.insert(expected);
      }
    }
  };
  law::for_all_views([&](const SceneFile& view) { check(view.scene); });
  for_all_small_pairs([&](const Scene& scene) {
    const auto fragment = TypeParam::whole(scene, 1);
    const auto points =
        definition::points_of(scene, TypeParam::name_of(fragment));
    ASSERT_EQ(TypeParam::relation(scene, fragment, 0),
              definition::relation(points, definition::plane_of(scene, 0)));
  });
  EXPECT_EQ(met.size(), 4u);
}

TYPED_TEST(S2Split, L2PartsHaveFourEdgesMoreLessVerticesOnTheSplitter) {
  for_all_cuts<TypeParam>([](const Cut<TypeParam>& cut) {
    const auto on = static_cast<std::size_t>(
        std::count_if(cut.whole.begin(), cut.whole.end(), [&](const Point& p) {
          return definition::side_of(cut.plane, p) == 0;
        }));
    HALFSPACE_LAW(cut.positive.size() + cut.negative.size() + on ==
                  cut.whole.size() + 4);
  });
}

TYPED_TEST(S2Split, L3ThePartsLieOnTheirSides) {
  for_all_cuts<TypeParam>([](const Cut<TypeParam>& cut) {
    HALFSPACE_LAW(definition::relation(cut.positive, cut.plane) ==
                  Relation::kPositive);
    HALFSPACE_LAW(definition::relation(cut.negative, cut.plane) ==
                  Relation::kNegative);
    HALFSPACE_LAW(TypeParam::relation(cut.scene, cut.parts.first,
                                      cut.splitter) == Relation::kPositive);
    HALFSPACE_LAW(TypeParam::relation(cut.scene, cut.parts.second,
                                      cut.splitter) == Relation::kNegative);
  });
}

TYPED_TEST(S2Split, L4TheAreasOfThePartsAddUp) {
  for_all_cuts<TypeParam>([](const Cut<TypeParam>& cut) {
    HALFSPACE_LAW(definition::area_of(cut.positive) +
                      definition::area_of(cut.negative) ==
                  definition::area_of(cut.whole));
  });
}

/// 1 within, 0 on the boundary, -1 without: a point of the support.
int place_in(const definition::Facet& facet, const Point& p) {
  int least = 1;
  for (const auto& edge : facet.edges)
    least = std::min(least, definition::side_of(edge, p));
  return least;
}

TYPED_TEST(S2Split, L5APointIsInTheFragmentIfItIsInAPart) {
  int inside = 0, outside = 0;
  for_all_cuts<TypeParam>([&](const Cut<TypeParam>& cut) {
    const auto facet_of = [&](const auto& fragment) {
      return definition::facet_of(cut.scene, TypeParam::name_of(fragment));
    };
    const auto whole = facet_of(cut.fragment);
    const auto positive = facet_of(cut.parts.first);
    const auto negative = facet_of(cut.parts.second);
    // Points a p0 + b p1 + c p2 of the plane, all over the fragment.
    const auto& points = cut.whole;
    for (int a = -2; a <= 4; ++a) {
      for (int b = -2; b <= 4; ++b) {
        const std::size_t last = points.size() - 1;
        const Point &p = points[0], &q = points[last / 2 + 1],
                    &r = points[last / 2];
        const Integer u = a * q.w * r.w, v = b * p.w * r.w,
                      w = (5 - a - b) * p.w * q.w;
        const Point point{u * p.x + v * q.x + w * r.x,
                          u * p.y + v * q.y + w * r.y,
                          u * p.z + v * q.z + w * r.z, 5 * p.w * q.w * r.w};
        const int in_positive = place_in(positive, point);
        const int in_negative = place_in(negative, point);
        const bool in_either = in_positive >= 0 || in_negative >= 0;
        HALFSPACE_LAW((place_in(whole, point) >= 0) == in_either);
        HALFSPACE_LAW(in_positive < 1 || in_negative < 1);
        ++(in_either ? inside : outside);
      }
    }
  });
  EXPECT_GT(inside, 1000);
  EXPECT_GT(outside, 1000);
}

/// The sign of the turn p, q, r, seen from where the plane is positive.
int turn(const Point& p, const Point& q, const Point& r,
         const definition::Plane& plane) {
  // Vectors from p to q and r, times products of the w, which are positive.
  const Integer u[3] = {q.x * p.w - p.x * q.w, q.y * p.w - p.y * q.w,
                        q.z * p.w - p.z * q.w};
  const Integer v[3] = {r.x * p.w - p.x * r.w, r.y * p.w - p.y * r.w,
                        r.z * p.w - p.z * r.w};
  const Integer along = plane.a * (u[1] * v[2] - u[2] * v[1]) +
                        plane.b * (u[2] * v[0] - u[0] * v[2]) +
                        plane.c * (u[0] * v[1] - u[1] * v[0]);
  return along.sign();
}

/// Whether the points are the corners of a convex polygon, each once, that has
/// an area and turns the way of its support.
bool is_convex(const std::vector<Point>& points,
               const definition::Plane& support) {
  const std::size_t count = points.size();
  bool has_area = false;
  for (std::size_t i = 0; i < count; ++i) {
    const Point& p = points[i];
    const Point& q = points[(i + 1) % count];
    if (p == q) return false;
    // Every other point is left of the edge, or on its line.
    for (const Point& r : points) {
      const int turned = turn(p, q, r, support);
      if (turned < 0) return false;
      has_area = has_area || turned > 0;
    }
  }
  return count >= 3 && has_area;
}

TYPED_TEST(S2Split, L6EveryPartIsConvexAndTurnsAsItsSourceDoes) {
  for_all_cuts<TypeParam>([](const Cut<TypeParam>& cut) {
    const auto support = definition::plane_of(
        cut.scene, TypeParam::name_of(cut.fragment).source);
    HALFSPACE_LAW(is_convex(cut.positive, support));
    HALFSPACE_LAW(is_convex(cut.negative, support));
  });
}

TYPED_TEST(S2Split, L7PartsKeepTheNamesAndGainTheSplitters) {
  const auto check = [](const Cut<TypeParam>& cut) {
    const auto expected = definition::split(
        cut.scene, TypeParam::name_of(cut.fragment), cut.splitter);
    HALFSPACE_LAW(TypeParam::name_of(cut.parts.first) == expected.positive);
    HALFSPACE_LAW(TypeParam::name_of(cut.parts.second) == expected.negative);
    const EdgeName added{EdgeName::Kind::kSplitter, cut.splitter};
    for (const FragmentName& part : {expected.positive, expected.negative}) {
      HALFSPACE_LAW(std::count(part.edges.begin(), part.edges.end(), added) ==
                    1);
    }
  };
  for_all_cuts<TypeParam>(check);
  int spanning = 0;
  for_all_small_pairs([&](const Scene& scene) {
    const auto fragment = TypeParam::whole(scene, 1);
    if (TypeParam::relation(scene, fragment, 0) != Relation::kSpanning) return;
    check(Cut<TypeParam>(scene, fragment, 0));
    ++spanning;
  });
  EXPECT_GT(spanning, 10000);
}

TYPED_TEST(S2Split, L8NoTwoEdgesHaveTheSameName) {
  law::for_all_views([](const SceneFile& view) {
    for (const auto& fragment : fragments_of<TypeParam>(view.scene)) {
      const FragmentName name = TypeParam::name_of(fragment);
      const std::set<EdgeName> different(name.edges.begin(), name.edges.end());
      HALFSPACE_LAW(different.size() == name.edges.size());
      HALFSPACE_LAW(name.edges.front() == *different.begin());
      for (std::size_t k = 0; k < name.edges.size(); ++k) {
        auto turned = name.edges;
        std::rotate(turned.begin(),
                    turned.begin() + static_cast<std::ptrdiff_t>(k),
                    turned.end());
        HALFSPACE_LAW(rotated_to_least(turned) == name.edges);
      }
    }
  });
}

/// Whether the two planes meet the support in one line, or not in a line each.
bool in_one_line(const definition::Plane& p, const definition::Plane& q,
                 const definition::Plane& support) {
  // All 3 x 3 minors of the three planes vanish: rank 2 or less.
  const Integer row[3][4] = {{p.a, p.b, p.c, p.d},
                             {q.a, q.b, q.c, q.d},
                             {support.a, support.b, support.c, support.d}};
  for (int skip = 0; skip < 4; ++skip) {
    int c[3], n = 0;
    for (int k = 0; k < 4; ++k) {
      if (k != skip) c[n++] = k;
    }
    const Integer minor =
        row[0][c[0]] *
            (row[1][c[1]] * row[2][c[2]] - row[1][c[2]] * row[2][c[1]]) -
        row[0][c[1]] *
            (row[1][c[0]] * row[2][c[2]] - row[1][c[2]] * row[2][c[0]]) +
        row[0][c[2]] *
            (row[1][c[0]] * row[2][c[1]] - row[1][c[1]] * row[2][c[0]]);
    if (minor != 0) return false;
  }
  return true;
}

/// The parts of the fragment after cuts by both planes, by name, in a fixed
/// order: of all parts on the positive side of the first and so on.
template <class Impl>
std::vector<FragmentName> cut_by(const Scene& scene,
                                 const typename Impl::Fragment& fragment,
                                 PolygonId first, PolygonId second) {
  std::vector<typename Impl::Fragment> parts = {fragment};
  for (const PolygonId q : {first, second}) {
    std::vector<typename Impl::Fragment> next;
    for (const auto& part : parts) {
      if (Impl::relation(scene, part, q) != Relation::kSpanning) {
        next.push_back(part);
        continue;
      }
      auto cut = Impl::split(scene, part, q);
      next.push_back(cut.first);
      next.push_back(cut.second);
    }
    parts = std::move(next);
  }
  std::vector<FragmentName> names;
  for (const auto& part : parts) names.push_back(Impl::name_of(part));
  std::sort(names.begin(), names.end(),
            [](const FragmentName& a, const FragmentName& b) {
              return a.edges < b.edges;
            });
  return names;
}

TYPED_TEST(S2Split, L9TwoCutsGiveTheSamePartsInEitherOrder) {
  int crossing = 0;
  law::for_all_views([&](const SceneFile& view) {
    const Scene& scene = view.scene;
    for (const PolygonId p : ids_of(scene)) {
      const auto fragment = TypeParam::whole(scene, p);
      const auto support = definition::plane_of(scene, p);
      for (const PolygonId a : ids_of(scene)) {
        for (PolygonId b = 0; b < a; ++b) {
          if (in_one_line(definition::plane_of(scene, a),
                          definition::plane_of(scene, b), support))
            continue;
          const auto parts = cut_by<TypeParam>(scene, fragment, a, b);
          HALFSPACE_LAW(parts == cut_by<TypeParam>(scene, fragment, b, a));
          crossing += parts.size() == 4 ? 1 : 0;
        }
      }
    }
  });
  EXPECT_GT(crossing, 100);
}

}  // namespace
}  // namespace halfspace
