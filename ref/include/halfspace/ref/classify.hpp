#pragma once

#include <vector>

#include "halfspace/boolean.hpp"
#include "halfspace/ref/build.hpp"

namespace halfspace::ref {

/// A convex polygon of a solid's surface.
struct Face {
  /// The plane of the polygon that it came from in the first place, turned over
  /// wherever a boolean flipped the face; never computed from the vertices.
  Plane plane;
  std::vector<Point> vertices;  ///< straight corners are allowed
  Rgb color;
  /// Where the face came from: which operand of the last boolean, and which of
  /// that operand's faces. In a solid that no boolean made, itself.
  bool from_first = true;
  PolygonId source = 0;
};

/// A solid with rational vertices, faces outwards (S6.2).
///
/// Requires: closed (bad_edges() is empty); no two faces cross or overlap.
struct Solid {
  std::vector<Face> faces;
};

/// The same solid, its vertices as rationals. Face `p` is polygon `p`.
Solid to_solid(const GridSolid& solid);

/// Face number `id` as a fragment, uncut, with that number as its source.
Fragment whole(const Solid& solid, PolygonId id);

/// The tree of the solid's faces (S3.5).
BspTree build(const Solid& solid, const BuildOptions& options);

/// A fragment, and where it is against a solid.
struct Classified {
  Fragment fragment;
  SolidClass solid_class = SolidClass::kOutside;
};

/// Cuts `polygon`, which lies in `plane`, into fragments that are each of one
/// class against the solid whose tree is `tree` (S6.3; CSG "Boolean operations
/// on polygonal models"; E3). No recursion.
///
/// Requires: the faces of the tree's solid face outwards.
/// Shape:    the fragments make up the polygon, without overlap.
/// Exact:    yes.
std::vector<Classified> classify(const BspTree& tree, Fragment polygon,
                                 const Plane& plane);

}  // namespace halfspace::ref
