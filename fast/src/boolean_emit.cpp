#include <algorithm>

#include "boolean_engine.hpp"

namespace halfspace::fast {
namespace {

std::int64_t bucket_of(std::size_t o, std::int32_t face, bool flipped) {
  return (static_cast<std::int64_t>(o) << 40) + 2 * std::int64_t{face} +
         (flipped ? 1 : 0);
}

/// Whether each edge begins where the one before it ends.
bool is_row(std::span<const SolidEdge> edges) {
  for (std::size_t i = 1; i < edges.size(); ++i) {
    if (edges[i - 1].to != edges[i].from) return false;
  }
  return true;
}

}  // namespace

Wing Engine::wing_of(std::size_t o, std::int32_t f, int turn) const {
  const Face& face = operands_[o].face(f);
  return {static_cast<std::int32_t>(o), f, face.plane, turn, face.turned};
}

Segment Engine::segment_of(const LineEdge& edge) const {
  return {edge.low, edge.high, edge.axis, {edge.plane, edge.other}};
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
  std::optional<bool> member;
  for (std::uint32_t u = 0; u < edge.use_count; ++u) {
    const EdgeUse& use = operand.uses[edge.first_use + u];
    if (operand.touched[static_cast<std::size_t>(use.face)] == 0) continue;
    if (!member) member = is_part_inside(o, id, edge.low, edge.high);
    const bool within = apply(o, true, *member);
    const bool beyond = apply(o, false, *member);
    if (within == beyond) continue;
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
        [&](std::int32_t u) { return space_.compare(axis, u, v) < 0; });
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
  // The last part known to be inside the other operand or not.
  std::size_t known = 0;
  std::optional<bool> inside;
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
      if (!told && inside) told = carried_inside(o, id, known, *inside, i);
      if (!told) told = locator(1 - o).is_inside(points_[i], points_[i + 1]);
      inside = told;
      known = i;
      member[1 - o] = *told;
    }
    for (std::uint32_t u = 0; u < edge.use_count; ++u) {
      const EdgeUse& use = operands_[o].uses[edge.first_use + u];
      const bool turned = operands_[o].face(use.face).turned;
      wings_.push_back(wing_of(o, use.face, use.forward != turned ? 1 : -1));
    }
    Segment segment = segment_of(edge);
    segment.low = points_[i];
    segment.high = points_[i + 1];
    if (segment.planes[1] < 0)
      segment.planes[1] =
          second_plane(operands_[o].edge(id), operands_[o], space_);
    emit(segment, member);
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

/// How often the wedge before the first wing is inside the operand.
int Engine::level_before(std::size_t o, bool member) const {
  int least = 0, most = 0, sum = 0;
  bool any = false;
  for (std::size_t i = 0; i < wings_.size(); ++i) {
    if (wings_[i].operand == static_cast<std::int32_t>(o)) {
      sum += change(wings_[i]);
      any = true;
    }
    if (i + 1 < wings_.size() && as_last(wings_, i + 1)) continue;
    least = std::min(least, sum);
    most = std::max(most, sum);
  }
  if (!any) return member ? 1 : 0;
  // Faces back to back, and nothing else, are amid the operand.
  // Never true: no operand's own faces overlap (S6.2).
  return least == most ? 1 : -least;
}

/// Of the wings from `first` to before `last`, which stand in one place, the
/// one that the result's face is a part of: the first operand's (S6.4), if
/// possible one that need not be turned over.
const Wing& Engine::source_of(std::size_t first, std::size_t last,
                              bool turned) const {
  const Wing* source = nullptr;
  for (const std::int32_t o : {1, 0}) {
    for (std::size_t k = first; k < last; ++k) {
      if (wings_[k].operand != o) continue;
      const bool is_right = wings_[k].turned == turned;
      // Never false: the first operand's face turns as the result's does, for
      // no operand's own faces overlap (S6.2).
      // Never true: so what the other one does is not asked.
      if (source == nullptr || is_right || source->turned != turned)
        source = &wings_[k];
    }
  }
  return *source;
}

/// Adds the pieces of the result's faces along the segment, at which the wings
/// are. `member`: whether it is inside an operand that has no wing there.
void Engine::emit(const Segment& segment, const std::array<bool, 2>& member) {
  // Step 1: the wings counter-clockwise round the segment.
  sort_wings(wings_, segment.axis, space_);
  // Step 2: inside which operands the wedge before the first wing is.
  std::array<int, 2> level{level_before(0, member[0]),
                           level_before(1, member[1])};
  // Step 3: where the result begins or ends, there is a face of it.
  const std::size_t before_any = pieces_.size();
  for (std::size_t i = 0; i < wings_.size();) {
    const bool before = truth_(level[0] > 0, level[1] > 0);
    std::size_t j = i;
    do {
      level[static_cast<std::size_t>(wings_[j].operand)] += change(wings_[j]);
      ++j;
    } while (j < wings_.size() && as_last(wings_, j));
    const bool after = truth_(level[0] > 0, level[1] > 0);
    if (before != after) {
      // Outwards is on from here where the result ends, else back.
      const bool turned = before ? wings_[i].turn < 0 : wings_[i].turn > 0;
      const Wing& source = source_of(i, j, turned);
      Piece piece{bucket_of(static_cast<std::size_t>(source.operand),
                            source.face, source.turned != turned),
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

Solid Engine::result() {
  // Step 1: the faces that meet nothing, as they are.
  Solid result;
  result.unit = operands_[0].solid->unit;
  result.space = operands_[0].solid->space;
  result.unbounded =
      truth_(operands_[0].solid->unbounded, operands_[1].solid->unbounded);
  notes_.pinned.forget();
  std::size_t faces = 0, edges = 0;
  for (const Operand& operand : operands_) {
    faces += operand.solid->faces.size();
    edges += operand.solid->edges.size();
  }
  result.faces.reserve(faces);
  result.edges.reserve(edges);
  for (std::size_t o = 0; o < 2; ++o) copy_untouched(o, result);
  for (std::size_t o = 0; o < 2; ++o) add_runs(o);
  // Step 2: what is left of the others.
  const std::size_t untouched = result.faces.size();
  const auto is_pinned = [this](std::int32_t v) {
    if (notes_.pinned.get(v, 0) != 0) return true;
    // A vertex that is beyond an operand may be one of faces that are not here.
    // Of two edges in line there, one goes on beyond: a run, or pinned.
    for (const std::size_t o : {0u, 1u}) {
      // Never true: unless doubles are too coarse to tell such an edge.
      if (is_beyond_other(o, v)) return true;
    }
    return false;
  };
  straighten(pieces_, is_pinned, space_);
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const Piece& piece = pieces_[i];
    if (i == 0 || piece.bucket != pieces_[i - 1].bucket) {
      const auto o = static_cast<std::size_t>(piece.bucket >> 40);
      const std::int64_t rest = piece.bucket & ((std::int64_t{1} << 40) - 1);
      begin_face(o, static_cast<std::int32_t>(rest / 2), rest % 2 != 0, result);
    }
    add_edge(piece, result);
  }
  for (std::size_t f = untouched; f < result.faces.size(); ++f)
    result.faces[f].box = face_box(result, result.faces[f]);
  return result;
}

/// Adds an edge to the last face, or the run that the piece stands for.
void Engine::add_edge(const Piece& piece, Solid& result) const {
  result.faces.back().edge_count += std::max(piece.run_count, 1u);
  if (piece.run_count == 0) {
    result.edges.push_back({piece.from, piece.to, piece.other});
    return;
  }
  const auto o = static_cast<std::size_t>(piece.bucket >> 40);
  const SolidEdge* run = operands_[o].solid->edges.data() + piece.run_first;
  const bool flipped = piece.bucket % 2 != 0;
  for (std::uint32_t i = 0; i < piece.run_count; ++i) {
    SolidEdge edge = run[flipped ? piece.run_count - 1 - i : i];
    if (flipped) std::swap(edge.from, edge.to);
    result.edges.push_back(edge);
  }
}

/// Adds the far edges of the faces that the other operand touches, if they
/// bound the result, in rows as long as can be.
void Engine::add_runs(std::size_t o) {
  const Operand& operand = operands_[o];
  const bool member = operands_[1 - o].solid->unbounded;
  const bool beyond = apply(o, false, member);
  if (apply(o, true, member) == beyond) return;
  for (const std::int32_t f : operand.active) {
    if (operand.touched[static_cast<std::size_t>(f)] == 0) continue;
    const Face& face = operand.face(f);
    const SolidEdge* edges = operand.edges_of(f);
    for (std::uint32_t i = 0; i < face.edge_count;) {
      const std::uint32_t first = i;
      while (i < face.edge_count && operand.edge_of[face.first_edge + i] < 0 &&
             (i == first || edges[i - 1].to == edges[i].from))
        ++i;
      if (i == first) {
        ++i;
        continue;
      }
      Piece run{bucket_of(o, f, beyond), face.plane, edges[first].from,
                edges[i - 1].to};
      if (beyond) std::swap(run.from, run.to);
      run.run_first = face.first_edge + first;
      run.run_count = i - first;
      notes_.pinned.set(run.from, 1);
      notes_.pinned.set(run.to, 1);
      pieces_.push_back(run);
    }
  }
}

/// Begins a face of the result that is a part of face `f`.
void Engine::begin_face(std::size_t o, std::int32_t f, bool flipped,
                        Solid& result) const {
  Face face = operands_[o].face(f);
  face.turned = face.turned != flipped;
  face.from_first = o == 0;
  face.source = f;
  face.first_edge = static_cast<std::uint32_t>(result.edges.size());
  face.edge_count = 0;
  result.faces.push_back(face);
}

/// Adds a face of which all is on one side of the other operand, if it bounds
/// the result.
void Engine::copy_whole(std::size_t o, std::int32_t f, bool is_near,
                        Solid& result) {
  const std::uint32_t size = operands_[o].face(f).edge_count;
  if (size == 0) return;
  const SolidEdge* edges = operands_[o].edges_of(f);
  const bool member =
      is_near ? is_inside(o, edges[0].from) : operands_[1 - o].solid->unbounded;
  const bool beyond = apply(o, false, member);
  if (apply(o, true, member) == beyond) return;
  begin_face(o, f, beyond, result);
  result.faces.back().edge_count = size;
  if (beyond) {
    for (std::uint32_t i = size; i-- > 0;)
      result.edges.push_back({edges[i].to, edges[i].from, edges[i].other});
  } else {
    result.edges.insert(result.edges.end(), edges, edges + size);
  }
  for (std::uint32_t i = 0; is_near && i < size; ++i)
    notes_.pinned.set(edges[i].from, 1);
}

/// Adds the faces of an operand that the other one does not touch, if they
/// bound the result, and notes their vertices.
void Engine::copy_untouched(std::size_t o, Solid& result) {
  const auto count =
      static_cast<std::int32_t>(operands_[o].solid->faces.size());
  std::vector<bool> member;  // by edge
  for (std::int32_t f = 0; f < count; ++f) {
    if (operands_[o].touched[static_cast<std::size_t>(f)] != 0) continue;
    const std::uint32_t size = operands_[o].face(f).edge_count;
    const SolidEdge* edges = operands_[o].edges_of(f);
    // Vertices beyond the other operand stay in any case.
    const bool is_near = overlap(operands_[o].face(f).box, operands_[o].reach);
    if (!is_near || is_row({edges, size})) {
      copy_whole(o, f, is_near, result);
      continue;
    }
    // A face need not be connected: the other operand may hold a part whole.
    member.clear();
    for (std::uint32_t i = 0; i < size; ++i) {
      const bool goes_on = i > 0 && edges[i - 1].to == edges[i].from;
      member.push_back(goes_on ? member.back() : is_inside(o, edges[i].from));
    }
    for (const bool beyond : {false, true}) {
      bool begun = false;
      for (std::uint32_t i = 0; i < size; ++i) {
        const std::uint32_t at = beyond ? size - 1 - i : i;
        if (apply(o, false, member[at]) != beyond ||
            apply(o, true, member[at]) == beyond)
          continue;
        if (!begun) begin_face(o, f, beyond, result);
        begun = true;
        SolidEdge edge = edges[at];
        if (beyond) std::swap(edge.from, edge.to);
        result.edges.push_back(edge);
        ++result.faces.back().edge_count;
        notes_.pinned.set(edge.from, 1);
      }
      if (!begun) continue;
      // A part of the face may have a smaller box.
      Face& last = result.faces.back();
      if (last.edge_count != size) last.box = face_box(result, last);
    }
  }
}

}  // namespace halfspace::fast
