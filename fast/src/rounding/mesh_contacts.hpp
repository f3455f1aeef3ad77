#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "rounding/grid_mesh.hpp"
#include "rounding/mesh_index.hpp"

namespace halfspace::fast {

/// Whether two triangles with areas have more in common than the corners and
/// the edge that they share. Triangles with three corners in common do.
bool triangles_meet(const GridMesh& mesh, const GridTriangle& a,
                    const GridTriangle& b);

/// What keeps a closed surface from being known to be a solid's.
struct MeshContacts {
  /// Triangles that meet besides at what they share, in ascending order.
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  /// Triangles at an edge round which entries and exits do not alternate.
  std::vector<std::int32_t> at_edges;
  /// A triangle of each part that may have a winding number other than 0 in
  /// front of it.
  std::vector<std::int32_t> in_parts;

  bool empty() const {
    return pairs.empty() && at_edges.empty() && in_parts.empty();
  }
  /// Calls `found(triangle)` for all of them, some more than once.
  template <class Found>
  void for_triangles(Found&& found) const {
    for (const auto& [first, second] : pairs) {
      found(first);
      found(second);
    }
    for (const std::int32_t t : at_edges) found(t);
    for (const std::int32_t t : in_parts) found(t);
  }
  std::size_t size() const {
    return pairs.size() + at_edges.size() + in_parts.size();
  }
};

/// Looks for contacts of triangles with moved corners with any others, and at
/// winding numbers if there are any such triangles. Nothing found: it is the
/// surface of a solid (S6.6). Something found: it may be one yet, as one that
/// touches itself is.
///
/// `index`: of the mesh, or empty; then boxes are looked up in a tree of those
///          that moved.
///
/// Requires: of triangles with areas; those without moved corners have no such
///           contacts with each other. What else but pairs is found is right
///           for surfaces that are closed, edge by edge.
MeshContacts contacts_of(const GridMesh& mesh, int threads,
                         const MeshIndex& index = {});

/// The same, where triangles met, and only points that are marked here were
/// moved since.
///
/// `before`: what contacts_of() found then, all pairs among it.
/// `index`:  of the mesh as it is now, not empty.
MeshContacts contacts_after(const MeshContacts& before, const GridMesh& mesh,
                            const std::vector<std::uint8_t>& changed,
                            int threads, const MeshIndex& index);

/// Whether every edge is used as often in one direction as in the other.
bool is_closed(const GridMesh& mesh);

/// How many parts of the surface hang together along edges.
std::size_t part_count(const GridMesh& mesh);

}  // namespace halfspace::fast
