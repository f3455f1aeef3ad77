#pragma once

#include <cstddef>
#include <vector>

#include "halfspace/polygon.hpp"
#include "halfspace/scene.hpp"

/// From small integers, drawn at random, to scenes. Every list of integers
/// means some scene, so nothing is drawn in vain and everything shrinks.
namespace halfspace::generate {

/// What is added to a scene.
enum class ShapeKind {
  kTriangle,        ///< three points
  kParallelogram,   ///< a corner and two vectors
  kStraightCorner,  ///< a hexagon with corners of 180 degrees
  kCopy,            ///< an earlier polygon again, turned over or not
  kInPlane,         ///< a triangle in the plane of an earlier polygon
  kOnEdge,  ///< a triangle on an edge, or part of one, of an earlier one
  kSliver,
  kBox,    ///< the six faces of a box
  kCubes,  ///< the surface of some of 2 x 2 x 2 cubes
  kTetrahedron,
  kPinwheel,  ///< 3 to 8 bars, each before the next
  kRings,     ///< two square rings, one through the other
};

/// One step in making a scene.
struct Shape {
  ShapeKind kind = ShapeKind::kTriangle;
  int other = 0;             ///< which earlier polygon, modulo their number
  std::vector<int> numbers;  ///< nine, from -4 to 4
};

/// Polygons by their corners.
using Polygons = std::vector<std::vector<GridPoint>>;

/// Adds the shape to the polygons. One without area adds nothing.
void add(const Shape& shape, Polygons& polygons);

/// How a scene is stretched.
enum class Stretch { kNone, k26, k40, k54 };

/// What a scene consists of.
struct SceneRecipe {
  std::vector<Shape> shapes;
  Stretch stretch = Stretch::kNone;
  bool jitter = false;  ///< then triangles move by single grid steps
  bool corner_colors = false;
  std::size_t most_polygons = 1000;  ///< what is more is left out
};

/// A scene, and by how much it was stretched.
struct MadeScene {
  Scene scene;
  std::int64_t scale = 1;
};

/// The scene of the polygons; those that are not valid are left out.
MadeScene make(const SceneRecipe& recipe);

/// The scene of `polygons`, all of which must be valid, in one colour, on the
/// smallest grid that holds it.
Scene scene_of(const Polygons& polygons, Rgb color);

/// Whether the polygon is valid on its own (S1.3), in a grid of 54 bits.
bool is_valid(const std::vector<GridPoint>& polygon);

}  // namespace halfspace::generate
