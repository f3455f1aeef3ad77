#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <string>

#include "halfspace/fast/rounded_mesh.hpp"
#include "halfspace/fast/solid.hpp"

/// Solids that are hard to round, and whether what came of it is a solid's
/// surface.
namespace halfspace::fast::shapes {

/// A rotation, and a shift in grid steps.
struct Motion {
  std::array<std::array<double, 3>, 3> rotation{
      {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  std::array<double, 3> shift{};
};

/// A turn about a random axis by an angle in radians.
Motion turned(std::mt19937_64& random, double angle);
/// Turns about the three axes, one after another, by the same angle.
Motion turned_about_each_axis(double angle);

/// A box between two corners, moved; a solid of the grid of 54 bits, in the
/// table of `with` if there is one.
Solid box(const std::array<double, 3>& low, const std::array<double, 3>& high,
          const Motion& motion, const Solid* with = nullptr);

/// A sphere of triangles about the origin, moved.
Solid sphere(double radius, int stacks, int slices, const Motion& motion,
             const Solid* with = nullptr);

/// What keeps the mesh from being a solid's surface in numbers of the file; ""
/// if nothing does. Looks at all of it, by what operands of booleans are
/// checked with.
std::string fault_of(const RoundedMesh& mesh, FileNumber number);

/// Six times the volume that it winds round, about.
double volume_of(const RoundedMesh& mesh);

}  // namespace halfspace::fast::shapes
