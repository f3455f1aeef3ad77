#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "halfspace/boolean.hpp"
#include "halfspace/fast/solid.hpp"

/// Solids of unit cubes: what their booleans are is counted cube by cube.
namespace halfspace::lattice {

constexpr int kSize = 8;

/// Which cubes of a block there are.
struct Cubes {
  std::array<bool, kSize * kSize * kSize> full{};
  bool at(int i, int j, int k) const;
};

/// Random cubes, from few to many, in lumps of `lump` a side.
Cubes random_cubes(int lump, std::uint64_t& state);

/// The surface in unit squares.
GridSolid surface(const Cubes& cubes);

/// The outlines of a surface's faces: for each grid step in each plane, and
/// each way that a face may look, how often it is gone forwards rather than
/// backwards. A flat list, for it is compared a million times.
using Outline = std::vector<std::int8_t>;

Outline outline(const Cubes& cubes);
/// Likewise. Empty, with `whole` false, if something is not on the block's
/// grid.
Outline outline(const fast::Solid& solid, bool& whole);

/// Whether no vertex lies within an edge, and at every vertex something turns.
bool is_least(const fast::Solid& solid);

}  // namespace halfspace::lattice
