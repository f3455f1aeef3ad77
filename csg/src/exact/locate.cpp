#include "halfspace/csg/locate.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "halfspace/csg/interval.hpp"

namespace halfspace::csg {

int location_of(const fast::Solid& solid, const ExactPoint& p) {
  // In floats, rounded outwards, as the faces' boxes.
  std::array<double, 3> low{}, high{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double at = nearest_double(p.at[i], p.below);
    low[i] = std::nextafter(at, -std::numeric_limits<double>::infinity());
    high[i] = std::nextafter(at, std::numeric_limits<double>::infinity());
  }
  const auto may_hold = [&](const fast::Face& face, std::size_t i) {
    return static_cast<double>(face.box.low[i]) <= high[i] &&
           low[i] <= static_cast<double>(face.box.high[i]);
  };
  ExactSurface surface(solid);
  int winding = 0;
  for (const fast::Face& face : solid.faces) {
    // A ray from the point along z meets faces above it alone.
    if (!may_hold(face, 0) || !may_hold(face, 1) ||
        low[2] > static_cast<double>(face.box.high[2]))
      continue;
    const int side = side_of(surface, face, p);
    if (side == 0) {
      if (is_in_face(surface, face, p)) return 0;
      continue;
    }
    const int up = surface.normal(face)[2].sign();
    if (up != 0 && side != up) winding += turns_round(surface, face, p, 2);
  }
  const int far = solid.unbounded ? 1 : 0;
  return winding + far > 0 ? -1 : 1;
}

}  // namespace halfspace::csg
