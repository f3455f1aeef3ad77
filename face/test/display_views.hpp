#pragma once

#include "halfspace/halfspace.hpp"

/// What tests of displays show.
namespace halfspace {

inline Solid knot() {
  return Solid::torus(3, 1, 16, 8) + Solid::box({-1, -1, -2}, {1, 1, 3});
}

inline View small_view() {
  View view;
  view.width_px = 64;
  view.height_px = 48;
  return view;
}

}  // namespace halfspace
