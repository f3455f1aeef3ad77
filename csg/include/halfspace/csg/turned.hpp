#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "halfspace/polygon.hpp"

namespace halfspace::csg {

/// The polygons of a surface, faces outwards, before its vertices have places.
/// Shape: as of a mesh.
struct Faces {
  std::vector<std::uint32_t> first_corner = {0};
  std::vector<VertexId> corners;
};

/// A prism: bottom, top, sides. Vertices 0 to n - 1 are the bottom's,
/// counterclockwise as seen from above, n to 2 n - 1 the top's over them.
/// Requires: 3 <= n.
Faces prism_faces(std::uint32_t n);

/// What a point of an outline is to the axis about which that is turned.
struct TurnedPoint {
  bool is_on_axis = false;
  bool is_level = false;  ///< the next point is as high as this one
};

/// An outline turned about the z axis.
struct TurnedFaces {
  Faces faces;
  /// By vertex the point of the outline, and by how many steps it is turned.
  struct Vertex {
    std::uint32_t point = 0;
    std::uint32_t step = 0;
  };
  std::vector<Vertex> vertices;
};

/// The surface that an outline makes which is turned in `steps` equal steps.
/// Its points are in the half-plane of the axis and x, counterclockwise as seen
/// from -y, so that what is below is outwards of what goes away from the axis.
///
/// Shape: vertices point by point; of a point on the axis one, if there are
///        triangles round it. Polygons edge by edge: of one that is level and
///        comes from or goes to the axis, a single one.
/// Requires: 3 <= steps; the outline does not cross itself.
TurnedFaces turned_faces(std::span<const TurnedPoint> outline,
                         std::uint32_t steps);

}  // namespace halfspace::csg
