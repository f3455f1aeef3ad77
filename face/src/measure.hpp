#pragma once

#include <array>
#include <optional>
#include <string>

#include "halfspace/fast/solid.hpp"
#include "halfspace/solid.hpp"

namespace halfspace::detail {

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

/// The box of the vertices, to the nearest doubles. Requires: not empty.
Bounds bounds_of(const fast::Solid& solid);

}  // namespace halfspace::detail
