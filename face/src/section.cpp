#include <algorithm>
#include <map>
#include <utility>

#include "halfspace/csg/interval.hpp"
#include "halfspace/csg/surface.hpp"
#include "halfspace/solid.hpp"
#include "node.hpp"

namespace halfspace {
namespace {

using csg::ExactPoint;
using csg::ExactSurface;
using csg::Integer;
using csg::Integers3;
using detail::SolidNode;

/// Takes the loops of a face apart.
class Loops {
 public:
  Loops(ExactSurface& surface, const fast::Face& face) : surface_(surface) {
    const Integers3 normal = surface.normal(face);
    axis_ = csg::longest_axis(normal);
    sign_ = normal[axis_].sign();
    csg::for_edges(surface.solid(), face, [&](const fast::SolidEdge& edge) {
      from_[edge.from].push_back(edge.to);
    });
  }
  std::vector<std::vector<std::int32_t>> loops();
  /// Twice the area of a loop, seen from outside: above 0 of boundaries.
  int orientation(const std::vector<std::int32_t>& loop);
  /// How many corners of one loop another one goes round.
  std::size_t held(const std::vector<std::int32_t>& loop,
                   const std::vector<std::int32_t>& by);

 private:
  using Direction = std::array<Integer, 2>;
  Direction direction(std::int32_t from, std::int32_t to);
  Integer cross(const Direction& a, const Direction& b) const {
    return sign_ * (a[0] * b[1] - a[1] * b[0]);
  }
  std::int32_t taken(std::int32_t before, std::int32_t at);

