#include "boolean_result.hpp"

#include <algorithm>
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
      return space.side(known->plane, asked->end) == 0 &&
             space.side(known->other, asked->end) == 0;
    }
  }
  return on_line(space.vertex(s.hub).point, space.vertex(s.end).point,
                 space.vertex(t.end).point);
}

/// The straight vertices among the ends of the pieces, in order.
std::vector<std::int32_t> straight_vertices(
    const std::vector<Piece>& pieces,
    const std::function<bool(std::int32_t)>& is_pinned, const Space& space) {
  std::vector<Spoke> spokes;
  for (const Piece& p : pieces) {
    if (!is_pinned(p.from)) spokes.push_back({p.from, p.to, p.plane, p.other});
    if (!is_pinned(p.to)) spokes.push_back({p.to, p.from, p.plane, p.other});
  }
  // Of the spokes to one end, one whose two planes are known comes first.
  std::sort(spokes.begin(), spokes.end(), [](const Spoke& x, const Spoke& y) {
    return std::tuple(x.hub, x.end, -x.other, x.plane) <
           std::tuple(y.hub, y.end, -y.other, y.plane);
  });
  std::vector<std::int32_t> straight;
  for (std::size_t i = 0; i < spokes.size();) {
    std::size_t ends = 0;
    const Spoke* first = &spokes[i];
    const Spoke* second = nullptr;
    std::size_t j = i;
    for (; j < spokes.size() && spokes[j].hub == first->hub; ++j) {
      if (j > i && spokes[j].end == spokes[j - 1].end) continue;
      ++ends;
      if (ends == 2) second = &spokes[j];
    }
    if (ends == 2 && in_line(*first, *second, space))
      straight.push_back(first->hub);
    i = j;
  }
  return straight;
}

/// One bucket's pieces, loop by loop, straight vertices left out.
class LoopWalk {
 public:
  LoopWalk(std::span<const Piece> pieces,
           const std::vector<std::int32_t>& straight)
      : pieces_(pieces), straight_(straight), used_(pieces.size()) {}

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
  bool is_straight(std::int32_t v) const {
    return std::binary_search(straight_.begin(), straight_.end(), v);
  }
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
  const std::vector<std::int32_t>& straight_;
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
  const auto straight = straight_vertices(pieces, is_pinned, space);
  std::sort(pieces.begin(), pieces.end(), [](const Piece& x, const Piece& y) {
    return std::tie(x.bucket, x.from, x.to) < std::tie(y.bucket, y.from, y.to);
  });
  std::vector<Piece> out;
  out.reserve(pieces.size());
  for (std::size_t i = 0; i < pieces.size();) {
    std::size_t j = i + 1;
    while (j < pieces.size() && pieces[j].bucket == pieces[i].bucket) ++j;
    LoopWalk({pieces.data() + i, j - i}, straight).walk(out);
    i = j;
  }
  pieces.swap(out);
}

}  // namespace halfspace::fast
