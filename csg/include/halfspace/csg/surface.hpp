#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>

#include "halfspace/csg/matrix.hpp"
#include "halfspace/fast/solid.hpp"
#include "halfspace/io/number.hpp"

namespace halfspace::csg {

using io::Integer;
using Integers3 = std::array<Integer, 3>;

/// A point in homogeneous coordinates: at[i] / below. Units: grid steps.
struct ExactPoint {
  Integers3 at;
  Integer below = 1;  ///< above 0
};

Integers3 cross(const Integers3& a, const Integers3& b);
Integer dot(const Integers3& a, const Integers3& b);

/// The vertices and planes of a solid exactly, each computed once.
class ExactSurface {
 public:
  explicit ExactSurface(const fast::Solid& solid) : solid_(solid) {}

  const fast::Solid& solid() const { return solid_; }
  const ExactPoint& point(std::int32_t vertex);
  /// The normal of a face, outwards, in least integers, and a point of it.
  Integers3 normal(const fast::Face& face) const;
  Integers3 origin(const fast::Face& face) const;

 private:
  const fast::Solid& solid_;
  std::unordered_map<std::int32_t, ExactPoint> points_;
};

/// -1, 0, 1: where the point is against the face's plane; 1 is outwards.
int side_of(const ExactSurface& surface, const fast::Face& face,
            const ExactPoint& point);

/// A point in model units, on the grid of a unit.
ExactPoint in_steps(const Numbers3& at, const Unit& unit);

/// Twice the area of three points as seen along an axis, counterclockwise from
/// where that points, times the product of their denominators.
Integer area2(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c,
              std::size_t axis);

/// The axis along which the normal is longest.
std::size_t longest_axis(const Integers3& normal);

bool same(const ExactPoint& a, const ExactPoint& b);

/// Whether a < b along an axis: -1, 0, 1 as for a - b.
int compare(const ExactPoint& a, const ExactPoint& b, std::size_t axis);

/// Whether a point of the face's plane is in the face or on its boundary.
bool is_in_face(ExactSurface& surface, const fast::Face& face,
                const ExactPoint& point);

/// How often the face goes round the point as seen along an axis, which is
/// moved by (e, e^2) in the axes after it, e infinitely small.
int turns_round(ExactSurface& surface, const fast::Face& face,
                const ExactPoint& point, std::size_t axis);

/// Visits the edges of a face.
template <class Visit>
void for_edges(const fast::Solid& solid, const fast::Face& face,
               const Visit& visit) {
  for (std::uint32_t i = 0; i < face.edge_count; ++i)
    visit(solid.edges[face.first_edge + i]);
}

}  // namespace halfspace::csg
