#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "boolean/arrangement.hpp"
#include "intersect/point_location.hpp"

namespace halfspace::fast {

/// Step 1 of a boolean: decides which vertices and parts of edges of an operand
/// are inside the other one.
///
/// Vertices that no surface separates form disjoint sets, joined along
/// untouched faces and edges. A set's membership is known from a crossing of
/// one of its edges, else from one ray (point location).
class Classifier {
 public:
  /// A part of an edge, by its number, and whether it is inside.
  struct KnownPart {
    std::size_t part = 0;
    bool inside = false;
  };

  /// Requires: the arrangement is indexed.
  explicit Classifier(Arrangement& arrangement);

  /// The ends of an edge and the points between that cut it, in order.
  void points_on(std::size_t o, std::int32_t edge,
                 std::vector<std::int32_t>& points) const;
  /// Whether a vertex that is not on the other operand's surface is inside.
  bool is_inside(std::size_t o, std::int32_t vertex);
  /// Whether a part of an edge that has only its ends in common with the other
  /// operand's surface is inside.
  bool is_part_inside(std::size_t o, std::int32_t edge, std::int32_t low,
                      std::int32_t high);
  /// The same of part `part` of what points_on() gives for the edge. `before`:
  /// a part further down whose membership is known, if any.
  bool is_part_inside(std::size_t o, std::int32_t edge,
                      const std::vector<std::int32_t>& points, std::size_t part,
                      const std::optional<KnownPart>& before);

  /// The same two for threads, all at once while nothing else is asked: nothing
  /// where a ray would have to decide.
  std::optional<bool> known_part(std::size_t o, std::int32_t edge,
                                 std::int32_t low, std::int32_t high) const;
  std::optional<bool> known_part(std::size_t o, std::int32_t edge,
                                 const std::vector<std::int32_t>& points,
                                 std::size_t part,
                                 const std::optional<KnownPart>& before) const;

 private:
  enum Member : std::uint8_t { kUnknown, kOutside, kInside };

  void join_vertices(std::size_t o);
  void note_members(std::size_t o);
  std::optional<bool> inside_at_crossing(std::size_t o, std::int32_t edge,
                                         std::int32_t at,
                                         std::int32_t target) const;
  std::optional<bool> inside_from_crossing(std::size_t o, std::int32_t edge,
                                           std::int32_t low,
                                           std::int32_t high) const;
  std::int32_t free_end(std::size_t o, std::int32_t edge, std::int32_t low,
                        std::int32_t high) const;
  std::optional<bool> known_member(std::size_t o, std::int32_t vertex) const;
  std::optional<bool> inside_from_part(std::size_t o, std::int32_t edge,
                                       const std::vector<std::int32_t>& points,
                                       const KnownPart& before,
                                       std::size_t part) const;
  const PointLocator& locator(std::size_t o);
  /// The root of a vertex's set, of `vertex + 1`: 0 for vertices beyond the
  /// other operand's box, all of which are on one side of it.
  std::int32_t root(std::size_t o, std::int32_t vertex) {
    const SparseParents& parents = scratch_.sets[o].parents();
    const std::int32_t up = parents.get(vertex + 1, -1);
    // Nearly always, and short enough to be inlined.
    if (up >= 0 && parents.get(up) == up) return up;
    return find_root(o, vertex);
  }
  std::int32_t find_root(std::size_t o, std::int32_t vertex);
  bool is_joined(std::size_t o, const SolidEdge* edges) const;
  void join(std::size_t o, std::int32_t u, std::int32_t v);
  std::int32_t join_root(std::size_t o, std::int32_t r, std::int32_t v);

  Arrangement& common_;
  std::array<Operand, 2>& operands_;
  GeometryTable& table_;
  BooleanScratch& scratch_;
  std::array<std::optional<PointLocator>, 2> locators_;
  /// For the operands' near faces only; not for rays.
  std::array<PointLocator, 2> near_faces_;
  std::vector<std::int32_t> points_;
};

}  // namespace halfspace::fast
