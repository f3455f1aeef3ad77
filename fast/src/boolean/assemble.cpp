#include "boolean/assemble.hpp"

#include <algorithm>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "base/check.hpp"
#include "base/parallel.hpp"
#include "base/threads.hpp"
#include "boolean/classify.hpp"
#include "boolean/emit.hpp"
#include "halfspace/assert.hpp"
#include "intersect/far_rows.hpp"
#include "solid/bucket_order.hpp"
#include "solid/vertex_stars.hpp"

namespace halfspace::fast {
namespace {

/// Whether each edge begins where the one before it ends.
bool is_row(std::span<const SolidEdge> edges) {
  for (std::size_t i = 1; i < edges.size(); ++i) {
    if (edges[i - 1].to != edges[i].from) return false;
  }
  return true;
}

/// Faces in the making, and the packets of their edges.
struct Making {
  Solid solid;
  EdgePackets blocks;
  /// Those of the last face that are known.
  std::vector<EdgePacket> known;
};

/// Step 3 of a boolean: copies the faces that the other operand does not touch,
/// adds the far edges of the others in runs, and joins the directed edges to
/// faces.
class Assembler {
 public:
  /// `pieces`: what Emitter::run() gives.
  Assembler(Arrangement& arrangement, Classifier& classifier,
            std::vector<List<DirectedEdge>> pieces)
      : common_(arrangement),
        classifier_(classifier),
        operands_(arrangement.operands),
        table_(arrangement.table),
        scratch_(arrangement.scratch),
        pieces_(std::move(pieces)) {}

  Assembled run();

 private:
  void begin_face(std::size_t o, std::int32_t face, bool flipped,
                  Making& to) const;
  void copy_untouched(std::size_t o, Making& to);
  void copy_common(std::size_t o, std::int32_t face, Making& to);
  void copy_whole(std::size_t o, std::int32_t face, bool is_near, Making& to);
  void copy_between(std::size_t o, std::int32_t face, bool beyond, bool behind,
                    bool is_near, Making& to);
  bool is_far(std::size_t o, std::int32_t face) const;
  std::int32_t copy_far(std::size_t o, std::int32_t first, Making& to);
  void copy_row(std::size_t o, std::int32_t first, std::int32_t last,
                Making& to);
  void add_runs(std::size_t o);
  void add_run(std::size_t o, std::int32_t face, bool beyond,
               const FarRows::Row& row);
  VertexStars stars() const;
  void add_touched(Making& to) const;
  void add_faces(std::span<const DirectedEdge* const> pieces,
                 const VertexStars& stars, Making& to) const;
  void add_edge(const DirectedEdge& piece, Making& to) const;
  static void end_face(Making& to);
  static void append(Making&& part, Making& to);

