#include "solid/loops.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>

#include "base/radix_sort.hpp"
#include "solid/vertex_stars.hpp"

namespace halfspace::fast {
namespace {

/// One bucket's pieces, loop by loop, straight vertices left out.
class LoopTracer {
 public:
  /// `used` is where it notes what it has been to.
  LoopTracer(std::span<const DirectedEdge> pieces, const VertexStars& stars,
             std::vector<std::uint8_t>& used)
      : pieces_(pieces), stars_(stars), used_(used) {
    used_.assign(pieces.size(), 0);
  }

  void walk(std::vector<DirectedEdge>& out) {
    for (std::size_t start = 0; start < pieces_.size(); ++start) {
      if (used_[start] != 0 || is_straight(pieces_[start].from)) continue;
      std::size_t at = start;
      while (true) {
        DirectedEdge whole = pieces_[at];
        std::int32_t from = whole.from;  // of the last piece of it
        used_[at] = 1;
        at = next(at);
        // There is one that goes on, and not back to where this one began (a
        // run may be a loop), unless an operand is no solid (S6.2).
        while (at != pieces_.size() &&
               stars_.goes_straight(from, whole.to, pieces_[at].to)) {
          used_[at] = 1;
          from = pieces_[at].from;
          whole.to = pieces_[at].to;
          whole.other = std::max(whole.other, pieces_[at].other);
          at = next(at);
        }
        if (whole.from != whole.to || whole.run_count > 0) out.push_back(whole);
        if (at == pieces_.size()) break;
      }
    }
  }

 private:
  bool is_straight(std::int32_t v) const { return stars_.is_straight(v); }
  /// A piece not used yet that goes on from the end of piece `at`, on and not
  /// back if there is one; the number of pieces if there is none.
  std::size_t next(std::size_t at) const {
    const DirectedEdge& last = pieces_[at];
    const auto first = std::lower_bound(
        pieces_.begin(), pieces_.end(), last.to,
        [](const DirectedEdge& p, std::int32_t v) { return p.from < v; });
    std::size_t back = pieces_.size();
    for (auto p = first; p != pieces_.end() && p->from == last.to; ++p) {
      const auto i = static_cast<std::size_t>(p - pieces_.begin());
      if (used_[i] != 0) continue;
      if (p->to != last.from) return i;
      back = i;
    }
    return back;
  }

  std::span<const DirectedEdge> pieces_;
  const VertexStars& stars_;
  std::vector<std::uint8_t>& used_;
};

}  // namespace

bool are_packed(const Solid& solid) {
  std::uint32_t next = 0;
  bool in_line = true;
  for (const Face& face : solid.faces) {
    in_line = in_line && face.first_edge == next;
    next += face.edge_count;
  }
  return in_line && next == solid.edges.size();
}

void pack_edges(Solid& solid) {
  if (are_packed(solid)) return;
  List<SolidEdge> row;
  row.reserve(solid.edges.size());
  for (Face& face : solid.faces) {
    const auto edges =
        std::span(solid.edges).subspan(face.first_edge, face.edge_count);
    face.first_edge = static_cast<std::uint32_t>(row.size());
    row.insert(row.end(), edges.begin(), edges.end());
  }
  solid.edges = std::move(row);
}

Box face_box(const Solid& solid, const Face& face) {
  Box box = kEmptyBox;
  // One without edges is all of its plane.
  if (face.edge_count == 0) {
    std::swap(box.low, box.high);
    return box;
  }
  Bounds bounds;
  for (std::uint32_t i = 0; i < face.edge_count; ++i) {
    const std::int32_t id = solid.edges[face.first_edge + i].from;
    bounds.add(solid.table->vertex(id).approximate);
  }
  return bounds.box();
}

namespace {

/// Puts pieces in the order of buckets.
void sort_by_bucket(List<DirectedEdge>& pieces) {
  const auto by_bucket = [](const DirectedEdge& x, const DirectedEdge& y) {
    return x.bucket < y.bucket;
  };
  if (std::is_sorted(pieces.begin(), pieces.end(), by_bucket)) return;
  List<KeyedIndex> keyed;
  keyed.reserve(pieces.size());
  for (const DirectedEdge& piece : pieces) {
    keyed.push_back({static_cast<std::uint64_t>(piece.bucket),
                     static_cast<std::uint32_t>(keyed.size())});
  }
  sort_by_key(keyed);
  List<DirectedEdge> sorted(pieces.get_allocator());
  sorted.reserve(pieces.size());
  for (const KeyedIndex& k : keyed) sorted.push_back(pieces[k.index]);
  pieces.swap(sorted);
}

}  // namespace

void trace_loops(List<DirectedEdge>& pieces, const VertexStars& stars) {
  sort_by_bucket(pieces);
  // The result has no more edges than the input and takes its place.
  auto end = pieces.begin();
  FaceTracer tracer;
  for (auto i = pieces.begin(); i != pieces.end();) {
    const auto j = std::find_if(
        i, pieces.end(),
        [&](const DirectedEdge& piece) { return piece.bucket != i->bucket; });
    const auto out = tracer.traced({i, j}, stars);
    end = std::copy(out.begin(), out.end(), end);
    i = j;
  }
  pieces.erase(end, pieces.end());
}

std::span<const DirectedEdge> FaceTracer::traced(std::span<DirectedEdge> pieces,
                                                 const VertexStars& stars) {
  std::sort(pieces.begin(), pieces.end(),
            [](const DirectedEdge& x, const DirectedEdge& y) {
              return x.from != y.from ? x.from < y.from : x.to < y.to;
            });
  out_.clear();
  LoopTracer(pieces, stars, used_).walk(out_);
  return out_;
}

VertexStars stars_of(std::span<const List<DirectedEdge>> lists,
                     const std::function<bool(std::int32_t)>& is_pinned,
                     const GeometryTable& table) {
  const auto for_pieces = [&](const auto& visit) {
    for (const List<DirectedEdge>& pieces : lists) {
      for (const DirectedEdge& p : pieces) visit(p);
    }
  };
  IdRange extent;
  for_pieces([&](const DirectedEdge& p) {
    extent.add(p.from);
    extent.add(p.to);
  });
  const auto for_ends = [&](const auto& visit) {
    for_pieces([&](const DirectedEdge& p) {
      visit(p.from, p.to);
      visit(p.to, p.from);
    });
  };
  const auto for_incident_edges = [&](const auto& visit) {
    for_pieces([&](const DirectedEdge& p) {
      visit(IncidentEdge{p.from, p.to, p.plane, p.other});
      visit(IncidentEdge{p.to, p.from, p.plane, p.other});
    });
  };
  const auto for_more = [](const auto&) {};
  return {extent, for_ends, for_incident_edges, for_more, is_pinned, table};
}

void drop_collinear_vertices(List<DirectedEdge>& pieces,
                             const std::function<bool(std::int32_t)>& is_pinned,
                             const GeometryTable& table) {
  const std::span<const List<DirectedEdge>> one(&pieces, 1);
  const VertexStars stars = stars_of(one, is_pinned, table);
  trace_loops(pieces, stars);
}

}  // namespace halfspace::fast
