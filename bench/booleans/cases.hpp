#pragma once

#include <cstddef>
#include <cstdint>
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
/// it. The seed chooses where to, and the axis; 0: those of the tables.
/// Units: radians.
BooleanCase two_spheres(int triangles, double turn, std::uint64_t seed = 0);
/// A sphere with itself.
BooleanCase same_sphere(int triangles, BooleanOp operation);
BooleanCase menger(int level);
/// A plate less 10 x 10 round prisms, of its own height or of more.
BooleanCase plate(bool is_flush = true);
/// Spheres of 224 triangles along a spiral, each overlapping the next.
BooleanCase sphere_chain(int count);
/// Pyramids over one square with tips in different places: all share a face.
BooleanCase shared_face(int count);

std::vector<BooleanCase> boolean_cases(std::uint64_t seed = 0);

/// The surface moved by a tenth of its size; or, where `turn` is not 0, turned
/// by it about its middle. The seed chooses direction and axis. Units: radians.
Triangles moved(Triangles surface, double turn, std::uint64_t seed);

/// The case with coordinates as files have them: scaled and shifted by what the
/// seed chooses, rounded to floats, and those rounded to a grid of so many
/// bits. Equal coordinates stay equal, so that what is upright and flush stays
/// so.
BooleanCase in_floats(BooleanCase task, int grid_bits, std::uint64_t seed);

}  // namespace halfspace::bench
