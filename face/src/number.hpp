#pragma once

#include <span>

#include "halfspace/csg/matrix.hpp"
#include "halfspace/io/mesh.hpp"
#include "halfspace/mesh.hpp"

namespace halfspace::detail {

/// The number that a double stands for: the decimal of at most 12 significant
/// digits from which it reads back, if there is one, else itself.
///
/// A double holds 15 digits of any decimal (IEEE 754), so what was typed comes
/// out as typed; of numbers that were computed, with 16 or 17 digits, one in
/// some 10,000 is next to so short a decimal by chance.
/// Requires: value is finite.
io::Number number_of(double value);
csg::Numbers3 numbers_of(const Point& point);

/// Whether there is such a decimal.
bool is_short_decimal(double value);

bool is_finite(const Point& point);

/// The points as exact numbers, in one way: as decimals where all of them are
/// short, else as the doubles. Says which.
/// Requires: all are finite.
struct ExactPoints {
  std::vector<csg::Numbers3> points;
  bool decimal = false;
};
ExactPoints exact_points(std::span<const Point> points);

}  // namespace halfspace::detail