  Arrangement& common_;
  Classifier& classifier_;
  std::array<Operand, 2>& operands_;
  GeometryTable& table_;
  BooleanScratch& scratch_;
  std::vector<List<DirectedEdge>> pieces_;
};

Assembled Assembler::run() {
  // Step 1: the faces that meet nothing, as they are.
  Making to;
  Solid& result = to.solid;
  result.unit = operands_[0].solid->unit;
  result.table = operands_[0].solid->table;
  result.is_conforming = common_.is_conforming(0) && common_.is_conforming(1);
  result.unbounded = is_member(common_.operation, operands_[0].solid->unbounded,
                               operands_[1].solid->unbounded);
  scratch_.kept.clear();
  std::size_t faces = 0, edges = 0;
  for (const Operand& operand : operands_) {
    faces += operand.solid->faces.size();
    edges += operand.solid->edges.size();
  }
  result.faces.reserve(faces);
  result.edges.reserve(edges);
  for (std::size_t o = 0; o < 2; ++o) copy_untouched(o, to);
  // Step 2: what is left of the others.
  pieces_.emplace_back();
  for (std::size_t o = 0; o < 2; ++o) add_runs(o);
  add_touched(to);
  return {std::move(to.solid), std::move(to.blocks)};
}

/// The pieces' ends, and which of them are collinear vertices.
VertexStars Assembler::stars() const {
  const auto is_pinned = [this](std::int32_t v) {
    if (scratch_.kept.get(v, 0) != 0) return true;
    // A vertex beyond an operand may belong to faces that are not here. If two
    // edges in line meet there, one goes on as a run or is kept.
    for (const std::size_t o : {0u, 1u}) {
      // For a solid, true only if doubles are too coarse to see such an edge.
      if (common_.is_beyond_other(o, v)) return true;
    }
    return false;
  };
  return stars_of(pieces_, is_pinned, table_);
}

/// Adds the faces that pieces bound, in the order of buckets. Threads make
/// parts of the result, of faces in a row.
void Assembler::add_touched(Making& to) const {
  const int threads = common_.threads();
  const VertexStars all = stars();
  const List<const DirectedEdge*> pieces = in_order_of_buckets(
      pieces_,
      {operands_[0].solid->faces.size(), operands_[1].solid->faces.size()},
      threads);
  constexpr std::size_t kPart = 8192;  // untuned
  if (!kManyThreads || threads <= 1 || pieces.size() < 2 * kPart) {
    add_faces(pieces, all, to);
    return;
  }
  std::vector<std::size_t> first{0};
  for (std::size_t at = kPart; at < pieces.size(); at += kPart) {
    at = std::max(at, first.back());
    while (at < pieces.size() && pieces[at]->bucket == pieces[at - 1]->bucket)
      ++at;
    first.push_back(at);
  }
  if (first.back() < pieces.size()) first.push_back(pieces.size());
  std::vector<Making> parts(first.size() - 1);
  for_blocks(
      threads, parts.size(), 1, [&](std::size_t k, std::size_t, std::size_t) {
        parts[k].solid.table = to.solid.table;
        add_faces(std::span(pieces).subspan(first[k], first[k + 1] - first[k]),
                  all, parts[k]);
      });
  for (Making& part : parts) append(std::move(part), to);
}

/// Adds the faces that some pieces bound, all pieces of each.
void Assembler::add_faces(std::span<const DirectedEdge* const> pieces,
                          const VertexStars& all, Making& to) const {
  FaceTracer tracer;
  std::vector<DirectedEdge> of_face;
  for (std::size_t i = 0; i < pieces.size();) {
    const std::int64_t bucket = pieces[i]->bucket;
    of_face.clear();
    for (; i < pieces.size() && pieces[i]->bucket == bucket; ++i)
      of_face.push_back(*pieces[i]);
    const auto traced = tracer.traced(of_face, all);
    if (traced.empty()) continue;
    const auto o = static_cast<std::size_t>(bucket >> 40);
    // Converted, a bucket has lost what is before the face.
    const auto face = static_cast<std::int32_t>(bucket >> 1);
    begin_face(o, face, bucket % 2 != 0, to);
    for (const DirectedEdge& piece : traced) add_edge(piece, to);
    end_face(to);
  }
}

/// Adds the faces of a part to the last ones.
void Assembler::append(Making&& part, Making& to) {
  List<Face>& faces = to.solid.faces;
  const auto edges = static_cast<std::uint32_t>(to.solid.edges.size());
  for (std::size_t f = 0; f < part.solid.faces.size(); ++f) {
    faces.push_back(part.solid.faces[f]);
    faces.back().first_edge += edges;
    if (EdgePackets::has_many(faces.back())) {
      to.blocks.set(faces.size() - 1,
                    part.blocks.shared(static_cast<std::int32_t>(f)));
    }
  }
  to.solid.edges.insert(to.solid.edges.end(), part.solid.edges.begin(),
                        part.solid.edges.end());
}

/// Adds an edge to the last face, or the run that the piece stands for.
void Assembler::add_edge(const DirectedEdge& piece, Making& to) const {
  Solid& result = to.solid;
  const std::uint32_t at = result.faces.back().edge_count;
  result.faces.back().edge_count += std::max(piece.run_count, 1u);
  if (piece.run_count == 0) {
    result.edges.push_back({piece.from, piece.to, piece.other});
    return;
  }
  const Operand& operand =
      operands_[static_cast<std::size_t>(piece.bucket >> 40)];
  HALFSPACE_CHECK(result.faces.back().source ==
                  static_cast<std::int32_t>(piece.bucket >> 1));
  const auto run =
      std::span(operand.solid->edges).subspan(piece.run_first, piece.run_count);
  if (piece.bucket % 2 != 0) {
    for (auto edge = run.rbegin(); edge != run.rend(); ++edge)
      result.edges.push_back({edge->to, edge->from, edge->other});
    return;
  }
  result.edges.insert(result.edges.end(), run.begin(), run.end());
  // The blocks that are in the run whole are the new face's, too.
  const std::int32_t f = result.faces.back().source;
  const PacketList* list = operand.blocks->of(f);
  if (list == nullptr) return;
  const std::uint32_t first = piece.run_first - operand.face(f).first_edge;
  const auto blocks = list->blocks();
  auto block = std::partition_point(
      blocks.begin(), blocks.end(),
      [first](const EdgePacket& b) { return b.first < first; });
  for (; block != blocks.end() &&
         block->first + block->count <= first + piece.run_count;
       ++block) {
    to.known.push_back(*block);
    to.known.back().first += at - first;
  }
}

/// Finds the last face's box, from that of its blocks if it has any.
void Assembler::end_face(Making& to) {
  Solid& result = to.solid;
  Face& face = result.faces.back();
  HALFSPACE_CHECK(face.edge_count != 0);
  HALFSPACE_CHECK(face.first_edge + face.edge_count == result.edges.size());
  if (EdgePackets::has_many(face)) {
    auto list = std::make_shared<const PacketList>(result, face, to.known);
    face.box = list->box();
    to.blocks.set(result.faces.size() - 1, std::move(list));
  } else {
    face.box = face_box(result, face);
  }
  to.known.clear();
}

/// Adds the far edges of the faces that the other operand touches, if they
/// bound the result, in rows as long as can be.
void Assembler::add_runs(std::size_t o) {
  const Operand& operand = operands_[o];
  const bool member = operands_[1 - o].solid->unbounded;
  const bool beyond = common_.is_in_result(o, false, member);
  if (common_.is_in_result(o, true, member) == beyond) return;
  for (const std::int32_t f : operand.active) {
    if (operand.touched[static_cast<std::size_t>(f)] == 0) continue;
    FarRows rows(operand, f);
    while (const auto row = rows.next()) add_run(o, f, beyond, *row);
  }
}

void Assembler::add_run(std::size_t o, std::int32_t f, bool beyond,
                        const FarRows::Row& row) {
  const Face& face = operands_[o].face(f);
  const SolidEdge* edges = operands_[o].edges_of(f);
  HALFSPACE_CHECK(row.first < row.last && row.last <= face.edge_count);
  HALFSPACE_CHECK(operands_[o].edge_of[face.first_edge + row.first] < 0);
  DirectedEdge run{bucket_of(o, f, beyond), face.plane, edges[row.first].from,
                   edges[row.last - 1].to};
  if (beyond) std::swap(run.from, run.to);
  run.run_first = face.first_edge + row.first;
  run.run_count = row.last - row.first;
  scratch_.kept.set(run.from, 1);
  scratch_.kept.set(run.to, 1);
  pieces_.back().push_back(run);
}

/// Begins a face of the result that is a part of face `f`.
void Assembler::begin_face(std::size_t o, std::int32_t f, bool flipped,
                           Making& to) const {
  Solid& result = to.solid;
  Face face = operands_[o].face(f);
  face.flipped = face.flipped != flipped;
  face.from_first = o == 0;
  face.source = f;
  face.first_edge = static_cast<std::uint32_t>(result.edges.size());
  face.edge_count = 0;
  result.faces.push_back(face);
}

/// Adds a face of which all is on one side of the other operand, if it bounds
/// the result.
void Assembler::copy_whole(std::size_t o, std::int32_t f, bool is_near,
                           Making& to) {
  if (operands_[o].face(f).edge_count == 0) return;
  const bool member =
      is_near ? classifier_.is_inside(o, operands_[o].edges_of(f)[0].from)
              : operands_[1 - o].solid->unbounded;
  copy_between(o, f, common_.is_in_result(o, false, member),
               common_.is_in_result(o, true, member), is_near, to);
}

/// Adds a face that both operands have, as the first one's (S6.4), if it bounds
/// the result.
void Assembler::copy_common(std::size_t o, std::int32_t f, Making& to) {
  if (o != 0) return;
  const bool is_same = operands_[0].common_at(f) == Operand::kSame;
  copy_between(0, f, common_.is_in_result(0, false, !is_same),
               common_.is_in_result(0, true, is_same), /*is_near=*/true, to);
}

/// Adds a face with or without the result in front of it and behind it.
void Assembler::copy_between(std::size_t o, std::int32_t f, bool beyond,
                             bool behind, bool is_near, Making& to) {
  if (beyond == behind) return;
  Solid& result = to.solid;
  const std::uint32_t size = operands_[o].face(f).edge_count;
  const SolidEdge* edges = operands_[o].edges_of(f);
  begin_face(o, f, beyond, to);
  result.faces.back().edge_count = size;
  if (beyond) {
    for (std::uint32_t i = size; i-- > 0;)
      result.edges.push_back({edges[i].to, edges[i].from, edges[i].other});
    end_face(to);
  } else {
    result.edges.insert(result.edges.end(), edges, edges + size);
    to.blocks.set(result.faces.size() - 1, operands_[o].blocks->shared(f));
  }
  for (std::uint32_t i = 0; is_near && i < size; ++i)
    scratch_.kept.set(edges[i].from, 1);
}

/// Whether the face is outside the other operand's box.
bool Assembler::is_far(std::size_t o, std::int32_t f) const {
  const Operand& operand = operands_[o];
  return !overlap(operand.face(f).box, operand.reach);
}

/// Adds up to 256 far faces from number `first` on, if they bound the result:
/// as long as their edges stand in a row, and few enough to be in the cache
/// when they are copied. Returns the number of the next face.
std::int32_t Assembler::copy_far(std::size_t o, std::int32_t first,
                                 Making& to) {
  constexpr std::size_t kMost = 256;
  const Operand& operand = operands_[o];
  const auto count = static_cast<std::int32_t>(std::min(
      operand.solid->faces.size(), static_cast<std::size_t>(first) + kMost));
  std::int32_t last = first;
  std::uint32_t edge = operand.face(first).first_edge;
  do {
    edge += operand.face(last).edge_count;
    ++last;
  } while (last < count && is_far(o, last) &&
           operand.face(last).first_edge == edge);
  const bool member = operands_[1 - o].solid->unbounded;
  const bool beyond = common_.is_in_result(o, false, member);
  if (common_.is_in_result(o, true, member) == beyond) return last;
  if (!beyond) {
    copy_row(o, first, last, to);
  } else {
    for (std::int32_t f = first; f < last; ++f)
      copy_whole(o, f, /*is_near=*/false, to);
  }
  return last;
}

/// Adds the faces from number `first` to before `last` as they are.
/// Requires: their edges stand in a row.
void Assembler::copy_row(std::size_t o, std::int32_t first, std::int32_t last,
                         Making& to) {
  Solid& result = to.solid;
  const Operand& operand = operands_[o];
  const auto faces = std::span(operand.solid->faces)
                         .subspan(static_cast<std::size_t>(first),
                                  static_cast<std::size_t>(last - first));
  const std::uint32_t first_edge = faces.front().first_edge;
  const auto edges =
      std::span(operand.solid->edges)
          .subspan(first_edge, faces.back().first_edge +
                                   faces.back().edge_count - first_edge);
  const auto at = static_cast<std::uint32_t>(result.edges.size());
  const std::size_t before = result.faces.size();
  result.edges.insert(result.edges.end(), edges.begin(), edges.end());
  result.faces.insert(result.faces.end(), faces.begin(), faces.end());
  HALFSPACE_CHECK(edges.size() >= faces.size());
  for (std::int32_t f = first; f < last; ++f) {
    HALFSPACE_CHECK(!common_.is_touched(o, f));
    const std::size_t copy = before + static_cast<std::size_t>(f - first);
    Face& face = result.faces[copy];
    face.from_first = o == 0;
    face.source = f;
    face.first_edge = face.first_edge - first_edge + at;
    to.blocks.set(copy, operand.blocks->shared(f));
  }
}

/// Adds the faces of an operand that the other one does not touch, if they
/// bound the result, and notes their vertices.
void Assembler::copy_untouched(std::size_t o, Making& to) {
  Solid& result = to.solid;
  const auto count =
      static_cast<std::int32_t>(operands_[o].solid->faces.size());
  std::vector<bool> member;  // by edge
  for (std::int32_t next = 0; next < count;) {
    if (is_far(o, next)) {
      // Vertices beyond the other operand stay in any case.
      next = copy_far(o, next, to);
      continue;
    }
    const std::int32_t f = next++;
    if (operands_[o].common_at(f) != Operand::kNotCommon) {
      copy_common(o, f, to);
      continue;
    }
    if (operands_[o].touched[static_cast<std::size_t>(f)] != 0) continue;
    const std::uint32_t size = operands_[o].face(f).edge_count;
    const SolidEdge* edges = operands_[o].edges_of(f);
    if (is_row({edges, size})) {
      copy_whole(o, f, /*is_near=*/true, to);
      continue;
    }
    // A face need not be connected: the other operand may hold a part whole.
    member.clear();
    for (std::uint32_t i = 0; i < size; ++i) {
      const bool goes_on = i > 0 && edges[i - 1].to == edges[i].from;
      member.push_back(goes_on ? member.back()
                               : classifier_.is_inside(o, edges[i].from));
    }
    for (const bool beyond : {false, true}) {
      bool begun = false;
      for (std::uint32_t i = 0; i < size; ++i) {
        const std::uint32_t at = beyond ? size - 1 - i : i;
        if (common_.is_in_result(o, false, member[at]) != beyond ||
            common_.is_in_result(o, true, member[at]) == beyond)
          continue;
        if (!begun) begin_face(o, f, beyond, to);
        begun = true;
        SolidEdge edge = edges[at];
        if (beyond) std::swap(edge.from, edge.to);
        result.edges.push_back(edge);
        ++result.faces.back().edge_count;
        scratch_.kept.set(edge.from, 1);
      }
      if (!begun) continue;
      if (result.faces.back().edge_count != size || beyond) {
        // A part of the face may have a smaller box.
        end_face(to);
      } else {
        to.blocks.set(result.faces.size() - 1, operands_[o].blocks->shared(f));
      }
    }
  }
}

}  // namespace

Assembled assembled(Arrangement& arrangement) {
  HALFSPACE_ASSERT(arrangement.conforms(0) && arrangement.conforms(1));
  arrangement.index();
  Classifier classifier(arrangement);
  std::vector<List<DirectedEdge>> pieces =
      Emitter::run(arrangement, classifier, arrangement.threads());
  return Assembler(arrangement, classifier, std::move(pieces)).run();
}

}  // namespace halfspace::fast
