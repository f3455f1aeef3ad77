#include "halfspace/region.hpp"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cstdint>
#include <string>
#include <utility>

namespace halfspace {
namespace {

/// Differences of grid points have 55 bits, normals 112, and a normal times a
/// difference or a point 170.
using Wide = boost::multiprecision::int256_t;
using WideVector = std::array<Wide, 3>;

WideVector wide(const GridPoint& p) { return {p.x, p.y, p.z}; }

WideVector way(const GridPoint& from, const GridPoint& to) {
  return {Wide(to.x) - from.x, Wide(to.y) - from.y, Wide(to.z) - from.z};
}

WideVector across(const WideVector& u, const WideVector& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
          u[0] * v[1] - u[1] * v[0]};
}

Wide along(const WideVector& u, const WideVector& v) {
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

bool is_zero(const WideVector& v) {
  return v[0] == 0 && v[1] == 0 && v[2] == 0;
}

/// A face of a convex hull, and a bit for each point that is in its plane.
struct HullFace {
  RegionFace points;
  WideVector normal;  ///< inwards
  std::uint32_t in_plane = 0;
};

std::vector<HullFace> hull_faces(const std::vector<GridPoint>& points) {
  std::vector<HullFace> faces;
  const auto face_through = [&](std::size_t i, std::size_t j, std::size_t k) {
    HullFace face = {
        {points[i], points[j], points[k]},
        across(way(points[i], points[j]), way(points[i], points[k])),
        0};
    if (is_zero(face.normal)) return;
    int inside = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
      const int side = along(face.normal, way(points[i], points[p])).sign();
      if (side == 0) face.in_plane |= 1u << p;
      if (side == 0) continue;
      if (inside == -side) return;
      inside = side;
    }
    const bool is_known = std::any_of(
        faces.begin(), faces.end(),
        [&](const HullFace& other) { return other.in_plane == face.in_plane; });
    // Without a point beside the plane all lie in it.
    if (inside == 0 || is_known) return;
    if (inside < 0) {
      std::swap(face.points[1], face.points[2]);
      for (Wide& x : face.normal) x = -x;
    }
    faces.push_back(std::move(face));
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      for (std::size_t k = j + 1; k < points.size(); ++k) face_through(i, j, k);
    }
  }
  return faces;
}

/// A direction between two points of a grid.
using GridWay = GridPoint;

GridWay grid_way(const GridPoint& from, const GridPoint& to) {
  return {to.x - from.x, to.y - from.y, to.z - from.z};
}

GridPoint onwards(const GridPoint& p, const GridWay& way) {
  return {p.x + way.x, p.y + way.y, p.z + way.z};
}

/// The directions of a region's edges, where two faces meet.
std::vector<GridWay> edges_of(const std::vector<GridPoint>& points,
                              const std::vector<HullFace>& faces) {
  std::vector<GridWay> edges;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (std::size_t g = f + 1; g < faces.size(); ++g) {
      const std::uint32_t both = faces[f].in_plane & faces[g].in_plane;
      const GridPoint* first = nullptr;
      for (std::size_t p = 0; p < points.size(); ++p) {
        if ((both >> p & 1u) == 0) continue;
        if (first == nullptr) first = &points[p];
        if (points[p] == *first) continue;
        edges.push_back(grid_way(*first, points[p]));
        break;
      }
    }
  }
  return edges;
}

/// Where planes with this normal have one region on one side, and the other on
/// the other side: a point of the first on such a plane.
const GridPoint* part(const WideVector& normal, const std::vector<GridPoint>& a,
                      const std::vector<GridPoint>& b) {
  struct End {
    Wide value;
    const GridPoint* point;
  };
  const auto range = [&](const std::vector<GridPoint>& points) {
    std::array<End, 2> ends;
    ends.fill({along(normal, wide(points[0])), &points[0]});
    for (const GridPoint& p : points) {
      const Wide value = along(normal, wide(p));
      if (value < ends[0].value) ends[0] = {value, &p};
      if (value > ends[1].value) ends[1] = {value, &p};
    }
    return ends;
  };
  const auto of_a = range(a);
  const auto of_b = range(b);
  if (of_a[1].value <= of_b[0].value) return of_a[1].point;
  return of_b[1].value <= of_a[0].value ? of_a[0].point : nullptr;
}

}  // namespace

Result<ObjectRegion> hull_region(std::vector<GridPoint> points) {
  if (points.size() < 4 || points.size() > kMostHullPoints) {
    return Error{ErrorCode::kOutOfRange,
                 "a region has " + std::to_string(points.size()) +
                     " points; a hull has from 4 to 30"};
  }
  ObjectRegion region{points[0], points[0]};
  for (const GridPoint& p : points) {
    region.low = {std::min(region.low.x, p.x), std::min(region.low.y, p.y),
                  std::min(region.low.z, p.z)};
    region.high = {std::max(region.high.x, p.x), std::max(region.high.y, p.y),
                   std::max(region.high.z, p.z)};
  }
  const std::vector<HullFace> faces = hull_faces(points);
  if (faces.empty()) {
    return Error{ErrorCode::kOutOfRange,
                 "a region is empty: its points lie in one plane"};
  }
  for (const HullFace& face : faces) {
    const auto zeros = std::count(face.normal.begin(), face.normal.end(), 0);
    if (zeros < 2) region.slanted.push_back(face.points);
  }
  region.hull = std::move(points);
  return region;
}

std::vector<GridPoint> corners_of(const ObjectRegion& region) {
  if (!region.hull.empty()) return region.hull;
  std::vector<GridPoint> corners;
  for (std::size_t k = 0; k < 8; ++k) {
    corners.push_back({k & 1u ? region.high.x : region.low.x,
                       k & 2u ? region.high.y : region.low.y,
                       k & 4u ? region.high.z : region.low.z});
  }
  return corners;
}

int side_of(const RegionFace& face, const GridPoint& p) {
  return along(across(way(face[0], face[1]), way(face[0], face[2])),
               way(face[0], p))
      .sign();
}

std::optional<RegionFace> parting_plane(const ObjectRegion& a,
                                        const ObjectRegion& b) {
  const std::vector<GridPoint> of_a = corners_of(a);
  const std::vector<GridPoint> of_b = corners_of(b);
  const std::vector<HullFace> a_faces = hull_faces(of_a);
  const std::vector<HullFace> b_faces = hull_faces(of_b);
  for (const std::vector<HullFace>* faces : {&a_faces, &b_faces}) {
    for (const HullFace& face : *faces) {
      if (part(face.normal, of_a, of_b) != nullptr) return face.points;
    }
  }
  const std::vector<GridWay> b_edges = edges_of(of_b, b_faces);
  for (const GridWay& u : edges_of(of_a, a_faces)) {
    for (const GridWay& v : b_edges) {
      const WideVector normal = across(wide(u), wide(v));
      if (is_zero(normal)) continue;
      if (const GridPoint* p = part(normal, of_a, of_b))
        return RegionFace{*p, onwards(*p, u), onwards(*p, v)};
    }
  }
  return std::nullopt;
}

bool share_space(const ObjectRegion& a, const ObjectRegion& b) {
  if (a.high.x <= b.low.x || b.high.x <= a.low.x || a.high.y <= b.low.y ||
      b.high.y <= a.low.y || a.high.z <= b.low.z || b.high.z <= a.low.z)
    return false;
  if (a.hull.empty() && b.hull.empty()) return true;
  return !parting_plane(a, b);
}

}  // namespace halfspace
