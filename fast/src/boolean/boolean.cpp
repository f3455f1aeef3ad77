#include "halfspace/fast/boolean.hpp"

#include <algorithm>
#include <tuple>
#include <unordered_map>

#include "boolean/engine.hpp"

namespace halfspace::fast {

namespace {

/// New ids by old ones, -1 where there is none yet: in a list, or if a solid
/// uses few of a table's by name, for lists cost as much as the table.
class Renamed {
 public:
  Renamed(std::size_t count, std::size_t uses) {
    if (count <= 16 * uses) list_.assign(count, -1);
  }
  std::int32_t& at(std::int32_t id) {
    if (!list_.empty()) return list_[static_cast<std::size_t>(id)];
    return map_.try_emplace(id, -1).first->second;
  }

 private:
  std::vector<std::int32_t> list_;
  std::unordered_map<std::int32_t, std::int32_t> map_;
};

}  // namespace

Solid moved_to(const Solid& solid, const std::shared_ptr<Space>& space) {
  const Space& from = *solid.space;
  const std::size_t uses = solid.faces.size() + 2 * solid.edges.size();
  Renamed planes(from.plane_count(), uses);
  Renamed vertices(from.vertex_count(), uses);
  const auto plane = [&](std::int32_t p) {
    std::int32_t& id = planes.at(p);
    if (id < 0) {
      id = space->add_plane(from.normal(p), from.plane(p).origin).plane;
    }
    return id;
  };
  const auto vertex = [&](std::int32_t v) {
    std::int32_t& id = vertices.at(v);
    if (id < 0) {
      const SpaceVertex& old = from.vertex(v);
      id = old.is_grid()
               ? space->add_point(old.point())
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

/// Of solids in one table.
Solid carried_out(const Truth& truth, const Solid& a, const Solid& b,
                  int threads) {
  Engine engine(truth, a, b, *a.space, threads);
  engine.find_contacts();
  if (engine.has_nodes(0) && engine.has_nodes(1)) return engine.run();
  const Solid first = engine.has_nodes(0) ? a : noded(a);
  const Solid second = engine.has_nodes(1) ? b : noded(b);
  Solid result = carried_out(truth, first, second, threads);
  for (Face& face : result.faces) {
    const Solid& from = face.from_first ? first : second;
    if (!engine.has_nodes(face.from_first ? 0 : 1))
      face.source = from.faces[static_cast<std::size_t>(face.source)].source;
  }
  return result;
}

Solid in_one_table(const Truth& truth, const Solid& a, const Solid& b,
                   int threads) {
  if (a.space == b.space) return carried_out(truth, a, b, threads);
  const auto space = std::make_shared<Space>(
      std::max(a.space->grid_bits(), b.space->grid_bits()));
  return carried_out(truth, moved_to(a, space), moved_to(b, space), threads);
}

}  // namespace

Solid boolean(BooleanOp operation, const Solid& a, const Solid& b,
              int threads) {
  return in_one_table(truth_of(operation), a, b, threads);
}

Solid symmetric_difference(const Solid& a, const Solid& b, int threads) {
  return in_one_table({false, true, true}, a, b, threads);
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
