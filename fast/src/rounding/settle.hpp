#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "rounding/file_grid.hpp"
#include "rounding/grid_mesh.hpp"
#include "rounding/mesh_contacts.hpp"
#include "rounding/snap.hpp"

namespace halfspace::fast {

/// A closed surface of which some points are not on the grid yet.
struct LooseMesh {
  GridMesh mesh;
  std::vector<LoosePoint> loose;
  double error = 0;  ///< of the loose points' places. Units: steps
};

/// How settle() ended.
enum class Settling : std::uint8_t {
  kDone,
  kOpen,   ///< the surface was open, or crossed itself, to begin with
  kNoEnd,  ///< no rounding was found that does not cross itself
};

/// A surface whose points are on the grid, and which is a solid's.
struct Settled {
  Settling end = Settling::kDone;
  GridMesh mesh;
  /// No point of it is farther from the surface that was. Units: steps
  double max_move = 0;
  GridPoint farthest;  ///< what was moved farthest, in one round
  GridPoint contact;   ///< where the last surface crossed itself
  std::size_t rounds = 0;
  std::size_t first_contacts = 0;
  bool collapsed = false;  ///< something fell together, or met
};

/// Rounds the loose points of a closed surface, and whatever that makes meet,
/// until it is the surface of a solid (S6.8).
///
/// Requires: what has no loose corners does not cross itself.
/// Cost:   n log n where rounding makes no contact; else of resolve(), for each
///         round.
Settled settle(const LooseMesh& start, const FileGrid& grid, int threads);

}  // namespace halfspace::fast
