#include <algorithm>
#include <utility>

#include "boolean/engine.hpp"

namespace halfspace::fast {

Wing Engine::wing_of(std::size_t o, std::int32_t f, int turn) const {
  const Face& face = operands_[o].face(f);
  return {static_cast<std::int32_t>(o), f, face.plane, turn, face.flipped};
}

void Engine::emit_edges(std::size_t o) {
  for (std::size_t e = 0; e < operands_[o].edges.size(); ++e) {
    const auto id = static_cast<std::int32_t>(e);
    if (cuts_of(o, id).empty() && covers_of(o, id).empty()) {
      emit_whole(o, id);
    } else {
      emit_parts(o, id);
    }
  }
}

/// An edge that does not meet the other operand's surface, but for its ends.
void Engine::emit_whole(std::size_t o, std::int32_t id) {
  const Operand& operand = operands_[o];
  const LineEdge& edge = operands_[o].edge(id);
  const auto uses =
      std::span(operand.uses).subspan(edge.first_use, edge.use_count);
  const auto is_touched = [&](const EdgeUse& use) {
    return operand.touched[static_cast<std::size_t>(use.face)] != 0;
  };
  if (std::none_of(uses.begin(), uses.end(), is_touched)) return;
  const bool member = is_part_inside(o, id, edge.low, edge.high);
  const bool beyond = apply(o, false, member);
  if (apply(o, true, member) == beyond) return;
  for (const EdgeUse& use : uses) {
    if (!is_touched(use)) continue;
    const std::int32_t plane = operand.face(use.face).plane;
    Piece piece{bucket_of(o, use.face, beyond), plane, edge.low, edge.high,
                other_than(plane, {edge.plane, edge.other})};
    if (use.forward == beyond) std::swap(piece.from, piece.to);
    pieces_.push_back(piece);
  }
}

void Engine::find_covered(std::size_t o, std::int32_t id) {
  covered_.clear();
  const auto covers = covers_of(o, id);
  if (covers.empty()) return;
  const int axis = operands_[o].edge(id).axis;
  const auto place = [&](std::int32_t v) {
    const auto at = std::partition_point(
        points_.begin(), points_.end(),
        [&](std::int32_t u) { return table_.compare(axis, u, v) < 0; });
    return static_cast<std::size_t>(at - points_.begin());
  };
  for (std::size_t c = 0; c < covers.size(); ++c) {
    const std::size_t end = place(covers[c].high);
    for (std::size_t part = place(covers[c].low); part < end; ++part)
      covered_.emplace_back(part, c);
  }
  std::sort(covered_.begin(), covered_.end());
}

/// An edge that is cut, or lies in the other operand's surface in part.
void Engine::emit_parts(std::size_t o, std::int32_t id) {
  const LineEdge edge = operands_[o].edge(id);
  find_points(o, id);
  find_covered(o, id);
  auto covered = covered_.begin();
  std::optional<KnownPart> last;
  for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
    wings_.clear();
    bool twice = false;
    for (; covered != covered_.end() && covered->first == i; ++covered) {
      const Cover& cover = covers_of(o, id)[covered->second];
      if (cover.left) wings_.push_back(wing_of(1 - o, cover.face, 1));
      if (cover.right) wings_.push_back(wing_of(1 - o, cover.face, -1));
      twice = twice || cover.on_edge;
    }
    // A segment of edges of both operands is the first one's affair.
    if (o == 1 && twice) continue;
    std::array<bool, 2> member{};
    if (wings_.empty()) {
      auto told = told_inside(o, id, points_[i], points_[i + 1]);
      if (!told && last) told = carried_inside(o, id, *last, i);
      if (!told) told = locator(1 - o).is_inside(points_[i], points_[i + 1]);
      last = {i, *told};
      member[1 - o] = *told;
    }
    for (std::uint32_t u = 0; u < edge.use_count; ++u) {
      const EdgeUse& use = operands_[o].uses[edge.first_use + u];
      const bool flipped = operands_[o].face(use.face).flipped;
      wings_.push_back(wing_of(o, use.face, use.forward != flipped ? 1 : -1));
    }
    const std::int32_t other =
        second_plane(operands_[o].edge(id), operands_[o], table_);
    emit({points_[i], points_[i + 1], edge.axis, {edge.plane, other}}, member);
  }
}

void Engine::emit_traces() {
  for (const Trace& trace : traces_) {
    wings_.clear();
    for (const int turn : {1, -1}) {
      wings_.push_back(wing_of(0, trace.first, turn));
      wings_.push_back(wing_of(1, trace.second, turn));
    }
    emit({trace.low,
          trace.high,
          trace.axis,
          {operands_[0].face(trace.first).plane,
           operands_[1].face(trace.second).plane}},
         {});
  }
}

/// Whether the wedge before the first wing is inside the operand: if the first
/// of its own wings leaves it, for none of its faces overlap (S6.2).
bool Engine::is_before_inside(std::size_t o, bool member) const {
  const auto first = std::find_if(
      wings_.begin(), wings_.end(),
      [o](const Wing& w) { return w.operand == static_cast<std::int32_t>(o); });
  return first == wings_.end() ? member : leaves(*first);
}

/// Of the wings from `first` to before `last`, which stand in one place, the
/// one that the result's face is a part of: the first operand's (S6.4), which
/// never has to be flipped for that. No operand has two.
const Wing& Engine::source_of(std::size_t first, std::size_t last) const {
  return wings_[wings_[first].operand == 0 ? first : last - 1];
}

/// Adds the pieces of the result's faces along the segment, at which the wings
/// are. `member`: whether it is inside an operand that has no wing there.
void Engine::emit(const Segment& segment, const std::array<bool, 2>& member) {
  // Step 1: the wings counter-clockwise round the segment.
  sort_wings(wings_, segment.axis, table_);
  // Step 2: inside which operands the wedge before the first wing is.
  std::array<bool, 2> inside{is_before_inside(0, member[0]),
                             is_before_inside(1, member[1])};
  // Step 3: where the result begins or ends, there is a face of it.
  const std::size_t before_any = pieces_.size();
  for (std::size_t i = 0; i < wings_.size();) {
    const bool before = is_member(operation_, inside[0], inside[1]);
    std::size_t j = i;
    do {
      inside[static_cast<std::size_t>(wings_[j].operand)] = !leaves(wings_[j]);
      ++j;
    } while (j < wings_.size() && as_last(wings_, j));
    if (before != is_member(operation_, inside[0], inside[1])) {
      // Outwards is on from here where the result ends, else back.
      const bool flipped = wings_[i].turn == (before ? -1 : 1);
      const Wing& source = source_of(i, j);
      Piece piece{bucket_of(static_cast<std::size_t>(source.operand),
                            source.face, source.flipped != flipped),
                  source.plane, segment.low, segment.high,
                  other_than(source.plane, segment.planes)};
      if (!before) std::swap(piece.from, piece.to);
      pieces_.push_back(piece);
    }
    i = j;
  }
  // Step 4: a face that goes on beyond the segment has no edge there.
  if (pieces_.size() == before_any + 2 &&
      pieces_[before_any].bucket == pieces_[before_any + 1].bucket)
    pieces_.resize(before_any);
}

}  // namespace halfspace::fast
