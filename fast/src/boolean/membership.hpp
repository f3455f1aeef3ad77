#pragma once

#include <memory>

#include "halfspace/boolean.hpp"
#include "halfspace/fast/solid.hpp"
#include "table/geometry_table.hpp"

namespace halfspace::fast {

/// A boolean as a function of two memberships, of which the last, outside of
/// both, is false.
struct Truth {
  bool both = false;
  bool first_only = false;
  bool second_only = false;

  bool operator()(bool a, bool b) const {
    return a ? (b ? both : first_only) : b && second_only;
  }
};

constexpr Truth truth_of(BooleanOp operation) {
  switch (operation) {
    case BooleanOp::kUnion:
      return {true, true, true};
    case BooleanOp::kIntersection:
      return {true, false, false};
    case BooleanOp::kDifference:
      break;
  }
  return {false, true, false};
}

/// The solid with its points and planes in another table.
Solid moved_to(const Solid& solid, const std::shared_ptr<Space>& space);

}  // namespace halfspace::fast
