#include "triangulate.hpp"

#include <algorithm>

#include "face_view.hpp"

namespace halfspace::fast {
namespace {

/// Triangulates by a sweep from left to right.
///
/// Between an edge below and one above, with the face between, the vertices
/// passed and not yet cut off are a chain from the left end of the one to that
/// of the other. It turns nowhere to the right, for what does is cut off when
/// a vertex comes to either end of it.
class Sweep {
 public:
  Sweep(const FaceView& view,
        std::vector<std::array<std::int32_t, 3>>& triangles)
      : view_(view), triangles_(triangles) {}

  void run(std::vector<SolidEdge> edges) {
    std::vector<Side> sides;
    for (const SolidEdge& edge : edges) {
      const bool rightwards = view_.before(edge.from, edge.to);
      sides.push_back({rightwards ? edge.from : edge.to,
                       rightwards ? edge.to : edge.from,
                       rightwards,
                       {}});
    }
    std::sort(sides.begin(), sides.end(), [&](const Side& a, const Side& b) {
      return a.left != b.left ? view_.before(a.left, b.left) : is_below(a, b);
    });
    std::vector<std::int32_t> vertices;
    for (const Side& side : sides) {
      vertices.push_back(side.left);
      vertices.push_back(side.right);
    }
    std::sort(
        vertices.begin(), vertices.end(),
        [&](std::int32_t u, std::int32_t v) { return view_.before(u, v); });
    vertices.erase(std::unique(vertices.begin(), vertices.end()),
                   vertices.end());
    auto next = sides.begin();
    for (const std::int32_t v : vertices) {
      const auto first = next;
      while (next != sides.end() && next->left == v) ++next;
      pass(v, {first, next});
    }
  }

 private:
  using Chain = std::vector<std::int32_t>;

  /// An edge from left to right. Where the face is above it, the chain of what
  /// is between it and the next one.
  struct Side {
    std::int32_t left;
    std::int32_t right;
    bool face_above;
    Chain chain;
  };

  /// Of two sides with one left end. Where they agree, the face is below the
  /// lower one and above the upper one.
  bool is_below(const Side& a, const Side& b) const {
    const int turn = view_.turn(a.left, a.right, b.right);
    return turn != 0 ? turn > 0 : !a.face_above && b.face_above;
  }

  void pass(std::int32_t v, std::vector<Side> starting) {
    // Step 1: the sides that end here; those before them are below.
    const auto first = std::partition_point(
        active_.begin(), active_.end(), [&](const Side& side) {
          return side.right != v && view_.turn(side.left, side.right, v) > 0;
        });
    auto last = first;
    while (last != active_.end() && last->right == v) ++last;
    // Step 2: the chains below and above the vertex.
    Chain below, above;
    if (first == last) {
      if (first != active_.begin() && (first - 1)->face_above)
        part((first - 1)->chain, v, below, above);
    } else {
      if (first != active_.begin() && (first - 1)->face_above) {
        below = std::move((first - 1)->chain);
        add_top(below, v);
      }
      for (auto side = first; side + 1 != last; ++side) {
        if (side->face_above) add_top(side->chain, v);
      }
      if ((last - 1)->face_above) {
        above = std::move((last - 1)->chain);
        add_bottom(above, v);
      }
    }
    // Step 3: the sides that start here, or the two chains as one.
    if (starting.empty()) {
      if (!below.empty() && !above.empty())
        below.insert(below.end(), above.begin() + 1, above.end());
    } else {
      for (Side& side : starting) {
        if (side.face_above) side.chain = {v};
      }
      if (!above.empty()) starting.back().chain = std::move(above);
    }
    if (!below.empty()) (first - 1)->chain = std::move(below);
    const auto at = active_.erase(first, last);
    active_.insert(at, std::make_move_iterator(starting.begin()),
                   std::make_move_iterator(starting.end()));
  }

  /// Parts a chain at its last vertex to the right, which sees v.
  void part(const Chain& chain, std::int32_t v, Chain& below, Chain& above) {
    const auto middle = std::max_element(
        chain.begin(), chain.end(),
        [&](std::int32_t a, std::int32_t b) { return view_.before(a, b); });
    below.assign(chain.begin(), middle + 1);
    above.assign(middle, chain.end());
    add_top(below, v);
    add_bottom(above, v);
  }

  void add_top(Chain& chain, std::int32_t v) {
    while (chain.size() > 1 && cut(chain[chain.size() - 2], chain.back(), v))
      chain.pop_back();
    chain.push_back(v);
  }
  void add_bottom(Chain& chain, std::int32_t v) {
    std::size_t dropped = 0;
    while (chain.size() > dropped + 1 &&
           cut(v, chain[dropped], chain[dropped + 1]))
      ++dropped;
    chain.erase(chain.begin(),
                chain.begin() + static_cast<std::ptrdiff_t>(dropped));
    chain.insert(chain.begin(), v);
  }

  /// Cuts off the triangle of three vertices in a row, upwards, if it is on
  /// their right.
  bool cut(std::int32_t a, std::int32_t b, std::int32_t c) {
    if (view_.turn(a, b, c) >= 0) return false;
    triangles_.push_back({a, c, b});
    return true;
  }

  const FaceView& view_;
  std::vector<std::array<std::int32_t, 3>>& triangles_;
  std::vector<Side> active_;  ///< from below upwards
};

}  // namespace

void triangulate(const Solid& solid, const Face& face,
                 std::vector<std::array<std::int32_t, 3>>& triangles) {
  const FaceView view(solid, face);
  const auto first =
      solid.edges.begin() + static_cast<std::ptrdiff_t>(face.first_edge);
  Sweep(view, triangles)
      .run({first, first + static_cast<std::ptrdiff_t>(face.edge_count)});
}

}  // namespace halfspace::fast
