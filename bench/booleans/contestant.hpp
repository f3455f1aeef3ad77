#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "booleans/cases.hpp"

namespace halfspace::bench {

/// The result of one run of a case, and its cost.
struct Outcome {
  double import_ms = 0;  ///< from triangles to the library's structures
  double boolean_ms = 0;
  double output_ms = 0;       ///< from the result to triangles
  std::size_t triangles = 0;  ///< of the output
  bool closed = false;
  /// Six times the volume. Units: cubic grid steps.
  double volume6 = 0;
  double total_ms() const { return import_ms + boolean_ms + output_ms; }
};

/// A library that computes booleans, in one way of using it.
struct Contestant {
  std::string name;
  /// Runs the case once; nothing where the library refuses it.
  std::optional<Outcome> (*run)(const BooleanCase& task);
  /// Whether the case is run at all.
  bool (*takes)(const BooleanCase& task);
  /// How far its volume may be from the first one's, as a share of the first
  /// operand's: doubles round, and some libraries move points.
  double volume_error = 1e-9;
};

/// fast::Chain, one operand after the other; fast::boolean of just two.
Contestant ours_in_turn();
/// fast::boolean_all, all operands at once, where there are more than two.
Contestant ours_at_once();
/// Both with operands that are checked, as the program does.
Contestant ours_checked();
Contestant ours_at_once_checked();
/// Manifold, one operand after the other, in one thread
/// (HALFSPACE_BENCH_MANIFOLD).
Contestant manifold_in_turn();
/// Manifold, all operands at once, where there are more than two.
Contestant manifold_in_batch();
/// CGAL's corefinement with its exact kernel (HALFSPACE_BENCH_CGAL).
Contestant cgal();
/// CGAL's Nef polyhedra, with the same kernel (HALFSPACE_BENCH_CGAL).
Contestant cgal_nef();

}  // namespace halfspace::bench
