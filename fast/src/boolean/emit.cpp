#include "boolean/emit.hpp"

#include <algorithm>
#include <optional>
#include <span>

#include "base/check.hpp"
#include "base/parallel.hpp"
#include "base/threads.hpp"
#include "halfspace/assert.hpp"
#include "intersect/transversal_plane.hpp"

namespace halfspace::fast {

std::vector<List<DirectedEdge>> Emitter::run(Arrangement& arrangement,
                                             Classifier& classifier,
                                             int threads) {
  std::vector<Block> blocks = blocks_of(arrangement);
  std::vector<List<DirectedEdge>> found(blocks.size());
  if (!kManyThreads || threads <= 1 || blocks.size() <= 3) {
    Emitter emitter(arrangement, classifier, /*is_shared=*/false);
    // A few lists are one.
    const bool is_one = blocks.size() <= 3;
    for (std::size_t k = 0; k < blocks.size(); ++k) {
      emitter.emit_block(blocks[k]);
      if (is_one) continue;
      found[k] = emitter.pieces_;
      emitter.pieces_.clear();
    }
    if (is_one) {
      found.clear();
      found.push_back(std::move(emitter.pieces_));
    }
    return found;
  }
  find_planes(arrangement);
  threads::PerThread<Emitter> emitters(
      [&] { return Emitter(arrangement, classifier, /*is_shared=*/true); });
  for_blocks(threads, blocks.size(), 1,
             [&](std::size_t k, std::size_t, std::size_t) {
               Emitter& emitter = emitters.local();
               emitter.pieces_.clear();
               emitter.emit_block(blocks[k]);
               found[k] = emitter.pieces_;
             });
  Emitter emitter(arrangement, classifier, /*is_shared=*/false);
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    if (!blocks[k].left.empty()) emitter.emit_left(blocks[k], found[k]);
  }
  return found;
}

std::vector<Emitter::Block> Emitter::blocks_of(const Arrangement& arrangement) {
  constexpr std::size_t kBlock = 2048;  // untuned
  std::vector<Block> blocks;
  for (const std::size_t kind : {0u, 1u, 2u}) {
    const std::size_t count = kind == 2
                                  ? arrangement.segments.size()
                                  : arrangement.operands[kind].edges.size();
    for (std::size_t first = 0; first < count; first += kBlock)
      blocks.push_back({kind, first, std::min(count, first + kBlock), {}});
  }
  return blocks;
}

/// Adds the planes that emit_parts() asks for, in its order.
void Emitter::find_planes(Arrangement& arrangement) {
  for (std::size_t o = 0; o < 2; ++o) {
    for (std::size_t e = 0; e < arrangement.operands[o].edges.size(); ++e) {
      OperandEdge& edge = arrangement.operands[o].edges[e];
      const auto id = static_cast<std::int32_t>(e);
      if (edge.other < 0 && (!arrangement.cuts_of(o, id).empty() ||
                             !arrangement.covers_of(o, id).empty()))
        transversal_plane(edge, arrangement.table);
    }
  }
}

void Emitter::emit_block(Block& block) {
  for (std::size_t i = block.first; i < block.last; ++i) {
    if (block.kind == 2) {
      emit_segment(common_.segments[i]);
      continue;
    }
    const std::size_t before = pieces_.size();
    const auto id = static_cast<std::int32_t>(i);
    if (emit_edge(block.kind, id)) continue;
    pieces_.resize(before);
    block.left.emplace_back(before, id);
  }
}

/// Puts what the edges that were left give in its place.
void Emitter::emit_left(const Block& block, List<DirectedEdge>& pieces) {
  pieces_.clear();
  std::size_t done = 0;
  const auto add_to = [&](std::size_t end) {
    pieces_.insert(pieces_.end(),
                   pieces.begin() + static_cast<std::ptrdiff_t>(done),
                   pieces.begin() + static_cast<std::ptrdiff_t>(end));
    done = end;
  };
  for (const auto& [place, edge] : block.left) {
    add_to(place);
    emit_edge(block.kind, edge);
  }
  add_to(pieces.size());
  pieces = pieces_;
}

