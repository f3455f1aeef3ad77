#include "halfspace/ref/winding.hpp"

#include <algorithm>
#include <initializer_list>
#include <utility>

#include "halfspace/ref/boolean.hpp"
#include "halfspace/ref/split.hpp"
#include "vector.hpp"

namespace halfspace::ref {
namespace {

/// The value of an affine function at p + e n + e^2 y + e^3 z, for an
/// infinitely small e > 0, by its coefficients: the sign is that of the first
/// one that is not 0.
struct Beside {
  Rational at, along, y, z;
};

int sign(const Beside& value) {
  for (const Rational* part : {&value.at, &value.along, &value.y, &value.z}) {
    if (sign(*part) != 0) return sign(*part);
  }
  return 0;
}

Beside beside(const Plane& plane, const Point& p, const Plane& normal) {
  return {value_at(plane, p), dot(normal_of(plane), normal_of(normal)), plane.b,
          plane.c};
}

/// The plane through edge `k` of the face along its normal, positive where the
/// face is.
Plane edge_plane(const Face& face, std::size_t k) {
  const Point& p = face.vertices[k];
  const Point& q = face.vertices[(k + 1) % face.vertices.size()];
  return plane_through(cross(normal_of(face.plane), difference(q, p)), p);
}

bool are_coplanar(const Face& face, const Plane& plane) {
  return std::all_of(
      face.vertices.begin(), face.vertices.end(),
      [&](const Point& p) { return sign(value_at(plane, p)) == 0; });
}

/// Whether the point, which lies in the face's plane, is in its interior.
bool holds(const Face& face, const Point& p) {
  for (std::size_t k = 0; k < face.vertices.size(); ++k) {
    if (sign(value_at(edge_plane(face, k), p)) <= 0) return false;
  }
  return true;
}

Point centroid(const std::vector<Point>& vertices) {
  Point sum{0, 0, 0};
  for (const Point& v : vertices) sum = {sum.x + v.x, sum.y + v.y, sum.z + v.z};
  const Rational count(static_cast<int>(vertices.size()));
  return {sum.x / count, sum.y / count, sum.z / count};
}

/// The fragments of the face that no other face crosses, touches from either
/// side along a line, or overlaps in part.
std::vector<Fragment> uniform_parts(const Solid& solid, PolygonId id,
                                    const BspTree& tree) {
  const Plane& plane = solid.faces[static_cast<std::size_t>(id)].plane;
  // Step 1: cut it along the edges of the faces in its plane.
  std::vector<Fragment> whole_parts = {whole(solid, id)};
  for (const Face& other : solid.faces) {
    if (!are_coplanar(other, plane)) continue;
    for (std::size_t k = 0; k < other.vertices.size(); ++k) {
      const Plane edge = edge_plane(other, k);
      std::vector<Fragment> cut;
      for (Fragment& part : whole_parts) {
        if (relation(part, edge) != Relation::kSpanning) {
          cut.push_back(std::move(part));
          continue;
        }
        SplitResult both = split(part, edge, id);
        cut.push_back(std::move(both.positive));
        cut.push_back(std::move(both.negative));
      }
      whole_parts = std::move(cut);
    }
  }
  // Step 2: down the tree of all faces, on both sides of its plane.
  std::vector<Fragment> parts;
  for (Fragment& part : whole_parts) {
    for (Classified& uniform : classify(tree, std::move(part), plane))
      parts.push_back(std::move(uniform.fragment));
  }
  return parts;
}

}  // namespace

int winding_beside(const Solid& solid, const Point& p, const Plane& plane) {
  // A ray along the x axis from beside p. Leaving the surface counts 1.
  int count = 0;
  for (const Face& face : solid.faces) {
    const Rational& a = face.plane.a;
    const Beside h = beside(face.plane, p, plane);
    // The plane is ahead where its value rises to 0 along the ray, or falls.
    if (sign(a) == 0 || sign(a) * sign(h) >= 0) continue;
    bool met = true;
    for (std::size_t k = 0; k < face.vertices.size() && met; ++k) {
      // The value of the edge's plane where the ray meets the face's, times a.
      const Plane edge = edge_plane(face, k);
      const Beside q = beside(edge, p, plane);
      const Beside there{a * q.at - edge.a * h.at,
                         a * q.along - edge.a * h.along, a * q.y - edge.a * h.y,
                         a * q.z - edge.a * h.z};
      met = sign(a) * sign(there) > 0;
    }
    if (met) count += sign(a);
  }
  return count;
}

bool is_solid(const Solid& solid, const BuildOptions& options) {
  const BspTree tree = build(solid, options);
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    const Plane& plane = solid.faces[f].plane;
    const Plane turned{-plane.a, -plane.b, -plane.c, -plane.d};
    for (const Fragment& part :
         uniform_parts(solid, static_cast<PolygonId>(f), tree)) {
      const Point p = centroid(part.vertices);
      if (winding_beside(solid, p, plane) != 0 ||
          winding_beside(solid, p, turned) != 1)
        return false;
    }
  }
  return true;
}

Solid resolve(const Solid& solid, const BuildOptions& options) {
  const BspTree tree = build(solid, options);
  Solid result;
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    const auto id = static_cast<PolygonId>(f);
    const Face& face = solid.faces[f];
    const Plane turned{-face.plane.a, -face.plane.b, -face.plane.c,
                       -face.plane.d};
    for (Fragment& part : uniform_parts(solid, id, tree)) {
      const Point p = centroid(part.vertices);
      if (winding_beside(solid, p, face.plane) > 0 ||
          winding_beside(solid, p, turned) < 1)
        continue;
      const auto first = std::find_if(
          solid.faces.begin(), solid.faces.end(), [&](const Face& other) {
            return are_coplanar(other, face.plane) &&
                   same_direction(other.plane, face.plane) && holds(other, p);
          });
      if (&*first == &face)
        result.faces.push_back(
            {face.plane, std::move(part.vertices), face.color, true, id});
    }
  }
  close_junctions(result);
  return result;
}

}  // namespace halfspace::ref
