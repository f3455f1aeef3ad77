#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "boolean_result.hpp"
#include "places.hpp"

namespace halfspace::fast {

/// An edge as one of its ends sees it.
struct Spoke {
  std::int32_t hub;
  std::int32_t end;
  std::int32_t plane;
  std::int32_t other;
};

/// The ends of edges, and which of them are straight: all edges there are on
/// one line, and none ends there.
class Hubs {
 public:
  /// `for_spokes(visit)` visits every edge's two spokes. What is pinned is
  /// never straight.
  template <class ForSpokes, class IsPinned>
  Hubs(const ForSpokes& for_spokes, const IsPinned& is_pinned,
       const Space& space)
      : places_(extent_of(for_spokes)), ends_(places_.size()) {
    for_spokes([this](const Spoke& spoke) { count(spoke); });
    if (std::none_of(ends_.begin(), ends_.end(),
                     [](const Ends& ends) { return ends.state == kTwo; }))
      return;
    for_spokes([&](const Spoke& spoke) {
      Ends& ends = ends_[places_(spoke.hub)];
      if (ends.state == kTwo) begin(spoke.hub, ends, is_pinned(spoke.hub));
      if (ends.state == kAsked) put(pairs_[ends.pair()], spoke);
    });
    decide(space);
  }

  /// Whether any vertex is.
  bool any_straight() const { return any_; }
  /// Requires: one of the edges ends at the vertex.
  bool is_straight(std::int32_t v) const {
    return any_ && ends_[places_.find(v)].state == kStraight;
  }

 private:
  enum State : std::int32_t { kNone, kOne, kTwo, kMore, kAsked, kStraight };
  /// The ends of the spokes from a vertex, as long as they are no more than
  /// two; then, of two of them, where their pair is.
  struct Ends {
    std::array<std::int32_t, 2> end{};
    State state = kNone;
    std::size_t pair() const { return static_cast<std::size_t>(end[0]); }
  };
  /// The two spokes of a vertex, of each end one whose two planes are known,
  /// if there is one.
  struct Pair {
    std::array<Spoke, 2> spokes;
  };

  template <class ForSpokes>
  static Extent extent_of(const ForSpokes& for_spokes) {
    Extent extent;
    for_spokes([&](const Spoke& spoke) { extent.add(spoke.hub); });
    return extent;
  }
  void count(const Spoke& spoke) {
    Ends& ends = ends_[places_(spoke.hub)];
    if (ends.state >= kMore) return;
    if (ends.state >= kOne && ends.end[0] == spoke.end) return;
    if (ends.state == kTwo && ends.end[1] == spoke.end) return;
    if (ends.state != kTwo)
      ends.end[static_cast<std::size_t>(ends.state)] = spoke.end;
    ends.state = static_cast<State>(ends.state + 1);
  }
  void begin(std::int32_t hub, Ends& ends, bool is_pinned);
  static void put(Pair& pair, const Spoke& spoke);
  void decide(const Space& space);

  Places places_;
  std::vector<Ends> ends_;  ///< by place
  std::vector<Pair> pairs_;
  bool any_ = false;
};

/// Puts pieces in the order of buckets, loop by loop, straight vertices left
/// out.
void walk_loops(List<Piece>& pieces, const Hubs& hubs);

}  // namespace halfspace::fast
