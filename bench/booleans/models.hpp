#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "halfspace/boolean.hpp"

/// Solids made in code, so that measurements can be repeated anywhere.
namespace halfspace::bench {

/// A closed surface of triangles on the grid.
struct Triangles {
  std::vector<GridPoint> points;
  std::vector<std::array<VertexId, 3>> corners;
};

/// The position of a sphere. Units: grid steps; radians.
struct Placement {
  std::array<double, 3> centre{};
  double radius = 0x1p23;
  double turn = 0;  ///< about the axis
  std::array<double, 3> axis{1, 2, 3};
};

/// The point turned about an axis through the origin. Units: radians.
std::array<double, 3> turned(const std::array<double, 3>& point, double angle,
                             const std::array<double, 3>& axis);

/// A sphere of 4 n (n - 1) triangles in n bands, every corner rounded to the
/// grid.
Triangles sphere(int bands, const Placement& placement);

/// The number of bands with which a sphere has about as many triangles.
int bands_for(int triangles);

/// The block between two corners, 12 triangles.
Triangles block(const GridPoint& low, const GridPoint& high);

/// An upright prism over a regular polygon, corners rounded to the grid.
Triangles prism(int corners, const GridPoint& base, std::int64_t radius,
                std::int64_t height);

/// The pyramid over the square with corners (0, 0, 0) and (side, side, 0).
/// Requires: the tip is above that plane.
Triangles pyramid(std::int64_t side, const GridPoint& tip);

/// The square bars that, taken away from the block from the origin to 3^level
/// on every axis, leave a Menger sponge; all times `scale`, coarse bars first.
std::vector<Triangles> menger_bars(int level, std::int64_t scale);

/// Six times the volume within, about. Units: cubic grid steps.
double volume6_of(const Triangles& triangles);

/// The surface as a valid solid of one colour.
GridSolid solid_of(const Triangles& triangles);

}  // namespace halfspace::bench
