#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "booleans/models.hpp"

namespace halfspace::bench {

/// A task for everyone: the first operand, and with each of the others in turn
/// the boolean.
struct BooleanCase {
  std::string name;
  BooleanOp operation;
  std::vector<Triangles> operands;
  /// How many triangles the least surface has; 0: not known.
  std::size_t least = 0;
  /// How often we are timed, and how often others are.
  int repeats = 5;
  int repeats_of_others = 3;
  /// Whether corefinement finishes within minutes and memory, and whether Nef
  /// polyhedra, which are slower by far, do.
  bool for_corefinement = true;
  bool for_nef = false;
};

/// Two spheres of about `triangles` each in general position, one apart by
/// half a radius; `turn`: with the same centre instead, one turned by so much.
BooleanCase two_spheres(int triangles, double turn);
BooleanCase menger(int level);
/// A plate with 10 x 10 round holes as high as itself.
BooleanCase plate();
/// Spheres of 224 triangles along a spiral, each overlapping the next.
BooleanCase sphere_chain(int count);
/// Pyramids over one square, with tips here and there: all share that face.
BooleanCase shared_face(int count);

std::vector<BooleanCase> boolean_cases();

}  // namespace halfspace::bench
