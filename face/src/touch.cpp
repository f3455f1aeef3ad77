#include <unordered_map>
#include <utility>

#include "halfspace/csg/interval.hpp"
#include "halfspace/csg/surface.hpp"
#include "halfspace/fast/solid/near_faces.hpp"
#include "halfspace/solid.hpp"
#include "node.hpp"

namespace halfspace {
namespace {

using csg::ExactPoint;
using csg::ExactSurface;
using csg::Integer;
using detail::Evaluation;
using detail::SolidNode;

/// n . p = offset, in the steps that both solids are in.
struct TouchPlane {
  csg::Integers3 normal;
  Integer offset;
};

/// A solid's surface in steps of which those of both solids are multiples. Each
/// point and each plane is worked out once.
class TouchSide {
 public:
  TouchSide(const fast::Solid& solid, Integer steps)
      : surface_(solid), steps_(std::move(steps)) {}

  const fast::Solid& solid() const { return surface_.solid(); }
  const fast::Face& face(std::int32_t f) const {
    return solid().faces[static_cast<std::size_t>(f)];
  }
  const ExactPoint& point(std::int32_t vertex) {
    const auto [at, is_new] = points_.try_emplace(vertex);
    if (is_new) {
      at->second = surface_.point(vertex);
      for (Integer& c : at->second.at) c *= steps_;
    }
    return at->second;
  }
  const TouchPlane& plane(const fast::Face& face) {
    const auto [at, is_new] = planes_.try_emplace(face.plane);
    if (is_new) {
      TouchPlane& plane = at->second;
      plane.normal = surface_.normal(face);
      plane.offset = csg::dot(plane.normal, surface_.origin(face)) * steps_;
    }
    return at->second;
  }
  /// Whether a point of the face's plane is in it or on its boundary.
  bool holds(const fast::Face& face, const ExactPoint& point) {
    return csg::is_in_face(surface_, face, {point.at, point.below * steps_});
  }

 private:
  ExactSurface surface_;
  Integer steps_;  ///< in a step of the solid's grid
  std::unordered_map<std::int32_t, ExactPoint> points_;
  std::unordered_map<std::int32_t, TouchPlane> planes_;
};

/// n . p - offset, times the point's denominator.
Integer side_of(const TouchPlane& plane, const ExactPoint& point) {
  return csg::dot(plane.normal, point.at) - plane.offset * point.below;
}

/// Where a segment meets the face's plane; its ends are on either side, or one
/// is on it. `a_side` and `b_side` are |n.a - d| times the denominators.
ExactPoint meet(const ExactPoint& a, const Integer& a_side, const ExactPoint& b,
                const Integer& b_side) {
  ExactPoint result;
  for (std::size_t i = 0; i < 3; ++i)
    result.at[i] = a.at[i] * b_side + b.at[i] * a_side;
  result.below = a.below * b_side + b.below * a_side;
  return result;
}

/// Whether a segment and a face, both closed, have a common point, unless that
/// is told by others: of a segment in the face's plane its beginning alone is
/// looked at. Where it crosses an edge of the face, it passes through the
/// plane of the next face there that is not in this one; where it has a part of
/// such an edge, it holds the end of it or the edge holds its own.
bool segment_meets(TouchSide& side, const fast::Face& face, const ExactPoint& a,
                   const ExactPoint& b) {
  const TouchPlane& plane = side.plane(face);
  const Integer a_side = side_of(plane, a), b_side = side_of(plane, b);
  if (a_side.sign() * b_side.sign() > 0) return false;
  if (a_side == 0 && b_side == 0) return side.holds(face, a);
  return side.holds(face, meet(a, abs(a_side), b, abs(b_side)));
}

/// Whether an edge of the first face meets the second one.
bool edges_meet(TouchSide& first, const fast::Face& face, TouchSide& second,
                const fast::Face& other) {
  bool any = false;
  csg::for_edges(first.solid(), face, [&](const fast::SolidEdge& edge) {
    any = any || segment_meets(second, other, first.point(edge.from),
                               first.point(edge.to));
  });
  return any;
}

/// Whether all of the first face is off the second one's plane, on one side.
bool is_beside(TouchSide& first, const fast::Face& face, TouchSide& second,
               const fast::Face& other) {
  const TouchPlane& plane = second.plane(other);
  bool above = true, below = true;
  csg::for_edges(first.solid(), face, [&](const fast::SolidEdge& edge) {
    if (!above && !below) return;
    const int side = side_of(plane, first.point(edge.from)).sign();
    above = above && side > 0;
    below = below && side < 0;
  });
  return above || below;
}

bool surfaces_meet(const fast::Solid& a, const fast::Solid& b) {
  // A step of one is p/q of the other's: p and q steps of a finer grid.
  const csg::Scale a_step = csg::scale_of(a.unit, 1);
  const csg::Scale b_step = csg::scale_of(b.unit, 1);
  Integer a_steps = a_step.numerator * b_step.denominator;
  Integer b_steps = b_step.numerator * a_step.denominator;
  const Integer common = gcd(a_steps, b_steps);
  a_steps /= common;
  b_steps /= common;
  TouchSide first(a, a_steps), second(b, b_steps);
  for (const auto& [f, g] :
       fast::near_faces(a, b, csg::nearest_double(b_steps, a_steps))) {
    const fast::Face& face = first.face(f);
    const fast::Face& other = second.face(g);
    if (is_beside(first, face, second, other) ||
        is_beside(second, other, first, face))
      continue;
    if (edges_meet(first, face, second, other) ||
        edges_meet(second, other, first, face))
      return true;
  }
  return false;
}

}  // namespace

Result<bool> Solid::touches(const Solid& other) const {
  const Result<bool> over = overlaps(other);
  if (!over || *over) return over;
  const auto a = node_->evaluation({});
  if (!a) return a.error();
  const auto b = other.node_->evaluation({});
  if (!b) return b.error();
  if (*a == *b) return false;  // it is empty: it does not overlap itself
  const Lock lock((*a)->mutex, (*b)->mutex);
  return surfaces_meet((*a)->solid, (*b)->solid);
}

}  // namespace halfspace
