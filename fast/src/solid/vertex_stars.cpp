#include "solid/vertex_stars.hpp"

#include <utility>

namespace halfspace::fast {
namespace {

/// Whether three points of the grid are on one line.
bool on_line(const GridPoint& p, const GridPoint& q, const GridPoint& r) {
  return cross<54>(difference(p, q), difference(p, r)) == Vector3<Int128>{};
}

/// Whether the edges from one center are on one line.
bool in_line(const IncidentEdge& s, const IncidentEdge& t,
             const GeometryTable& table) {
  for (const auto& [known, asked] : {std::pair(&s, &t), std::pair(&t, &s)}) {
    if (known->other >= 0) {
      // In a solid every face at a vertex of two edges has both of them.
      return table.side(known->plane, asked->end) == 0 &&
             table.side(known->other, asked->end) == 0;
    }
  }
  return on_line(table.vertex(s.center).point(), table.vertex(s.end).point(),
                 table.vertex(t.end).point());
}

}  // namespace

void VertexStars::begin(std::int32_t center, std::size_t at, bool is_pinned) {
  if (is_pinned) {
    states_[at] = kMore;
    return;
  }
  Ends& ends = ends_[at];
  const Pair pair{{IncidentEdge{center, ends.least, -1, -1},
                   IncidentEdge{center, ends.greatest, -1, -1}}};
  ends.least = static_cast<std::int32_t>(pairs_.size());
  states_[at] = kAsked;
  pairs_.push_back(pair);
}

void VertexStars::put(Pair& pair, const IncidentEdge& incident) {
  IncidentEdge& known = pair.edges[pair.edges[0].end == incident.end ? 0 : 1];
  if (known.other < 0) known = incident;
}

void VertexStars::decide(const GeometryTable& table) {
  for (const Pair& pair : pairs_) {
    if (!in_line(pair.edges[0], pair.edges[1], table)) continue;
    states_[places_.find(pair.edges[0].center)] = kStraight;
    any_ = true;
  }
}

}  // namespace halfspace::fast
