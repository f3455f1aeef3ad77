#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "halfspace/boolean.hpp"

/// Solids made in code, so that anyone can measure on the same ones.
namespace halfspace::bench {

/// A closed surface of triangles on the grid.
struct Triangles {
  std::vector<GridPoint> points;
  std::vector<std::array<VertexId, 3>> corners;
};

/// How a sphere lies. Units: grid steps; radians.
struct Placement {
  std::array<double, 3> centre{};
  double radius = 0x1p23;
  double turn = 0;  ///< about the axis (1, 2, 3)
};

/// A sphere of 4 n (n - 1) triangles: n bands of 2n triangles or pairs of
/// them, every corner rounded to the grid.
Triangles sphere(int bands, const Placement& placement);

/// The number of bands with which a sphere has about as many triangles.
int bands_for(int triangles);

/// The block between two corners, 12 triangles.
Triangles block(const GridPoint& low, const GridPoint& high);

/// An upright prism over a regular polygon, corners rounded to the grid.
Triangles prism(int corners, const GridPoint& base, std::int64_t radius,
                std::int64_t height);

/// The pyramid with the tip, over the square of that side on the plane z = 0
/// from the origin on.
/// Requires: the tip is above that plane.
Triangles pyramid(std::int64_t side, const GridPoint& tip);

/// The square bars that make a Menger sponge of the level out of a block of
/// 3^level a side, at the origin, times `scale`: coarse ones first.
std::vector<Triangles> menger_bars(int level, std::int64_t scale);

/// The same as a valid solid, of one colour.
GridSolid solid_of(const Triangles& triangles);

}  // namespace halfspace::bench
