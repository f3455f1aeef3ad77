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
};

/// fast::Chain, one operand after the other; fast::boolean of just two.
Contestant ours_in_turn();
/// fast::boolean_all, all operands at once, where there are more than two.
Contestant ours_at_once();
/// CGAL's corefinement with its exact kernel (HALFSPACE_BENCH_CGAL).
Contestant cgal();
/// CGAL's Nef polyhedra, with the same kernel (HALFSPACE_BENCH_CGAL).
Contestant cgal_nef();

}  // namespace halfspace::bench
