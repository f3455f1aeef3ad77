#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <tuple>
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
Solid surface(const Cubes& cubes);

/// A directed edge of one grid step along `axis`, of a face in the plane with
/// the number `plane` along its axis, and which way the face looks.
using Step = std::tuple<int, int, bool, int, std::array<int, 3>, bool>;

/// The steps round the faces of the surface, without those that cancel.
std::vector<Step> outline(const Cubes& cubes);
/// Likewise. Empty, with `whole` false, if something is not on the grid.
std::vector<Step> outline(const fast::Solid& solid, bool& whole);

/// Whether no vertex lies within an edge, and at every vertex something turns.
bool is_least(const fast::Solid& solid);

}  // namespace halfspace::lattice
