#pragma once

#include <cstdint>
#include <utility>

#include "halfspace/fast/boolean.hpp"
#include "halfspace/fast/to_mesh.hpp"
#include "lattice.hpp"

namespace halfspace::fast {

using lattice::Cubes;

inline Cubes block(int first, int last, int up_to) {
  Cubes cubes;
  for (int i = first; i < last; ++i) {
    for (int j = first; j < last; ++j) {
      for (int k = first; k < up_to; ++k)
        cubes.full[static_cast<std::size_t>(
            (i * lattice::kSize + j) * lattice::kSize + k)] = true;
    }
  }
  return cubes;
}

/// Adds the surface of some cubes to a solid's, turned inside out if asked for.
inline void add_surface(const Cubes& cubes, bool turned, bool in_least_faces,
                        Solid& solid) {
  Solid more = to_solid(lattice::surface(cubes), solid);
  if (in_least_faces) more = merge_faces(more, Merge::kPlane);
  if (turned) more = complement(std::move(more));
  const auto edges = static_cast<std::uint32_t>(solid.edges.size());
  solid.edges.insert(solid.edges.end(), more.edges.begin(), more.edges.end());
  for (Face face : more.faces) {
    face.first_edge += edges;
    solid.faces.push_back(face);
  }
}

/// The surfaces of two heaps of cubes, each in as few faces as possible, as if
/// they were one solid's.
inline Solid both_surfaces(const Cubes& a, const Cubes& b) {
  Solid both = merge_faces(to_solid(lattice::surface(a)), Merge::kPlane);
  add_surface(b, false, true, both);
  return both;
}

}  // namespace halfspace::fast
