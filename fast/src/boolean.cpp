#include "halfspace/fast/boolean.hpp"

#include <algorithm>
#include <tuple>

#include "boolean_engine.hpp"

namespace halfspace::fast {

Solid moved_to(const Solid& solid, const std::shared_ptr<Space>& space) {
  const Space& from = *solid.space;
  std::vector<std::int32_t> planes(from.plane_count(), -1);
  std::vector<std::int32_t> vertices(from.vertex_count(), -1);
  const auto plane = [&](std::int32_t p) {
    std::int32_t& id = planes[static_cast<std::size_t>(p)];
    if (id < 0) {
      const SpacePlane& old = from.plane(p);
      id = space->add_plane(old.normal, old.origin).plane;
    }
    return id;
  };
  const auto vertex = [&](std::int32_t v) {
    std::int32_t& id = vertices[static_cast<std::size_t>(v)];
    if (id < 0) {
      const SpaceVertex& old = from.vertex(v);
      id = old.is_grid()
               ? space->add_point(old.point)
               : space->meet(plane(old.planes[0]), plane(old.planes[1]),
                             plane(old.planes[2]));
    }
    return id;
  };
  Solid result = solid;
  result.space = space;
  for (Face& face : result.faces) face.plane = plane(face.plane);
  for (SolidEdge& edge : result.edges) {
    edge = {vertex(edge.from), vertex(edge.to),
            edge.other < 0 ? -1 : plane(edge.other)};
  }
  return result;
}

namespace {

Solid carried_out(const Truth& truth, const Solid& a, const Solid& b) {
  if (a.space == b.space) return Engine(truth, a, b, *a.space).run();
  const auto space = std::make_shared<Space>(
      std::max(a.space->grid_bits(), b.space->grid_bits()));
  const Solid first = moved_to(a, space);
  const Solid second = moved_to(b, space);
  return Engine(truth, first, second, *space).run();
}

}  // namespace

Solid boolean(BooleanOp operation, const Solid& a, const Solid& b) {
  return carried_out(truth_of(operation), a, b);
}

Solid symmetric_difference(const Solid& a, const Solid& b) {
  return carried_out({false, true, true}, a, b);
}

Halves split(const Solid& solid, const std::array<GridPoint, 3>& corners) {
  const Solid negative = half_space(corners, solid);
  return {boolean(BooleanOp::kDifference, solid, negative),
          boolean(BooleanOp::kIntersection, solid, negative)};
}

std::vector<BadEdge> bad_edges(const Solid& solid) {
  // Uses from the lesser end to the greater one count up, the others down.
  std::vector<BadEdge> uses;
  uses.reserve(solid.edges.size());
  for (const SolidEdge& edge : solid.edges) {
    const auto [low, high] = std::minmax(edge.from, edge.to);
    uses.push_back({low, high, edge.from == low ? 1 : -1});
  }
  std::sort(uses.begin(), uses.end(), [](const BadEdge& x, const BadEdge& y) {
    return std::tie(x.from, x.to) < std::tie(y.from, y.to);
  });
  std::vector<BadEdge> bad;
  for (std::size_t i = 0; i < uses.size();) {
    BadEdge sum = uses[i];
    for (++i;
         i < uses.size() && uses[i].from == sum.from && uses[i].to == sum.to;
         ++i)
      sum.excess += uses[i].excess;
    if (sum.excess < 0) {
      std::swap(sum.from, sum.to);
      sum.excess = -sum.excess;
    }
    if (sum.excess != 0) bad.push_back(sum);
  }
  return bad;
}

}  // namespace halfspace::fast