  ExactSurface& surface_;
  std::size_t axis_ = 0;
  int sign_ = 1;
  std::map<std::int32_t, std::vector<std::int32_t>> from_;
};

Loops::Direction Loops::direction(std::int32_t from, std::int32_t to) {
  const ExactPoint p = surface_.point(from);
  const ExactPoint& q = surface_.point(to);
  Direction result;
  for (std::size_t k = 0; k < 2; ++k) {
    const std::size_t i = (axis_ + 1 + k) % 3;
    result[k] = q.at[i] * p.below - p.at[i] * q.below;
  }
  return result;
}

/// Takes the edge that leaves a vertex along the region that the edge from
/// `before` has on its left: the first one clockwise from that.
std::int32_t Loops::taken(std::int32_t before, std::int32_t at) {
  std::vector<std::int32_t>& ends = from_[at];
  auto best = ends.begin();
  if (ends.size() > 1) {
    const Direction back = direction(at, before);
    const auto half_of = [&](const Direction& d) {
      const int side = cross(back, d).sign();
      return side < 0 ? 0 : side == 0 ? 1 : 2;
    };
    best = std::min_element(
        ends.begin(), ends.end(), [&](std::int32_t a, std::int32_t b) {
          const Direction u = direction(at, a), v = direction(at, b);
          if (half_of(u) != half_of(v)) return half_of(u) < half_of(v);
          return cross(u, v) < 0;
        });
  }
  const std::int32_t end = *best;
  ends.erase(best);
  if (ends.empty()) from_.erase(at);
  return end;
}

std::vector<std::vector<std::int32_t>> Loops::loops() {
  std::vector<std::vector<std::int32_t>> result;
  while (!from_.empty()) {
    const std::int32_t start = from_.begin()->first;
    std::vector<std::int32_t> loop = {start};
    const std::int32_t second = from_.begin()->second.front();
    from_[start].erase(from_[start].begin());
    if (from_[start].empty()) from_.erase(start);
    std::int32_t before = start;
    for (std::int32_t at = second; at != start;) {
      loop.push_back(at);
      const std::int32_t next = taken(before, at);
      before = std::exchange(at, next);
    }
    result.push_back(std::move(loop));
  }
  return result;
}

int Loops::orientation(const std::vector<std::int32_t>& loop) {
  const std::size_t u = (axis_ + 1) % 3, v = (axis_ + 2) % 3;
  Integer numerator = 0, denominator = 1;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const ExactPoint p = surface_.point(loop[i]);
    const ExactPoint& q = surface_.point(loop[(i + 1) % loop.size()]);
    const Integer below = p.below * q.below;
    numerator = numerator * below +
                (p.at[u] * q.at[v] - p.at[v] * q.at[u]) * denominator;
    denominator *= below;
    const Integer divisor = gcd(numerator, denominator);
    if (divisor != 0) {
      numerator /= divisor;
      denominator /= divisor;
    }
  }
  return sign_ * numerator.sign();
}

std::size_t Loops::held(const std::vector<std::int32_t>& loop,
                        const std::vector<std::int32_t>& by) {
  fast::Solid outline;
  outline.table = surface_.solid().table;
  for (std::size_t i = 0; i < by.size(); ++i)
    outline.edges.push_back({by[i], by[(i + 1) % by.size()], -1});
  fast::Face face;
  face.edge_count = static_cast<std::uint32_t>(by.size());
  ExactSurface surface(outline);
  return static_cast<std::size_t>(
      std::count_if(loop.begin(), loop.end(), [&](std::int32_t corner) {
        return csg::turns_round(surface, face, surface_.point(corner), axis_) !=
               0;
      }));
}

Point rounded(const ExactPoint& point, const csg::Scale& scale) {
  const auto at = [&](std::size_t i) {
    return csg::nearest_double(point.at[i] * scale.numerator,
                               point.below * scale.denominator);
  };
  return {at(0), at(1), at(2)};
}

/// Adds the regions of a face.
void add_regions(ExactSurface& surface, const fast::Face& face,
                 std::vector<Region>& regions) {
  Loops loops(surface, face);
  std::vector<std::vector<std::int32_t>> boundaries, holes;
  for (auto& loop : loops.loops()) {
    const bool outer = loops.orientation(loop) > 0;
    (outer ? boundaries : holes).push_back(std::move(loop));
  }
  const csg::Scale scale = csg::scale_of(surface.solid().unit, 1);
  const auto points_of = [&](const std::vector<std::int32_t>& loop) {
    std::vector<Point> points;
    for (const std::int32_t v : loop)
      points.push_back(rounded(surface.point(v), scale));
    return points;
  };
  const std::size_t first = regions.size();
  for (const auto& loop : boundaries) regions.push_back({points_of(loop), {}});
  for (const auto& hole : holes) {
    std::size_t best = 0, most = 0;
    for (std::size_t i = 0; i < boundaries.size(); ++i) {
      const std::size_t held = loops.held(hole, boundaries[i]);
      if (held > most) best = i;
      most = std::max(most, held);
    }
    regions[first + best].holes.push_back(points_of(hole));
  }
}

/// Whether the face lies in the plane of the points, and looks the same way.
bool is_in_plane(const ExactSurface& surface, const fast::Face& face,
                 const std::array<GridPoint, 3>& points) {
  std::array<Integers3, 3> p;
  for (std::size_t i = 0; i < 3; ++i) {
    p[i] = {points[i].x, points[i].y, points[i].z};
    if (csg::side_of(surface, face, {p[i], 1}) != 0) return false;
  }
  Integers3 u, v;
  for (std::size_t i = 0; i < 3; ++i) {
    u[i] = p[1][i] - p[0][i];
    v[i] = p[2][i] - p[0][i];
  }
  return csg::dot(surface.normal(face), csg::cross(u, v)) > 0;
}

}  // namespace

Result<std::vector<Region>> Solid::section(const Plane& plane) const {
  const Solid half = half_space(plane);
  const auto evaluation = SolidNode::of(*this & half).evaluation({});
  if (!evaluation) return evaluation.error();
  const Lock lock((*evaluation)->mutex);
  std::vector<Region> regions;
  const fast::Solid solid =
      fast::merge_faces((*evaluation)->solid, fast::Merge::kPlane);
  ExactSurface surface(solid);
  for (const detail::Evaluation::Cut& cut : (*evaluation)->cuts) {
    if (cut.node != half.node_) continue;
    for (const fast::Face& face : solid.faces) {
      if (is_in_plane(surface, face, cut.points))
        add_regions(surface, face, regions);
    }
  }
  return regions;
}

}  // namespace halfspace