HalfFace Emitter::half_face_of(std::size_t o, std::int32_t f, int turn) const {
  const Face& face = operands_[o].face(f);
  return {static_cast<std::int32_t>(o), f, face.plane, turn, face.flipped};
}

/// Whether it could be done: not where is_shared_ and a ray has to decide.
bool Emitter::emit_edge(std::size_t o, std::int32_t id) {
  const bool is_whole =
      common_.cuts_of(o, id).empty() && common_.covers_of(o, id).empty();
  return is_whole ? emit_whole(o, id) : emit_parts(o, id);
}

/// An edge that does not meet the other operand's surface, but for its ends.
bool Emitter::emit_whole(std::size_t o, std::int32_t id) {
  const Operand& operand = operands_[o];
  const OperandEdge& edge = operands_[o].edge(id);
  const auto uses =
      std::span(operand.uses).subspan(edge.first_use, edge.use_count);
  HALFSPACE_CHECK(!uses.empty());
  const auto is_touched = [&](const EdgeUse& use) {
    return operand.touched[static_cast<std::size_t>(use.face)] != 0;
  };
  if (std::none_of(uses.begin(), uses.end(), is_touched)) return true;
  const std::optional<bool> member =
      is_shared_ ? classifier_.known_part(o, id, edge.low, edge.high)
                 : classifier_.is_part_inside(o, id, edge.low, edge.high);
  if (!member) return false;
  const bool beyond = common_.is_in_result(o, false, *member);
  if (common_.is_in_result(o, true, *member) == beyond) return true;
  for (const EdgeUse& use : uses) {
    if (!is_touched(use)) continue;
    const std::int32_t plane = operand.face(use.face).plane;
    DirectedEdge piece{bucket_of(o, use.face, beyond), plane, edge.low,
                       edge.high, other_than(plane, {edge.plane, edge.other})};
    if (use.forward == beyond) std::swap(piece.from, piece.to);
    pieces_.push_back(piece);
  }
  return true;
}

void Emitter::find_covered(std::size_t o, std::int32_t id,
                           const std::vector<std::int32_t>& points) {
  covered_.clear();
  const auto covers = common_.covers_of(o, id);
  if (covers.empty()) return;
  const int axis = operands_[o].edge(id).axis;
  const auto place = [&](std::int32_t v) {
    const auto at = std::partition_point(
        points.begin(), points.end(),
        [&](std::int32_t u) { return table_.compare(axis, u, v) < 0; });
    return static_cast<std::size_t>(at - points.begin());
  };
  for (std::size_t c = 0; c < covers.size(); ++c) {
    const std::size_t end = place(covers[c].high);
    for (std::size_t part = place(covers[c].low); part < end; ++part)
      covered_.emplace_back(part, c);
  }
  std::sort(covered_.begin(), covered_.end());
}

/// An edge that is cut, or lies in the other operand's surface in part.
bool Emitter::emit_parts(std::size_t o, std::int32_t id) {
  const OperandEdge edge = operands_[o].edge(id);
  classifier_.points_on(o, id, points_);
  const std::vector<std::int32_t>& points = points_;
  const std::int32_t other = transversal_plane(operands_[o].edge(id), table_);
  find_covered(o, id, points);
  auto covered = covered_.begin();
  std::optional<Classifier::KnownPart> last;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    half_faces_.clear();
    bool twice = false;
    for (; covered != covered_.end() && covered->first == i; ++covered) {
      const EdgeInFace& cover = common_.covers_of(o, id)[covered->second];
      if (cover.left) half_faces_.push_back(half_face_of(1 - o, cover.face, 1));
      if (cover.right)
        half_faces_.push_back(half_face_of(1 - o, cover.face, -1));
      twice = twice || cover.on_edge;
    }
    // A segment of edges of both operands is emitted with the first one.
    if (o == 1 && twice) continue;
    std::array<bool, 2> member{};
    if (half_faces_.empty()) {
      const std::optional<bool> inside =
          is_shared_ ? classifier_.known_part(o, id, points, i, last)
                     : classifier_.is_part_inside(o, id, points, i, last);
      if (!inside) return false;
      member[1 - o] = *inside;
      last = {i, member[1 - o]};
    }
    for (std::uint32_t u = 0; u < edge.use_count; ++u) {
      const EdgeUse& use = operands_[o].uses[edge.first_use + u];
      const bool flipped = operands_[o].face(use.face).flipped;
      half_faces_.push_back(
          half_face_of(o, use.face, use.forward != flipped ? 1 : -1));
    }
    emit({points[i], points[i + 1], edge.axis, {edge.plane, other}}, member);
  }
  return true;
}

