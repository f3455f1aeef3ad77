#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "halfspace/fast/self_intersections.hpp"
#include "intersect/surface_edges.hpp"
#include "solid/dynamic_bvh.hpp"
#include "table/shared_table.hpp"

namespace halfspace::fast {

/// Tells of most faces that are near each other that they have nothing in
/// common but vertices and edges that both have.
///
/// Two faces in different planes with a common edge, both on one side of it, or
/// a face on one side of another's plane but for common corners: that takes a
/// few signs of points against planes, or none. Triangles that share a corner,
/// and each cross the other's plane, leave it there in one direction or in two.
///
/// Threads: any; nothing is added to the table.
/// Source:  MOL97 for the intervals on the planes' common line.
class CloseFaces {
 public:
  CloseFaces(const Solid& solid, const GeometryTable& table,
             const SurfaceEdges& edges)
      : solid_(solid), table_(table), edges_(edges) {}

  /// Whether the two surely have nothing else in common, and no other face has
  /// an edge that both have.
  bool only_share_corners(std::int32_t f, std::int32_t g) const;

 private:
  /// A triangle's corners, and the sides of another one's plane they are on.
  struct Corners {
    std::array<std::int32_t, 3> at;
    std::array<int, 3> side;
  };
  const Face& face(std::int32_t f) const {
    return solid_.faces[static_cast<std::size_t>(f)];
  }
  const SolidEdge* edges_of(std::int32_t f) const {
    return solid_.edges.data() + face(f).first_edge;
  }
  bool is_triangle(std::int32_t f) const;
  bool is_beside(std::int32_t g, std::int32_t f) const;
  bool triangles_only_share(std::int32_t f, std::int32_t g) const;
  bool coplanar_only_share(std::int32_t f, const Corners& p,
                           const Corners& q) const;
  bool crossing_only_share(std::int32_t f, std::int32_t g, std::size_t shared,
                           const Corners& p, const Corners& q) const;
  bool is_apart_in_plane(std::int32_t plane, const Corners& p,
                         std::span<const std::int32_t> points) const;
  bool line_parts(int axis, std::int32_t u, std::int32_t v, int side,
                  std::span<const std::int32_t> points) const;

  const Solid& solid_;
  const GeometryTable& table_;
  const SurfaceEdges& edges_;
};

using FacePairs = std::vector<std::pair<std::int32_t, std::int32_t>>;

/// The pairs of faces with overlapping boxes for which CloseFaces does not
/// decide, in ascending order. Stops if the progress says so, with what was
/// found so far.
FacePairs undecided_pairs(const Solid& solid, const GeometryTable& table,
                          const SurfaceEdges& edges, const DynamicBvh& index,
                          const CheckOptions& options);

}  // namespace halfspace::fast
