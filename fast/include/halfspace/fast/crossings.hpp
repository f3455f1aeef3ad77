#pragma once

#include <cstdint>
#include <vector>

#include "halfspace/fast/solid.hpp"

namespace halfspace::fast {

/// Two faces of one solid that have more in common than a solid allows (S6.2):
/// they cross each other's interior, or overlap in one plane.
struct Crossing {
  std::int32_t first = 0;
  std::int32_t second = 0;
  std::int32_t vertex = 0;  ///< where it begins
  bool in_plane = false;
  friend bool operator==(const Crossing&, const Crossing&) = default;
};

/// The crossings of the solid's faces, by the lower face and then the other.
/// Empty: its surface does not cross itself, which booleans require, unless it
/// does so just where the edges of all the faces there are. check_operand()
/// finds that, too.
///
/// Exact: yes.
std::vector<Crossing> crossings(const Solid& solid);

}  // namespace halfspace::fast
