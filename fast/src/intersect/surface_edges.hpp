#pragma once

#include <cstdint>
#include <vector>

#include "halfspace/fast/list.hpp"
#include "halfspace/fast/solid.hpp"

namespace halfspace::fast {

/// Which edges of a solid's faces are each other's reversals.
class SurfaceEdges {
 public:
  explicit SurfaceEdges(const Solid& solid);

  /// Whether every edge is used as often in one direction as in the other.
  bool is_closed() const { return is_closed_; }
  /// The other face at the edge, if exactly two faces have it, in opposite
  /// directions; else -1.
  std::int32_t neighbour(std::uint32_t edge) const { return neighbours_[edge]; }
  /// Calls `found(first, second)` for the faces at each edge of two.
  template <class Found>
  void for_neighbours(const Solid& solid, Found&& found) const {
    for (std::size_t f = 0; f < solid.faces.size(); ++f) {
      const Face& face = solid.faces[f];
      const auto id = static_cast<std::int32_t>(f);
      for (std::uint32_t i = 0; i < face.edge_count; ++i) {
        const std::int32_t other = neighbour(face.first_edge + i);
        if (other > id) found(id, other);
      }
    }
  }

 private:
  List<std::int32_t> neighbours_;  ///< by edge
  bool is_closed_ = true;
};

/// For each face, the first one of those that it hangs together with across
/// edges of two faces.
std::vector<std::int32_t> parts_of_surface(const Solid& solid,
                                           const SurfaceEdges& edges);

}  // namespace halfspace::fast
