#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <cstdint>
#include <vector>

#include "halfspace/bsp_tree.hpp"
#include "halfspace/camera.hpp"
#include "halfspace/image.hpp"
#include "halfspace/plane.hpp"
#include "halfspace/scene.hpp"

/// The definitions of S1 to S6 a second time, for the tests alone: integers
/// and homogeneous coordinates instead of rationals, pixel by pixel instead of
/// line by line. It shares no code with the implementations it judges.
namespace halfspace::definition {

/// Of any size; up to 512 bits, which most have, without memory from the heap.
using IntegerBackend = boost::multiprecision::cpp_int_backend<512>;
using Integer = boost::multiprecision::number<IntegerBackend,
                                              boost::multiprecision::et_off>;
using Fraction = boost::multiprecision::number<
    boost::multiprecision::rational_adaptor<IntegerBackend>,
    boost::multiprecision::et_off>;

/// The oriented plane a x + b y + c z + d (S1.4).
struct Plane {
  Integer a, b, c, d;
};

/// The point (x, y, z) / w, with w > 0.
struct Point {
  Integer x, y, z, w = 1;
};

/// Whether they are the same point, whatever their w.
bool operator==(const Point& p, const Point& q);

/// A convex polygon: where `support` is 0 and no edge plane is negative.
struct Facet {
  Plane support;
  std::vector<Plane> edges;
};

Point to_point(const GridPoint& p);

/// The plane of a polygon (S1.4), from its area vector.
Plane plane_of(const Scene& scene, PolygonId polygon);

/// -1, 0 or 1: the side of the plane that holds the point (S1.5).
int side_of(const Plane& plane, const Point& p);

/// -1, 0 or 1: the side of the plane that holds the eye (S4.2).
int side_of_eye(const Plane& plane, const Camera& camera);

/// The signs of the points against the plane, as a relation (S2.1).
Relation relation(const std::vector<Point>& points, const Plane& plane);

/// The vertices of a fragment: between edges k - 1 and k lies vertex k (S2.2).
std::vector<Point> points_of(const Scene& scene, const FragmentName& fragment);

/// The polygon, uncut, by name.
FragmentName whole(const Scene& scene, PolygonId polygon);

/// The point set of a fragment.
Facet facet_of(const Scene& scene, const FragmentName& fragment);

/// The polygon with these vertices, counterclockwise where it is positive.
/// Requires: convex, with an area.
Facet facet_of(const std::vector<Point>& vertices);

/// The two parts of a fragment that the splitter's plane spans (S2.3).
struct Parts {
  FragmentName positive;
  FragmentName negative;
};
Parts split(const Scene& scene, const FragmentName& fragment,
            PolygonId splitter);

/// The tree of the scene (S3.5), straight from the definition of its rules.
TreeName build(const Scene& scene, const BuildOptions& options);

/// The fragments of the tree in the order of display (S3.7).
std::vector<FragmentName> back_to_front(const Scene& scene,
                                        const TreeName& tree,
                                        const Camera& camera);
std::vector<FragmentName> front_to_back(const Scene& scene,
                                        const TreeName& tree,
                                        const Camera& camera);

/// The function c + x X + y Y of image points (X, Y).
struct Affine {
  Integer c, x, y;
};

/// The sign of `f` at the sample of pixel (i, j) (S4.4).
int sign_at_sample(const Affine& f, std::int32_t i, std::int32_t j);

/// What the camera sees of a facet: nothing, or the samples at which every
/// function of `inside` is positive, at the ray parameter num / den, where den
/// is positive; num or den is constant.
struct Projection {
  bool nothing = false;
  std::vector<Affine> edges;   ///< edge by edge, positive within (S4.5)
  std::vector<Affine> inside;  ///< those, and the limits of the ray (S4.3)
  Affine num;
  Affine den;
};
Projection project(const Facet& facet, const Camera& camera, bool cull);

bool covers(const Projection& p, std::int32_t i, std::int32_t j);

/// The sign of the difference of the ray parameters at the sample (S5.3).
/// Requires: both cover the sample.
int compare_depth(const Projection& p, const Projection& q, std::int32_t i,
                  std::int32_t j);

/// The samples that the facet covers: 1, elsewhere 0.
Grid2<std::uint8_t> coverage(const Facet& facet, const Camera& camera,
                             bool cull);

/// The image by polygon ids, and by colours (S5.1, S5.4).
ItemImage item_image(const Scene& scene, const Camera& camera,
                     const ImageOptions& options);
ColorImage color_image(const Scene& scene, const Camera& camera,
                       const ImageOptions& options);

/// How often the facets wind round the point: 1 inside a closed surface that
/// faces outwards, 0 outside (S6.2).
/// Requires: the point is on no facet.
int winding(const std::vector<Facet>& facets, const Point& p);

/// Twice a vector area. Units: square grid steps.
struct Area {
  Fraction x = 0, y = 0, z = 0;
  friend bool operator==(const Area&, const Area&) = default;
};
Area operator+(const Area& a, const Area& b);

/// Twice the vector area of a polygon with these vertices.
Area area_of(const std::vector<Point>& polygon);

/// Six times the signed volume behind polygons with these vertices.
Fraction volume6(const std::vector<std::vector<Point>>& polygons);

/// Whether on every line the edges that run along it cancel, piece by piece:
/// closed in the sense of S6.1, junctions in mid-edge allowed.
bool is_closed(const std::vector<std::vector<Point>>& polygons);

}  // namespace halfspace::definition
