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

/// Whether three points of the grid are on one line.
bool on_line(const GridPoint& p, const GridPoint& q, const GridPoint& r) {
  return cross<54>(difference(p, q), difference(p, r)) == Vector3<Int128>{};
}

/// Whether the spokes from one hub are on one line.
bool in_line(const Spoke& s, const Spoke& t, const GeometryTable& table) {
  for (const auto& [known, asked] : {std::pair(&s, &t), std::pair(&t, &s)}) {
    if (known->other >= 0) {
      // Of a solid, every face at a vertex of two edges holds both of them.
      return table.side(known->plane, asked->end) == 0 &&
             table.side(known->other, asked->end) == 0;
    }
  }
  return on_line(table.vertex(s.hub).point(), table.vertex(s.end).point(),
                 table.vertex(t.end).point());
}

/// One bucket's pieces, loop by loop, straight vertices left out.
class LoopWalk {
 public:
  /// `used` is where it notes what it has been to.
  LoopWalk(std::span<const Piece> pieces, const Hubs& hubs,
           std::vector<std::uint8_t>& used)
      : pieces_(pieces), hubs_(hubs), used_(used) {
    used_.assign(pieces.size(), 0);
  }

  void walk(std::vector<Piece>& out) {
    for (std::size_t start = 0; start < pieces_.size(); ++start) {
      if (used_[start] != 0 || is_straight(pieces_[start].from)) continue;
      std::size_t at = start;
      while (true) {
        Piece whole = pieces_[at];
        std::int32_t from = whole.from;  // of the last piece of it
        used_[at] = 1;
        at = next(at);
        // There is one that goes on, and not back to where this one began (a
        // run may be a loop), unless an operand is no solid (S6.2).
        while (at != pieces_.size() &&
               hubs_.goes_straight(from, whole.to, pieces_[at].to)) {
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
  bool is_straight(std::int32_t v) const { return hubs_.is_straight(v); }
  /// A piece not used yet that goes on from the end of piece `at`, on and not
  /// back if there is one; the number of pieces if there is none.
  std::size_t next(std::size_t at) const {
    const Piece& last = pieces_[at];
    const auto first = std::lower_bound(
        pieces_.begin(), pieces_.end(), last.to,
        [](const Piece& p, std::int32_t v) { return p.from < v; });
    std::size_t back = pieces_.size();
    for (auto p = first; p != pieces_.end() && p->from == last.to; ++p) {
      const auto i = static_cast<std::size_t>(p - pieces_.begin());
      if (used_[i] != 0) continue;
      if (p->to != last.from) return i;
      back = i;
    }
    return back;
  }

  std::span<const Piece> pieces_;
  const Hubs& hubs_;
  std::vector<std::uint8_t>& used_;
};

}  // namespace

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

void Hubs::begin(std::int32_t hub, std::size_t at, bool is_pinned) {
  if (is_pinned) {
    states_[at] = kMore;
    return;
  }
  Ends& ends = ends_[at];
  const Pair pair{
      {Spoke{hub, ends.least, -1, -1}, Spoke{hub, ends.greatest, -1, -1}}};
  ends.least = static_cast<std::int32_t>(pairs_.size());
  states_[at] = kAsked;
  pairs_.push_back(pair);
}

void Hubs::put(Pair& pair, const Spoke& spoke) {
  Spoke& known = pair.spokes[pair.spokes[0].end == spoke.end ? 0 : 1];
  if (known.other < 0) known = spoke;
}

void Hubs::decide(const GeometryTable& table) {
  for (const Pair& pair : pairs_) {
    if (!in_line(pair.spokes[0], pair.spokes[1], table)) continue;
    states_[places_.find(pair.spokes[0].hub)] = kStraight;
    any_ = true;
  }
}

namespace {

/// Puts pieces in the order of buckets.
void sort_by_bucket(List<Piece>& pieces) {
  const auto by_bucket = [](const Piece& x, const Piece& y) {
    return x.bucket < y.bucket;
  };
  if (std::is_sorted(pieces.begin(), pieces.end(), by_bucket)) return;
  List<KeyedIndex> keyed;
  keyed.reserve(pieces.size());
  for (const Piece& piece : pieces) {
    keyed.push_back({static_cast<std::uint64_t>(piece.bucket),
                     static_cast<std::uint32_t>(keyed.size())});
  }
  sort_by_key(keyed);
  List<Piece> sorted(pieces.get_allocator());
  sorted.reserve(pieces.size());
  for (const KeyedIndex& k : keyed) sorted.push_back(pieces[k.index]);
  pieces.swap(sorted);
}

}  // namespace

void walk_loops(List<Piece>& pieces, const Hubs& hubs) {
  sort_by_bucket(pieces);
  // What comes out takes the place of what went in, of which there is no less.
  auto end = pieces.begin();
  std::vector<Piece> out;
  std::vector<std::uint8_t> used;
  for (auto i = pieces.begin(); i != pieces.end();) {
    const auto j = std::find_if(i, pieces.end(), [&](const Piece& piece) {
      return piece.bucket != i->bucket;
    });
    std::sort(i, j, [](const Piece& x, const Piece& y) {
      return x.from != y.from ? x.from < y.from : x.to < y.to;
    });
    out.clear();
    LoopWalk({i, j}, hubs, used).walk(out);
    end = std::copy(out.begin(), out.end(), end);
    i = j;
  }
  pieces.erase(end, pieces.end());
}

void straighten(List<Piece>& pieces,
                const std::function<bool(std::int32_t)>& is_pinned,
                const GeometryTable& table) {
  IdRange extent;
  for (const Piece& p : pieces) {
    extent.add(p.from);
    extent.add(p.to);
  }
  const auto for_ends = [&](const auto& visit) {
    for (const Piece& p : pieces) {
      visit(p.from, p.to);
      visit(p.to, p.from);
    }
  };
  const auto for_spokes = [&](const auto& visit) {
    for (const Piece& p : pieces) {
      visit(Spoke{p.from, p.to, p.plane, p.other});
      visit(Spoke{p.to, p.from, p.plane, p.other});
    }
  };
  const auto for_more = [](const auto&) {};
  walk_loops(pieces,
             Hubs(extent, for_ends, for_spokes, for_more, is_pinned, table));
}

}  // namespace halfspace::fast
