#pragma once

#include <optional>

#include "halfspace/io/number.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::csg {

using io::Integer;

/// The double next to numerator / denominator; ties to even.
/// Requires: denominator > 0. Exact: correctly rounded, but for subnormals.
double nearest_double(const Integer& numerator, const Integer& denominator);

/// A number that is known to within `radius`: (middle +- radius) / 2^bits.
struct Interval {
  Integer middle = 0;
  Integer radius = 0;
};

/// Arithmetic with intervals of some number of bits after the point.
class IntervalArithmetic {
 public:
  explicit IntervalArithmetic(unsigned bits) : bits_(bits) {}

  Interval quotient(const Integer& numerator, const Integer& denominator) const;
  Interval integer(const Integer& value) const { return {value << bits_, 0}; }
  Interval product(const Interval& a, const Interval& b) const;
  Interval divided(const Interval& a, const Integer& by) const;
  /// Requires: 0 is not in b.
  Interval divided(const Interval& a, const Interval& b) const;
  Interval root(const Integer& value) const;
  bool holds_zero(const Interval& a) const { return abs(a.middle) <= a.radius; }

  /// The double next to a * numerator / denominator, if the interval leaves no
  /// doubt which one it is.
  std::optional<double> nearest(const Interval& a, const Integer& numerator,
                                const Integer& denominator) const;

 private:
  unsigned bits_;
};

inline Interval operator+(const Interval& a, const Interval& b) {
  return {a.middle + b.middle, a.radius + b.radius};
}
inline Interval operator-(const Interval& a, const Interval& b) {
  return {a.middle - b.middle, a.radius + b.radius};
}

/// unit^power as a fraction.
struct Scale {
  Integer numerator = 1;
  Integer denominator = 1;
};
Scale scale_of(const Unit& unit, int power);

}  // namespace halfspace::csg
