#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "halfspace/csg/script.hpp"

namespace halfspace::csg {

/// What a solid is far away.
enum class Reach : std::uint8_t {
  kBounded,    ///< outside everywhere
  kUnbounded,  ///< inside everywhere
  kHalf,       ///< inside on one side of a plane
};

/// A file's solid, moved.
struct Leaf {
  std::int32_t file = -1;    ///< of the script's
  std::int32_t matrix = -1;  ///< of the plan's
  Place place;
};

/// A half-space, moved.
struct Plane {
  HalfSpace points;
  std::int32_t half = -1;  ///< of the script's
  Place place;
};

/// A solid on the way to the result.
struct Step {
  NodeKind kind = NodeKind::kFile;  ///< not kTransform
  std::int32_t item = -1;           ///< of the plan's leaves, planes or points
  /// What it is made of, steps before it. A difference is its first term less
  /// all others. Half-spaces come last.
  std::vector<std::int32_t> terms;
  std::size_t halves = 0;  ///< how many of the terms are half-spaces
  Reach reach = Reach::kBounded;
  std::int32_t uses = 0;  ///< how often it is a term, or the result
  Place place;
};

/// What a script comes to: its transforms have gone into the leaves, for
/// booleans do not mind them, and long unions, intersections and differences
/// are one step each, which can be done in any order that is good.
///
/// The last step is the result. The same solid moved the same way is one step.
struct Plan {
  std::vector<Step> steps;
  std::vector<Leaf> leaves;
  std::vector<Plane> planes;
  std::vector<Matrix> matrices;
  std::vector<Numbers3> points;  ///< of components, moved
  std::size_t booleans = 0;      ///< of two solids each
};

/// How many steps a plan may have before long ones are joined: each transform
/// of what is transformed already can double them.
constexpr std::size_t kMostSteps = std::size_t{1} << 20;

/// The plan of a script. No recursion.
///
/// Exact:  yes.
/// Errors: kOutOfRange (over `most_steps`; transforms within one another that
///         need too many digits); kUnbounded (the surface of a step would reach
///         infinitely far, or the result is all but a bounded part of space).
///         The message begins with the place; index is the line.
/// Cost:   n log n in the steps.
Result<Plan> make_plan(const Script& script,
                       std::size_t most_steps = kMostSteps);

}  // namespace halfspace::csg
