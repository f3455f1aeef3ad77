#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "halfspace/fast/solid.hpp"

namespace halfspace::fast {

/// Which faces of a solid are to be one, and the edges between them, which are
/// dropped: those that just two faces share which may be one.
class CoplanarGroups {
 public:
  /// Requires: the solid's edges are in line.
  CoplanarGroups(const Solid& solid, Merge rule);

  /// Whether the face is one with others, or with itself: it has dropped edges.
  bool merges(std::size_t face) const { return merges_[face] != 0; }
  bool is_dropped(std::size_t edge) const { return dropped_[edge] != 0; }
  /// The first of the faces that are one with this one.
  std::int32_t first_of(std::int32_t face) { return sets_.root(face); }

 private:
  DisjointSets sets_;                  ///< of faces
  std::vector<std::uint8_t> merges_;   ///< by face
  std::vector<std::uint8_t> dropped_;  ///< by edge
};

}  // namespace halfspace::fast
