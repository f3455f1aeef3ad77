#include "intersect/point_location.hpp"

#include <algorithm>
#include <limits>

#include "base/check.hpp"

namespace halfspace::fast {

PointLocator::PointLocator(const Operand& operand, const GeometryTable& table)
    : PointLocator(operand.whole != nullptr ? *operand.whole : *operand.solid,
                   table, operand.index,
                   operand.whole != nullptr ? operand.whole_blocks.get()
                                            : operand.blocks.get()) {}

PointLocator::PointLocator(const Solid& solid, const GeometryTable& table,
                           const DynamicBvh* index, const EdgePackets* blocks)
    : solid_(solid), table_(table), index_(index), blocks_(blocks) {}

template <class Found>
void PointLocator::find(const Box& ray, Found&& found) const {
  constexpr int kFew = 8;
  if (index_ != nullptr) {
    index_->find(ray, found);
  } else if (++asked_ <= kFew) {
    for (std::size_t f = 0; f < solid_.faces.size(); ++f) {
      if (overlap(solid_.faces[f].box, ray))
        found(static_cast<std::int32_t>(f));
    }
  } else {
    if (!own_) own_.emplace().add(solid_, 0);
    own_->find(ray, found);
  }
}

int PointLocator::winding(std::int32_t vertex, std::int32_t target) const {
  // A ray along the first axis. All signs are those at the vertex, or where
  // they are zero at `target`: as they are right beside it.
  Box ray = kEmptyBox;
  extend(ray, table_.vertex(vertex).approximate);
  ray.high[0] = std::numeric_limits<float>::max();
  int winding = solid_.unbounded ? 1 : 0;
  find(ray, [&](std::int32_t f) {
    const Face& face = solid_.faces[static_cast<std::size_t>(f)];
    if (face.edge_count == 0) {
      // No ray: its side decides for itself. Nothing is asked of a vertex in
      // its plane: an edge has a part on one side only, and an end there.
      winding = table_.side(face.plane, vertex) == (face.flipped ? 1 : -1);
    } else {
      winding += ray_contribution(0, f, vertex, target);
    }
  });
  return winding;
}

/// What a face adds to the winding number.
int PointLocator::ray_contribution(int axis, std::int32_t f,
                                   std::int32_t vertex,
                                   std::int32_t target) const {
  const Face& face = solid_.faces[static_cast<std::size_t>(f)];
  HALFSPACE_CHECK(face.edge_count != 0);
  const int along = table_.normal_sign(face.plane, axis);
  if (along == 0) return 0;
  int side = table_.side(face.plane, vertex);
  if (side == 0) side = table_.side(face.plane, target);
  // The face lies ahead where the normal that points along the ray has the
  // point behind it.
  if (side * along >= 0 || !is_above(axis, f, vertex, target)) return 0;
  return (along > 0) != face.flipped ? 1 : -1;
}

/// Seen along the axis, with the next one to the right and the last one
/// upwards: whether an odd number of edges pass over the point. A point level
/// with an end counts as above it, and a point on an edge as over it, whichever
/// face asks: so the faces round a vertex do not overlap.
bool PointLocator::is_above(int axis, std::int32_t f, std::int32_t vertex,
                            std::int32_t target) const {
  const Face& face = solid_.faces[static_cast<std::size_t>(f)];
  const PacketList* list = blocks_ != nullptr ? blocks_->of(f) : nullptr;
  if (list == nullptr)
    return passes_over(axis, face, 0, face.edge_count, vertex, target);
  Box point = kEmptyBox;
  extend(point, table_.vertex(vertex).approximate);
  const SolidEdge* edges = solid_.edges.data() + face.first_edge;
  const int right = (axis + 1) % 3;
  const auto r = static_cast<std::size_t>(right);
  const auto u = static_cast<std::size_t>(axis + 2) % 3;
  bool inside = false;
  // Not if all ends are on one side, or all of it is lower.
  const auto matters = [&](const Box& box) {
    return box.high[r] >= point.low[r] && box.low[r] <= point.high[r] &&
           box.high[u] >= point.low[u];
  };
  list->visit(matters, [&](const EdgePacket& block) {
    const std::uint32_t last = block.first + block.count;
    bool passes = false;
    if (block.box.low[u] > point.high[u] && block.is_closed) {
      // All of it is over the point, and whole loops pass it twice or not.
    } else if (block.box.low[u] > point.high[u] && block.is_row) {
      passes = is_right(right, edges[block.first].from, vertex, target) !=
               is_right(right, edges[last - 1].to, vertex, target);
    } else {
      passes = passes_over(axis, face, block.first, last, vertex, target);
    }
    inside = inside != passes;
  });
  return inside;
}

bool PointLocator::is_right(int right, std::int32_t v, std::int32_t vertex,
                            std::int32_t target) const {
  const int order = table_.compare(right, v, vertex);
  return (order != 0 ? order : table_.compare(right, v, target)) > 0;
}

/// Whether an odd number of the face's edges from `first` to before `last`
/// pass over the point.
bool PointLocator::passes_over(int axis, const Face& face, std::uint32_t first,
                               std::uint32_t last, std::int32_t vertex,
                               std::int32_t target) const {
  const SolidEdge* edges = solid_.edges.data() + face.first_edge;
  const int right = (axis + 1) % 3;
  bool odd = false;
  bool to = false;
  for (std::uint32_t i = first; i < last; ++i) {
    const SolidEdge& edge = edges[i];
    const bool goes_on = i > first && edges[i - 1].to == edge.from;
    const bool from = goes_on ? to : is_right(right, edge.from, vertex, target);
    to = is_right(right, edge.to, vertex, target);
    if (from == to) continue;
    const std::int32_t low = from ? edge.to : edge.from;
    const std::int32_t high = from ? edge.from : edge.to;
    HALFSPACE_CHECK(table_.compare(right, low, high) <= 0);
    int turn = table_.turn(axis, low, high, vertex);
    if (turn == 0) turn = table_.turn(axis, low, high, target);
    // The edge goes to the right; the point is lower where it turns so too.
    if (turn < 0) odd = !odd;
  }
  return odd;
}

}  // namespace halfspace::fast
