#pragma once

#include <string>

#include "halfspace/scene.hpp"

namespace halfspace::csg {

/// A length, area or volume: a number of steps, their squares or cubes, and the
/// unit that a step is. A unit may be so large or small that no double is near
/// the product.
struct Scaled {
  double steps = 0;
  Unit unit{2, 0};
  int power = 1;  ///< of the unit

  /// In model units, about. Beyond doubles: an infinity; below them: 0.
  double value() const;
  /// Whether value() is near: neither beyond doubles nor below normal ones.
  bool is_double() const;
};

/// In model units, with so many digits, as %g writes doubles; right for every
/// unit. Requires: 1 <= digits <= 17, and `steps` is finite.
std::string to_string(const Scaled& value, int digits);

}  // namespace halfspace::csg
