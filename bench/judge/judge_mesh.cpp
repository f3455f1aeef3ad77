/// Reads mesh files by CGAL and says, a line for each, whether they are closed
/// and cross themselves: `judge_mesh FILE...`. Exit status 1 if one is at
/// fault.
///
/// Numbers are doubles as CGAL reads them, predicates are exact. Surfaces may
/// touch themselves. Pairs of triangles with a corner in one place are left to
/// tools/round_trips.py.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iostream>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Face = boost::graph_traits<Mesh>::face_descriptor;

/// The polygons in fans: ours are strictly convex and planar.
std::vector<std::vector<std::size_t>> triangles_of(
    const std::vector<std::vector<std::size_t>>& polygons) {
  std::vector<std::vector<std::size_t>> triangles;
  for (const auto& polygon : polygons) {
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
      triangles.push_back({polygon[0], polygon[i], polygon[i + 1]});
  }
  return triangles;
}

/// Whether every edge is there as often in one direction as in the other.
bool is_closed(const std::vector<std::vector<std::size_t>>& triangles) {
  std::map<std::pair<std::size_t, std::size_t>, int> uses;
  for (const auto& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t from = t[i], to = t[(i + 1) % 3];
      uses[std::minmax(from, to)] += from < to ? 1 : -1;
    }
  }
  return std::all_of(uses.begin(), uses.end(),
                     [](const auto& use) { return use.second == 0; });
}

using Corners = std::array<Point, 3>;

Corners corners_of(const Mesh& mesh, Face f) {
  Corners corners;
  std::size_t i = 0;
  for (const auto v : vertices_around_face(mesh.halfedge(f), mesh))
    corners[i++] = mesh.point(v);
  return corners;
}

/// Whether corners of `a` are on both sides of the plane of `b`.
bool straddles(const Corners& a, const Corners& b) {
  bool above = false, below = false;
  for (const Point& p : a) {
    const auto side = CGAL::orientation(b[0], b[1], b[2], p);
    above = above || side == CGAL::POSITIVE;
    below = below || side == CGAL::NEGATIVE;
  }
  return above && below;
}

/// Whether two triangles that meet cross: each has corners on both sides of the
/// other. Others touch, or are in one plane.
bool cross(const Corners& a, const Corners& b) {
  return straddles(a, b) && straddles(b, a);
}

bool have_corner_in_common(const Corners& a, const Corners& b) {
  return std::any_of(a.begin(), a.end(), [&](const Point& p) {
    return std::find(b.begin(), b.end(), p) != b.end();
  });
}

/// Whether two triangles that meet are in one plane, and face the same way.
bool overlap(const Corners& a, const Corners& b) {
  if (!CGAL::coplanar(a[0], a[1], a[2], b[0]) ||
      !CGAL::coplanar(a[0], a[1], a[2], b[1]) ||
      !CGAL::coplanar(a[0], a[1], a[2], b[2]))
    return false;
  const Point top = a[0] + CGAL::normal(a[0], a[1], a[2]);
  return CGAL::orientation(a[0], a[1], a[2], top) ==
         CGAL::orientation(b[0], b[1], b[2], top);
}

/// What is wrong with the file; empty: nothing.
std::string fault_of(const std::string& path) {
  std::vector<Point> points;
  std::vector<std::vector<std::size_t>> polygons;
  if (!CGAL::IO::read_polygon_soup(path, points, polygons))
    return "cannot be read";
  PMP::merge_duplicate_points_in_polygon_soup(points, polygons);
  auto triangles = triangles_of(polygons);
  for (const auto& t : triangles) {
    if (CGAL::collinear(points[t[0]], points[t[1]], points[t[2]]))
      return "has a triangle without area";
  }
  if (!is_closed(triangles)) return "is not closed";
  // Where a surface touches itself, vertices become several, and borders.
  PMP::orient_polygon_soup(points, triangles);
  if (!PMP::is_polygon_soup_a_polygon_mesh(triangles)) return "is no mesh";
  Mesh mesh;
  PMP::polygon_soup_to_polygon_mesh(points, triangles, mesh);
  std::vector<std::pair<Face, Face>> pairs;
  PMP::self_intersections(mesh, std::back_inserter(pairs));
  std::size_t crossing = 0;
  for (const auto& [f, g] : pairs) {
    const Corners a = corners_of(mesh, f), b = corners_of(mesh, g);
    if (have_corner_in_common(a, b)) continue;
    crossing += cross(a, b) || overlap(a, b) ? 1 : 0;
  }
  if (crossing > 0) return std::to_string(crossing) + " pairs cross";
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  int status = 0;
  for (int i = 1; i < argc; ++i) {
    const std::string fault = fault_of(argv[i]);
    std::cout << argv[i] << ": " << (fault.empty() ? "fine" : fault) << '\n';
    if (!fault.empty()) status = 1;
  }
  return status;
}
