#pragma once

#include <array>
#include <optional>
#include <string>

#include "halfspace/csg/interval.hpp"
#include "halfspace/fast/solid.hpp"

namespace halfspace::csg {

/// The volume and the area of a bounded solid, to the nearest double. Units:
/// model units.
double volume_of(const fast::Solid& solid);
double area_of(const fast::Solid& solid);

/// The same in full: a decimal or a fraction; nothing where it is irrational.
std::string exact_volume_of(const fast::Solid& solid);
std::optional<std::string> exact_area_of(const fast::Solid& solid);

/// The centre of mass and the tensor of inertia about it.
/// Requires: the solid is not empty.
struct Moments {
  std::array<double, 3> centroid{};
  std::array<std::array<double, 3>, 3> inertia{};
};
Moments moments_of(const fast::Solid& solid);

/// The least and the greatest corner of the box of the vertices, to the nearest
/// doubles. Requires: not empty.
std::array<std::array<double, 3>, 2> bounds_of(const fast::Solid& solid);

/// The same in full: decimals or fractions.
std::array<std::array<std::string, 3>, 2> exact_bounds_of(
    const fast::Solid& solid);

/// -1, 0, 1: whether the volume of one is less than that of the other, as their
/// surfaces go round it: below 0 of a surface that faces inwards. Exact.
/// Requires: they are in one unit.
int compare_volumes(const fast::Solid& a, const fast::Solid& b);

/// The number: a decimal, or a fraction such as `1/3` where no decimal is it.
/// Requires: denominator > 0.
std::string text_of(const Integer& numerator, const Integer& denominator);

}  // namespace halfspace::csg
