#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "halfspace/scene.hpp"

namespace halfspace::bench {

/// Grid steps in one unit of F2B's universe, a cube of side 1000. With
/// triangles of at most size 1000 coordinates stay within 1000 units of the
/// centre, that is within 2.5 * 10^7 steps, and 26 bits hold 3.3 * 10^7.
constexpr std::int64_t kStepsPerUnit = 25'000;

/// The side of the universe. Units: F2B units.
constexpr std::int64_t kUniverse = 1000;

/// Random triangles as F2B makes them ("Experimental results").
struct RandomTriangles {
  std::int64_t size = 500;   ///< F2B's S, from 1 to 1000; F2B units
  std::int64_t count = 500;  ///< how many
  bool parallel = false;     ///< all parallel to the plane z = 0
  std::uint64_t seed = 1;
};

/// The scene that `recipe` describes: each triangle has its centre anywhere in
/// the universe and its corners anywhere in a cube of side `size` around it.
///
/// The universe is centred on the origin. Triangles without area are drawn
/// again. Flat colours and corner colours are random.
Scene random_triangles(const RandomTriangles& recipe);

/// Closed or nearly closed surfaces of many small triangles (W4).
enum class Surface {
  kSphere,       ///< rings of latitude
  kTorus,        ///< minor radius two fifths of the major one
  kKleinBottle,  ///< the figure-8 immersion; it passes through itself
  kRock,         ///< a sphere displaced by smooth noise
};

/// A surface cut into `rings` x `sectors` cells, two triangles each (one at
/// the poles of a sphere), scaled to fill the universe.
///
/// Corner colours follow the position, so that neighbours agree on them.
/// Requires: rings >= 3 and sectors >= 3.
Scene surface_mesh(Surface surface, std::int32_t rings, std::int32_t sectors,
                   std::uint64_t seed);

/// The scene with its coordinates, in F2B units, rounded to floats as files
/// hold them, and these to a grid of 26, 40 or 54 bits; the unit is that of
/// the finest steps that reach 1024 F2B units. Polygons whose corners then lie
/// on one line go.
/// Requires: a scene of triangles by this file.
Scene in_floats(const Scene& scene, int grid_bits);

/// Collects polygons and makes them a scene, of the 26-bit grid by default. For
/// scenes made by code, which are valid unless the code is wrong: asserts it.
class SceneMaker {
 public:
  VertexId vertex(const GridPoint& p);
  void polygon(const std::vector<VertexId>& corners, Rgb color);
  /// As `polygon`, with a colour a corner.
  void triangle(const VertexId (&corners)[3], const Rgb (&corner_colors)[3]);
  Scene scene(Unit unit = {}, int grid_bits = 26) &&;

 private:
  SceneData data_;
};

/// A colour that depends on `key` alone, none of its channels dark.
Rgb color_of(std::uint64_t key);

}  // namespace halfspace::bench
