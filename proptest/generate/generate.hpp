#pragma once

#include <rapidcheck.h>

#include <ostream>
#include <set>
#include <string>
#include <vector>

#include "halfspace/boolean.hpp"
#include "halfspace/scene_file.hpp"
#include "halfspace/span.hpp"

namespace halfspace {

/// How RapidCheck shows a counterexample.
void showValue(const SceneFile& view, std::ostream& out);

/// Generators, each named for the trouble it makes. Coordinates are small
/// integers, so that things coincide; some scenes are then stretched to the
/// limits of their grid. All shrink, to fewer polygons and smaller numbers.
namespace generate {

/// A scene with a camera and options. Polygons: at most 8 or so (a solid
/// counts for its faces). Image: at most 16 x 12 pixels.
using Views = rc::Gen<SceneFile>;

/// Scenes in which the polygons make the trouble.
Views coincident_polygons();  ///< in one plane, alike or turned over
Views shared_edges();         ///< meeting along whole edges and parts of them
Views slivers();              ///< very long and thin
Views nested_solids();        ///< boxes within boxes
Views touching_solids();      ///< cubes with common faces, edges and corners
Views cyclic_overlaps();      ///< pinwheels of bars and interlocked rings
Views grid_extremes();        ///< at the limits of the grids of 26, 40, 54 bits

/// Scenes in which the camera makes the trouble.
Views eye_on_splitter();
Views eye_on_edge();
Views eye_at_vertex();
Views eye_inside();
Views vertex_on_pixel_centre();
Views edge_through_pixel_centres();
Views polygons_behind_the_eye();
Views near_through_polygon();

/// All of the above in turn, and their mixtures.
Views views();

/// The subset of `troubles` that the view has; found by looking at it, not by
/// asking how it was made.
std::set<std::string> troubles_in(const SceneFile& view,
                                  const std::set<std::string>& troubles);

/// Every trouble that views() must make.
std::set<std::string> all_troubles();

/// Two solids. In a scene file of both, the first operand's polygons are black
/// and the second's are white.
struct SolidPair {
  GridSolid a;
  GridSolid b;
};
void showValue(const SolidPair& solids, std::ostream& out);

/// The two solids as one scene file, and back.
SceneFile both_of(const SolidPair& solids);
/// Requires: of `file` each operand is closed.
SolidPair solids_of(const SceneFile& file);

/// Pairs of solids: boxes, tetrahedra and heaps of cubes, nested, touching,
/// with flush faces, crossing, equal, empty; straight and sheared.
rc::Gen<SolidPair> solid_pairs();

/// Closed scenes of two to four convex parts, which may overlap, touch each
/// other anywhere, and pass through each other along edges, at vertices and in
/// parts of faces. The red of a polygon's colour is the number of its part.
rc::Gen<SceneFile> soups();

/// Sorted runs of pixels without overlap, as a mask: bit i is pixel i.
std::vector<Span> spans_of(std::uint64_t mask);
std::uint64_t mask_of(const std::vector<Span>& spans);

/// Object and unlit pixels of a line of 64.
struct Line {
  std::uint64_t objects = 0;
  std::uint64_t unlit = 0;
};
void showValue(const Line& line, std::ostream& out);

/// Lines in whose merges each of the eight cases is at least a twentieth of
/// the steps, whatever the size.
rc::Gen<Line> dense_lines();    ///< three pixels of four
rc::Gen<Line> lines_of_runs();  ///< runs of 1 to 6 pixels with gaps of one
rc::Gen<Line> lines_with_common_ends();  ///< ends are shared by both

/// All of the above in turn.
rc::Gen<Line> lines();

}  // namespace generate
}  // namespace halfspace
