#pragma once

#include <algorithm>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "adapters/scenes.hpp"
#include "definition/definition.hpp"
#include "laws/law.hpp"

/// What the laws of booleans have in common: pairs of solids that come in all
/// situations.
namespace halfspace {

inline constexpr int kPairs = 400;

inline std::vector<definition::Facet> facets_of(
    const std::vector<std::vector<definition::Point>>& polygons) {
  std::vector<definition::Facet> facets;
  for (const auto& polygon : polygons)
    facets.push_back(definition::facet_of(polygon));
  return facets;
}

template <class Impl>
std::vector<definition::Facet> facets_of(const typename Impl::Solid& solid) {
  return facets_of(Impl::polygons_of(solid));
}

template <class Impl>
definition::Fraction volume(const typename Impl::Solid& solid) {
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
         is_empty<Impl>(Impl::boolean(BooleanOp::kDifference, a, b)) &&
         is_empty<Impl>(Impl::boolean(BooleanOp::kDifference, b, a));
}

/// `count` points in sevenths of grid steps, from `low` sevenths on over
/// `range` of them along each axis, without order: off the planes of most small
/// solids. Requires: 37, 53 and 71 have no factor in common with `range`.
inline std::vector<definition::Point> some_points(int count = 90, int low = -41,
                                                  int range = 97) {
  std::vector<definition::Point> points;
  for (int k = 0; k < count; ++k) {
    points.push_back({definition::Integer(k * 37 % range + low),
                      definition::Integer(k * 53 % range + low),
                      definition::Integer(k * 71 % range + low),
                      definition::Integer(7)});
  }
  return points;
}

/// Whether two convex polygons lie in one plane and overlap there: no edge of
/// either has all of the other on its far side.
inline bool overlap(const std::vector<definition::Point>& p,
                    const std::vector<definition::Point>& q) {
  const definition::Facet f = definition::facet_of(p);
  const definition::Facet g = definition::facet_of(q);
  if (definition::relation(q, f.support) != Relation::kCoincident) return false;
  const auto separates = [](const definition::Facet& facet,
                            const std::vector<definition::Point>& points) {
    return std::any_of(facet.edges.begin(), facet.edges.end(),
                       [&](const definition::Plane& edge) {
                         return std::all_of(
                             points.begin(), points.end(),
                             [&](const definition::Point& point) {
                               return definition::side_of(edge, point) <= 0;
                             });
                       });
  };
  return !separates(f, q) && !separates(g, p);
}

/// How two solids may lie against each other.
inline const std::set<std::string> kSituations = {
    "a polygon of the first spans the second's planes",
    "flush faces",
    "faces that touch from both sides",
    "a vertex in the other's interior",
    "a vertex in the other's exterior",
    "an empty operand",
    "more than one piece or a hollow"};

/// Those of the situations that hold.
inline void meet_situations(const generate::SolidPair& pair,
                            law::Cases& cases) {
  const Scene& a = pair.a.scene();
  const Scene& b = pair.b.scene();
  const auto whole = [](const Scene& scene, PolygonId id) {
    return definition::points_of(scene, definition::whole(scene, id));
  };
  std::vector<definition::Facet> inside_b;
  for (const PolygonId q : ids_of(b))
    inside_b.push_back(definition::facet_of(whole(b, q)));
  if (a.polygon_count() == 0 || b.polygon_count() == 0)
    cases.meet("an empty operand");
  if (a.polygon_count() > 20) cases.meet("more than one piece or a hollow");
  for (const PolygonId p : ids_of(a)) {
    const definition::Plane n = definition::plane_of(a, p);
    const auto points = whole(a, p);
    for (const PolygonId q : ids_of(b)) {
      const definition::Plane m = definition::plane_of(b, q);
      const Relation relation = definition::relation(points, m);
      if (relation == Relation::kSpanning)
        cases.meet("a polygon of the first spans the second's planes");
      if (relation != Relation::kCoincident) continue;
      const definition::Integer agree = n.a * m.a + n.b * m.b + n.c * m.c;
      cases.meet(agree > 0 ? "flush faces"
                           : "faces that touch from both sides");
    }
    for (const definition::Point& point : points) {
      const bool on_plane = std::any_of(
          inside_b.begin(), inside_b.end(), [&](const definition::Facet& f) {
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

}  // namespace halfspace
