#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include "booleans/contestant.hpp"

namespace halfspace::bench {

using CgalKernel = CGAL::Exact_predicates_exact_constructions_kernel;
using CgalMesh = CGAL::Surface_mesh<CgalKernel::Point_3>;

CgalMesh mesh_of(const Triangles& triangles);

/// Fills in what the outcome says of the output, once the mesh's points have
/// been rounded, which is timed: from `start` on.
/// Requires: a mesh of triangles without garbage.
void add_output(const CgalMesh& mesh, double start, Outcome& outcome);

}  // namespace halfspace::bench
