#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "booleans/models.hpp"

namespace halfspace::bench {

/// A fold: the boolean of the first operand with each of the others in turn.
struct BooleanCase {
  std::string name;
  BooleanOp operation;
  std::vector<Triangles> operands;
  /// The least number of triangles of the surface; 0: not known.
  std::size_t least = 0;
  /// Runs of the fast library, and of the others.
  int repeats = 5;
  int repeats_of_others = 3;
  /// Whether corefinement finishes within minutes and memory, and whether Nef
  /// polyhedra, which are much slower, do.
  bool for_corefinement = true;
  bool for_nef = false;
};

/// Two spheres of about `triangles` each in general position: shifted by half a
/// radius; or, where `turn` is not 0, with one centre, one of them turned by
/// it. Units: radians.
BooleanCase two_spheres(int triangles, double turn);
BooleanCase menger(int level);
/// A plate less 10 x 10 round prisms of its own height.
BooleanCase plate();
/// Spheres of 224 triangles along a spiral, each overlapping the next.
BooleanCase sphere_chain(int count);
/// Pyramids over one square with tips in different places: all share a face.
BooleanCase shared_face(int count);

std::vector<BooleanCase> boolean_cases();

}  // namespace halfspace::bench