void Emitter::emit_segment(const IntersectionSegment& trace) {
  half_faces_.clear();
  for (const int turn : {1, -1}) {
    half_faces_.push_back(half_face_of(0, trace.first, turn));
    half_faces_.push_back(half_face_of(1, trace.second, turn));
  }
  emit({trace.low,
        trace.high,
        trace.axis,
        {operands_[0].face(trace.first).plane,
         operands_[1].face(trace.second).plane}},
       {});
}

/// Whether the wedge before the first half-face is inside the operand: it is if
/// the first of its own half-faces leaves it, for none of its faces overlap
/// (S6.2).
bool Emitter::is_before_inside(std::size_t o, bool member) const {
  const auto first = std::find_if(
      half_faces_.begin(), half_faces_.end(), [o](const HalfFace& w) {
        return w.operand == static_cast<std::int32_t>(o);
      });
  return first == half_faces_.end() ? member : exits(*first);
}

/// The half-face that the result's face is a part of, among those from `first`
/// to before `last`, which coincide: the first operand's (S6.4), which never
/// has to be flipped for that. No operand has two.
const HalfFace& Emitter::source_of(std::size_t first, std::size_t last) const {
  return half_faces_[half_faces_[first].operand == 0 ? first : last - 1];
}

/// Adds the directed edges of the result's faces along the segment, round which
/// half_faces_ are. `member`: whether the segment is inside an operand that has
/// no half-face there.
void Emitter::emit(const Segment& segment, const std::array<bool, 2>& member) {
  HALFSPACE_ASSERT(!half_faces_.empty());
  HALFSPACE_ASSERT(segment.low != segment.high);
  // Step 1: the half-faces counter-clockwise round the segment.
  radial_sort(half_faces_, segment.axis, table_);
  for (const HalfFace& half_face : half_faces_) {
    HALFSPACE_CHECK(table_.side(half_face.plane, segment.low) == 0 &&
                    table_.side(half_face.plane, segment.high) == 0);
  }
  // Step 2: inside which operands the wedge before the first half_face is.
  std::array<bool, 2> inside{is_before_inside(0, member[0]),
                             is_before_inside(1, member[1])};
  // Step 3: where the result begins or ends, there is a face of it.
  const std::size_t before_any = pieces_.size();
  for (std::size_t i = 0; i < half_faces_.size();) {
    std::size_t j = i;
    do {
      // As after the last one of the operand, unless some that both have are
      // not here.
      inside[static_cast<std::size_t>(half_faces_[j].operand)] =
          exits(half_faces_[j]);
      ++j;
    } while (j < half_faces_.size() && as_last(half_faces_, j));
    const bool before = is_member(common_.operation, inside[0], inside[1]);
    for (std::size_t k = i; k < j; ++k) {
      inside[static_cast<std::size_t>(half_faces_[k].operand)] =
          !exits(half_faces_[k]);
    }
    if (before != is_member(common_.operation, inside[0], inside[1])) {
      // Outwards is on from here where the result ends, else back.
      const bool flipped = half_faces_[i].turn == (before ? -1 : 1);
      const HalfFace& source = source_of(i, j);
      DirectedEdge piece{bucket_of(static_cast<std::size_t>(source.operand),
                                   source.face, source.flipped != flipped),
                         source.plane, segment.low, segment.high,
                         other_than(source.plane, segment.planes)};
      HALFSPACE_CHECK(piece.other != piece.plane);
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
