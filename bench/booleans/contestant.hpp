#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "booleans/cases.hpp"

namespace halfspace::bench {

/// What somebody made of a case.
struct Outcome {
  double import_ms = 0;  ///< from triangles to their own structures
  double boolean_ms = 0;
  double output_ms = 0;       ///< from the result to triangles
  std::size_t triangles = 0;  ///< of the output
  bool closed = false;
  /// Six times the volume. Units: cubic grid steps.
  double volume6 = 0;
  double total_ms() const { return import_ms + boolean_ms + output_ms; }
};

/// Somebody who can do booleans.
struct Contestant {
  std::string name;
  /// Once through; nothing if they cannot do it.
  std::optional<Outcome> (*run)(const BooleanCase& task);
  /// Whether they are asked to.
  bool (*takes)(const BooleanCase& task);
};

/// fast::Chain, one operand after the other; fast::boolean of just two.
Contestant ours_in_turn();
/// fast::boolean_all, all operands at once, where there are more than two.
Contestant ours_at_once();
/// CGAL's corefinement with its exact kernel; only where it was built in.
Contestant cgal();
/// CGAL's Nef polyhedra, with the same kernel; only where they were built in.
Contestant cgal_nef();

}  // namespace halfspace::bench
