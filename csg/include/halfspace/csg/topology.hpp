#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "halfspace/fast/solid.hpp"
#include "halfspace/fast/to_mesh.hpp"

namespace halfspace::csg {

/// What a surface is like as a whole: its connected parts, and the handles of
/// all of them.
struct Topology {
  std::size_t shells = 0;
  std::int64_t genus = 0;
};

/// Exact: yes. Where more than two faces meet at an edge, those that bound one
/// wedge of the solid go on into each other.
/// Source: the formula of Euler and Poincare; radial order as in Weiler's
/// radial
///         edge structure.
Topology topology_of(const fast::Solid& solid);

/// The connected part of the surface that each triangle of its mesh is in, in
/// the same sense, numbered by their first triangles.
/// Requires: `triangles` is that mesh, all triangles.
std::vector<std::size_t> shells_of(const fast::Solid& solid,
                                   const fast::ExportedMesh& triangles);

}  // namespace halfspace::csg
