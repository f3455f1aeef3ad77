#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "halfspace/csg/interval.hpp"
#include "halfspace/csg/surface.hpp"
#include "halfspace/solid.hpp"
#include "node.hpp"

namespace halfspace {
namespace {

using csg::ExactPoint;
using csg::ExactSurface;
using csg::Integer;
using detail::Evaluation;
using detail::SolidNode;

/// A solid's surface, and what its grid steps are in those of the other.
struct TouchSide {
  ExactSurface surface;
  csg::Scale scale;  ///< a step of this one, in model units

  explicit TouchSide(const fast::Solid& solid)
      : surface(solid), scale(csg::scale_of(solid.unit, 1)) {}
};

/// A point of one on the grid of the other.
ExactPoint moved(const ExactPoint& point, const TouchSide& from,
                 const TouchSide& to) {
  ExactPoint result = point;
  for (Integer& c : result.at) c *= from.scale.numerator * to.scale.denominator;
  result.below *= from.scale.denominator * to.scale.numerator;
  return result;
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

/// Whether two segments of the face's plane have a common point.
bool segments_meet(const ExactPoint& a, const ExactPoint& b,
                   const ExactPoint& c, const ExactPoint& d, std::size_t axis) {
  const int c_side = csg::area2(a, b, c, axis).sign();
  const int d_side = csg::area2(a, b, d, axis).sign();
  const int a_side = csg::area2(c, d, a, axis).sign();
  const int b_side = csg::area2(c, d, b, axis).sign();
  if (c_side * d_side > 0 || a_side * b_side > 0) return false;
  if (c_side != 0 || d_side != 0) return true;
  // On one line: whether they overlap there.
  for (std::size_t i = 0; i < 3; ++i) {
    const auto less = [i](const ExactPoint& p, const ExactPoint& q) {
      return csg::compare(p, q, i) < 0;
    };
    const auto [ab_low, ab_high] = std::minmax(a, b, less);
    const auto [cd_low, cd_high] = std::minmax(c, d, less);
    if (less(ab_high, cd_low) || less(cd_high, ab_low)) return false;
  }
  return true;
}

/// Whether a segment and a face, both closed, have a common point.
bool segment_meets(ExactSurface& surface, const fast::Face& face,
                   const ExactPoint& a, const ExactPoint& b) {
  const csg::Integers3 normal = surface.normal(face);
  const Integer offset = csg::dot(normal, surface.origin(face));
  const Integer a_side = csg::dot(normal, a.at) - offset * a.below;
  const Integer b_side = csg::dot(normal, b.at) - offset * b.below;
  if (a_side.sign() * b_side.sign() > 0) return false;
  if (a_side != 0 || b_side != 0) {
    return csg::is_in_face(surface, face, meet(a, abs(a_side), b, abs(b_side)));
  }
  if (csg::is_in_face(surface, face, a)) return true;
  const std::size_t axis = csg::longest_axis(normal);
  bool any = false;
  csg::for_edges(surface.solid(), face, [&](const fast::SolidEdge& edge) {
    const ExactPoint c = surface.point(edge.from);
    any = any || segments_meet(a, b, c, surface.point(edge.to), axis);
  });
  return any;
}

/// Whether an edge of the first face meets the second one.
bool edges_meet(TouchSide& first, const fast::Face& face, TouchSide& second,
                const fast::Face& other) {
  bool any = false;
  csg::for_edges(first.surface.solid(), face, [&](const fast::SolidEdge& edge) {
    if (any) return;
    const ExactPoint a = moved(first.surface.point(edge.from), first, second);
    const ExactPoint b = moved(first.surface.point(edge.to), first, second);
    any = segment_meets(second.surface, other, a, b);
  });
  return any;
}

/// A face's box in model units, rounded outwards and more.
struct ModelBox {
  std::array<double, 3> low{};
  std::array<double, 3> high{};
};

std::vector<ModelBox> boxes_of(const fast::Solid& solid) {
  const double step = std::pow(static_cast<double>(solid.unit.base),
                               static_cast<double>(solid.unit.exponent));
  std::vector<ModelBox> boxes;
  for (const fast::Face& face : solid.faces) {
    ModelBox box;
    for (std::size_t i = 0; i < 3; ++i) {
      // The step, and the product with it, are off by a few 2^-53.
      const double low = step * static_cast<double>(face.box.low[i]);
      const double high = step * static_cast<double>(face.box.high[i]);
      box.low[i] = low - std::abs(low) * 0x1p-48;
      box.high[i] = high + std::abs(high) * 0x1p-48;
    }
    boxes.push_back(box);
  }
  return boxes;
}

bool surfaces_meet(const fast::Solid& a, const fast::Solid& b) {
  TouchSide first(a), second(b);
  const auto a_boxes = boxes_of(a), b_boxes = boxes_of(b);
  const auto apart = [](const ModelBox& p, const ModelBox& q) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (p.high[i] < q.low[i] || q.high[i] < p.low[i]) return true;
    }
    return false;
  };
  for (std::size_t i = 0; i < a.faces.size(); ++i) {
    for (std::size_t j = 0; j < b.faces.size(); ++j) {
      if (apart(a_boxes[i], b_boxes[j])) continue;
      if (edges_meet(first, a.faces[i], second, b.faces[j]) ||
          edges_meet(second, b.faces[j], first, a.faces[i]))
        return true;
    }
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
