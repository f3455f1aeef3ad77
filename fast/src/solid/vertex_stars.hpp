#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "base/id_map.hpp"
#include "solid/loops.hpp"

namespace halfspace::fast {

/// An edge as one of its ends sees it.
struct IncidentEdge {
  std::int32_t center;
  std::int32_t end;
  std::int32_t plane;
  std::int32_t other;
};

/// The ends of edges, and which of them are straight: all edges there are on
/// one line, and none ends there.
class VertexStars {
 public:
  /// `for_ends(visit)` visits both ends of every edge, each with the other one,
  /// and `for_incident_edges(visit)` its two edges. `for_more(visit)` visits
  /// points, among them all at which there are more edges, which are none on
  /// one line. What is pinned is never straight. Requires: all ends are in the
  /// extent.
  template <class ForEnds, class ForSpokes, class ForMore, class IsPinned>
  VertexStars(const IdRange& extent, const ForEnds& for_ends,
              const ForSpokes& for_incident_edges, const ForMore& for_more,
              const IsPinned& is_pinned, const GeometryTable& table)
      : places_(extent), ends_(places_.size()), states_(places_.size()) {
    places_.with_slots([&](const auto& place) { count(for_ends, place); });
    const std::size_t twos = two_count();
    if (twos == 0) return;
    drop_twos(twos, for_more);
    for_incident_edges([&](const IncidentEdge& incident) {
      const std::size_t at = places_.find(incident.center);
      if (is_two(at)) begin(incident.center, at, is_pinned(incident.center));
      if (states_[at] == kAsked) put(pairs_[ends_[at].pair()], incident);
    });
    decide(table);
  }

  /// Whether any vertex is.
  bool any_straight() const { return any_; }
  /// Requires: one of the edges ends at the vertex.
  bool is_straight(std::int32_t v) const {
    return any_ && states_[places_.find(v)] == kStraight;
  }
  /// Whether the vertex is, and the edges there are from the one end and to the
  /// other. Of a closed surface no others are.
  /// Requires: as is_straight().
  bool goes_straight(std::int32_t from, std::int32_t v, std::int32_t to) const {
    if (!is_straight(v)) return false;
    const auto& [s, t] = pairs_[ends_[places_.find(v)].pair()].edges;
    return (s.end == from && t.end == to) || (s.end == to && t.end == from);
  }

 private:
  enum State : std::uint8_t { kFew, kMore, kAsked, kStraight };
  /// The least and the greatest of the ends of the edges from a vertex; then,
  /// where they are all, and so two, where their pair is.
  struct Ends {
    std::int32_t least = std::numeric_limits<std::int32_t>::max();
    std::int32_t greatest = -1;
    std::size_t pair() const { return static_cast<std::size_t>(least); }
  };
  /// The two edges of a vertex, of each end one whose two planes are known,
  /// if there is one.
  struct Pair {
    std::array<IncidentEdge, 2> edges;
  };

  /// Finds the least and the greatest end of each center, and who has another:
  /// one that is neither when two are known, which are all so far. Nothing
  /// foretells how many a center has: there are no branches.
  template <class ForEnds, class Place>
  void count(const ForEnds& for_ends, const Place& place) {
    Ends* const all = ends_.data();
    std::uint8_t* const states = states_.data();
    for_ends([&](std::int32_t center, std::int32_t end) {
      const std::size_t at = place(center);
      const std::int32_t least = all[at].least;
      const std::int32_t greatest = all[at].greatest;
      const bool is_third =
          (least < greatest) & (end != least) & (end != greatest);
      states[at] = static_cast<std::uint8_t>(states[at] | (is_third ? 1 : 0));
      all[at].least = std::min(least, end);
      all[at].greatest = std::max(greatest, end);
    });
  }
  bool is_two(std::size_t at) const {
    return states_[at] == kFew && ends_[at].least < ends_[at].greatest;
  }
  std::size_t two_count() const {
    std::size_t count = 0;
    for (std::size_t at = 0; at < states_.size(); ++at) count += is_two(at);
    return count;
  }
  template <class ForMore>
  void drop_twos(std::size_t count, const ForMore& for_more) {
    BloomFilter twos(count);
    for (std::size_t at = 0; at < states_.size(); ++at) {
      if (is_two(at)) twos.add(places_.id_at(at));
    }
    for_more([&](std::int32_t v) {
      if (twos.may_hold(v) && places_.holds(v))
        states_[places_.find(v)] = kMore;
    });
  }
  void begin(std::int32_t center, std::size_t at, bool is_pinned);
  static void put(Pair& pair, const IncidentEdge& incident);
  void decide(const GeometryTable& table);

  IdMap places_;
  std::vector<Ends> ends_;            ///< by place
  std::vector<std::uint8_t> states_;  ///< by slot
  std::vector<Pair> pairs_;
  bool any_ = false;
};

/// Those of the edges in some lists. `is_pinned`: as of
/// drop_collinear_vertices().
VertexStars stars_of(std::span<const List<DirectedEdge>> lists,
                     const std::function<bool(std::int32_t)>& is_pinned,
                     const GeometryTable& table);

/// One face's edges, loop by loop, straight vertices left out.
class FaceTracer {
 public:
  /// Puts the pieces in another order. What is given lasts until the next call.
  std::span<const DirectedEdge> traced(std::span<DirectedEdge> pieces,
                                       const VertexStars& stars);

 private:
  std::vector<DirectedEdge> out_;
  std::vector<std::uint8_t> used_;
};

/// Puts pieces in the order of buckets, loop by loop, straight vertices left
/// out.
void trace_loops(List<DirectedEdge>& pieces, const VertexStars& stars);

}  // namespace halfspace::fast
