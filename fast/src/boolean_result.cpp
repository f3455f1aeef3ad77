#include "boolean_result.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>

namespace halfspace::fast {
namespace {

/// An edge as one of its ends sees it.
struct Spoke {
  std::int32_t hub;
  std::int32_t end;
  std::int32_t plane;
  std::int32_t other;
};

/// Whether three points of the grid are on one line.
bool on_line(const GridPoint& p, const GridPoint& q, const GridPoint& r) {
  return cross<54>(difference(p, q), difference(p, r)) == Vector3<Int128>{};
}

/// Whether the spokes from one hub are on one line.
bool in_line(const Spoke& s, const Spoke& t, const Space& space) {
  for (const auto& [known, asked] : {std::pair(&s, &t), std::pair(&t, &s)}) {
    if (known->other >= 0) {
      // Never false: every face at a vertex of two edges holds both of them.
      return space.side(known->plane, asked->end) == 0 &&
             space.side(known->other, asked->end) == 0;
    }
  }
  return on_line(space.vertex(s.hub).point, space.vertex(s.end).point,
                 space.vertex(t.end).point);
}

Spoke spoke_of(const Piece& piece, bool from_end) {
  return from_end ? Spoke{piece.to, piece.from, piece.plane, piece.other}
                  : Spoke{piece.from, piece.to, piece.plane, piece.other};
}

/// The ends of pieces, and which of them are straight: all edges there are on
/// one line, and none ends there.
class Hubs {
 public:
  Hubs(const std::vector<Piece>& pieces,
       const std::function<bool(std::int32_t)>& is_pinned, const Space& space)
      : slots_(std::bit_ceil(3 * pieces.size() + 1)) {
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      for (const bool from_end : {false, true}) {
        const Spoke spoke = spoke_of(pieces[i], from_end);
        if (!is_pinned(spoke.hub)) add(spoke);
      }
    }
    for (Slot& slot : slots_) {
      if (slot.hub >= 0 && slot.ends == 2)
        slot.straight = in_line(slot.spoke(0), slot.spoke(1), space);
    }
  }

  bool is_straight(std::int32_t v) const {
    std::size_t at = first_of(v);
    while (slots_[at].hub >= 0 && slots_[at].hub != v) at = after(at);
    return slots_[at].straight;
  }

 private:
  /// A vertex with the first two of the ends of its spokes, and of each of
  /// them a spoke whose two planes are known, if there is one.
  struct Slot {
    std::int32_t hub = -1;
    std::uint8_t ends = 0;  ///< 3: more
    bool straight = false;
    std::array<std::int32_t, 2> end{}, plane{}, other{};
    Spoke spoke(std::size_t k) const {
      return {hub, end[k], plane[k], other[k]};
    }
  };

  /// Vertices have their numbers in a row, nearly: these are their hashes.
  std::size_t first_of(std::int32_t v) const {
    return static_cast<std::size_t>(v) & (slots_.size() - 1);
  }
  std::size_t after(std::size_t at) const {
    return (at + 1) & (slots_.size() - 1);
  }

  void add(const Spoke& spoke) {
    std::size_t at = first_of(spoke.hub);
    while (slots_[at].hub >= 0 && slots_[at].hub != spoke.hub) at = after(at);
    Slot& slot = slots_[at];
    slot.hub = spoke.hub;
    for (std::size_t k = 0; k < 2 && k < slot.ends; ++k) {
      if (slot.end[k] != spoke.end) continue;
      if (slot.other[k] < 0) put(slot, k, spoke);
      return;
    }
    if (slot.ends < 2) put(slot, slot.ends, spoke);
    if (slot.ends < 3) ++slot.ends;
  }
  static void put(Slot& slot, std::size_t k, const Spoke& spoke) {
    slot.end[k] = spoke.end;
    slot.plane[k] = spoke.plane;
    slot.other[k] = spoke.other;
  }

  std::vector<Slot> slots_;
};

/// One bucket's pieces, loop by loop, straight vertices left out.
class LoopWalk {
 public:
  LoopWalk(std::span<const Piece> pieces, const Hubs& hubs)
      : pieces_(pieces), hubs_(hubs), used_(pieces.size()) {}

  void walk(std::vector<Piece>& out) {
    for (std::size_t start = 0; start < pieces_.size(); ++start) {
      if (used_[start] || is_straight(pieces_[start].from)) continue;
      std::size_t at = start;
      while (true) {
        Piece whole = pieces_[at];
        used_[at] = true;
        while (is_straight(whole.to)) {
          at = next(at);
          used_[at] = true;
          whole.to = pieces_[at].to;
          whole.other = std::max(whole.other, pieces_[at].other);
        }
        out.push_back(whole);
        at = next(at);
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
      if (used_[i]) continue;
      if (p->to != last.from) return i;
      back = i;
    }
    return back;
  }

  std::span<const Piece> pieces_;
  const Hubs& hubs_;
  std::vector<bool> used_;
};

}  // namespace

Box face_box(const Solid& solid, const Face& face) {
  Box box = kEmptyBox;
  for (std::uint32_t i = 0; i < face.edge_count; ++i) {
    const std::int32_t v = solid.edges[face.first_edge + i].from;
    extend(box, solid.space->vertex(v).approximate);
  }
  // One without edges is all of its plane.
  if (face.edge_count == 0) std::swap(box.low, box.high);
  return box;
}

void straighten(std::vector<Piece>& pieces,
                const std::function<bool(std::int32_t)>& is_pinned,
                const Space& space) {
  const Hubs hubs(pieces, is_pinned, space);
  std::sort(pieces.begin(), pieces.end(), [](const Piece& x, const Piece& y) {
    return std::tie(x.bucket, x.from, x.to) < std::tie(y.bucket, y.from, y.to);
  });
  std::vector<Piece> out;
  out.reserve(pieces.size());
  for (std::size_t i = 0; i < pieces.size();) {
    std::size_t j = i + 1;
    while (j < pieces.size() && pieces[j].bucket == pieces[i].bucket) ++j;
    LoopWalk({pieces.data() + i, j - i}, hubs).walk(out);
    i = j;
  }
  pieces.swap(out);
}

}  // namespace halfspace::fast
