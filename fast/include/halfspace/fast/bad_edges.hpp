#pragma once

#include <cstdint>
#include <vector>

#include "halfspace/fast/solid.hpp"

namespace halfspace::fast {

/// An edge that keeps a surface from being closed: as halfspace::BadEdge, with
/// points by their ids (S6.1).
struct BadEdge {
  std::int32_t from = 0;
  std::int32_t to = 0;
  std::int64_t excess = 0;
  friend bool operator==(const BadEdge&, const BadEdge&) = default;
};

/// The edges of the solid that are not used equally often in each direction,
/// in the order of their ends' ids. Empty: closed and consistently oriented.
std::vector<BadEdge> bad_edges(const Solid& solid);

/// The faces whose edges form no loops: at some vertex more or fewer of them
/// end than begin. If this and bad_edges() are empty, the surface is closed and
/// each of its faces has a closed boundary. In the order of their numbers.
std::vector<std::int32_t> open_faces(const Solid& solid);

}  // namespace halfspace::fast
