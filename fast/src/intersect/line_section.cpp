#include "intersect/line_section.hpp"

#include <algorithm>

#include "base/check.hpp"
#include "intersect/transversal_plane.hpp"

namespace halfspace::fast {

std::int32_t line_crossing(const Face& face, const SolidEdge& edge, int from,
                           int to, std::int32_t across, GeometryTable& table) {
  HALFSPACE_ASSERT(from != to);
  if (from == 0) return edge.from;
  if (to == 0) return edge.to;
  return table.meet(face.plane, transversal_plane(edge, face, table), across);
}

void LineFaceSection::find(const Face& face, std::span<const SolidEdge> edges,
                           std::int32_t across, int axis) {
  parts_.clear();
  turns_.clear();
  for (const SolidEdge& edge : edges) add(face, edge, across);
  std::sort(turns_.begin(), turns_.end(), [&](const Turn& t, const Turn& u) {
    return table_.compare(axis, t.vertex, u.vertex) < 0;
  });
  bool positive = false, negative = false;
  for (std::size_t i = 0; i < turns_.size(); ++i) {
    positive = positive != turns_[i].positive;
    negative = negative != turns_[i].negative;
    // Beyond the last one there is nothing, unless the face is open.
    const bool goes_on = (positive || negative) && i + 1 < turns_.size();
    parts_.emplace_back(turns_[i].vertex, turns_[goes_on ? i + 1 : i].vertex);
    HALFSPACE_CHECK(table_.side(across, turns_[i].vertex) == 0);
    HALFSPACE_CHECK(
        table_.compare(axis, parts_.back().first, parts_.back().second) <= 0);
  }
}

/// Adds the point at which the edge and the line meet.
void LineFaceSection::add(const Face& face, const SolidEdge& edge,
                          std::int32_t across) {
  const int from = table_.side(across, edge.from);
  const int to = table_.side(across, edge.to);
  // An edge along the line adds nothing: its neighbours cross the sides.
  if (from == to) return;
  const std::int32_t at = line_crossing(face, edge, from, to, across, table_);
  turns_.push_back({at, (from > 0) != (to > 0), (from < 0) != (to < 0)});
}

}  // namespace halfspace::fast
