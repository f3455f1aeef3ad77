#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "halfspace/csg/plan.hpp"

/// What a script of booleans says of points, and what its plan does.
namespace halfspace::fuzz {

/// Which of 24 points, and of 8 directions in which things are far away, are
/// in a solid: a bit for each.
using Mask = std::uint32_t;
constexpr std::size_t kNearPoints = 24;
constexpr Mask kNear = (Mask{1} << kNearPoints) - 1;

/// Twice the coordinates of a near point: it is the centre of a unit cube.
std::array<std::int64_t, 3> twice_near_point(std::size_t k);

/// A box with corners on the grid, what is below `high` in it.
struct Box {
  std::array<std::int64_t, 3> low;
  std::array<std::int64_t, 3> high;
};

/// What a file holds, by the first letter of its name.
Box box_of(const csg::File& file);

/// What a script says, node by node: nothing is put together before. Nothing
/// where that would take long.
std::optional<Mask> mask_of(const csg::Script& script);

/// What a plan of the script does.
/// Requires: mask_of(script) is something.
Mask mask_of(const csg::Script& script, const csg::Plan& plan);

}  // namespace halfspace::fuzz
