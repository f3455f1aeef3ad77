#include "halfspace/ref/split.hpp"

#include <utility>

#include "halfspace/assert.hpp"

namespace halfspace::ref {
namespace {

/// The point in which the line through `p` and `q` meets a plane on which `h`
/// takes the values `hp` and `hq` there. Requires: hp != hq.
Point meet(const Point& p, const Rational& hp, const Point& q,
           const Rational& hq) {
  const Rational t = hp / (hp - hq);
  return {p.x + (q.x - p.x) * t, p.y + (q.y - p.y) * t, p.z + (q.z - p.z) * t};
}

/// Adds `vertex` and the edge that leaves it.
void append(Fragment& part, Point vertex, EdgeName edge) {
  part.vertices.push_back(std::move(vertex));
  part.edges.push_back(edge);
}

}  // namespace

SplitResult split(const Fragment& fragment, const Plane& plane,
                  PolygonId splitter) {
  HALFSPACE_ASSERT(relation(fragment, plane) == Relation::kSpanning);
  SplitResult result{{fragment.source, {}, {}}, {fragment.source, {}, {}}};
  const auto part = [&result](int sign) -> Fragment& {
    return sign > 0 ? result.positive : result.negative;
  };
  const EdgeName cut{EdgeName::Kind::kSplitter, splitter};

  // Step 1: the plane's value at each vertex.
  std::vector<Rational> values;
  for (const Point& vertex : fragment.vertices) {
    values.push_back(value_at(plane, vertex));
  }

  // Step 2: walk round the boundary; where it passes through the plane, the
  // part it leaves goes on along the cut, the part it enters along the edge.
  const std::size_t count = fragment.vertices.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t next = (i + 1) % count;
    const Point& p = fragment.vertices[i];
    const Point& q = fragment.vertices[next];
    const EdgeName edge = fragment.edges[i];
    const int here = sign(values[i]);
    const int there = sign(values[next]);
    if (here == 0) {
      append(part(-there), p, cut);
      append(part(there), p, edge);
    } else {
      append(part(here), p, edge);
      if (there == -here) {
        const Point point = meet(p, values[i], q, values[next]);
        append(part(here), point, cut);
        append(part(there), point, edge);
      }
    }
  }
  return result;
}

}  // namespace halfspace::ref
