#pragma once

#include <compare>
#include <cstdint>
#include <vector>

namespace halfspace {

/// Index of a polygon in its scene: its rank in the input. Also names the
/// plane of that polygon, with its orientation (S1.4).
using PolygonId = std::int32_t;

/// Index of a vertex in its scene.
using VertexId = std::int32_t;

/// A point of the grid (S1.1). Units: grid steps.
struct GridPoint {
  std::int64_t x = 0;
  std::int64_t y = 0;
  std::int64_t z = 0;
  friend auto operator<=>(const GridPoint&, const GridPoint&) = default;
};

/// A colour of 8 bits a channel.
struct Rgb {
  std::uint8_t r = 0;
  std::uint8_t g = 0;
  std::uint8_t b = 0;
  friend auto operator<=>(const Rgb&, const Rgb&) = default;
};

/// An edge of a fragment, by name (S2.2): either the edge of the source
/// polygon that leaves its corner `index`, or the line in which the plane of
/// polygon `index`, a splitter, cut it.
struct EdgeName {
  enum class Kind : std::uint8_t { kSource, kSplitter };
  Kind kind = Kind::kSource;
  std::int32_t index = 0;
  friend auto operator<=>(const EdgeName&, const EdgeName&) = default;
};

/// A fragment, by names alone (S2.2): its source polygon and its edges, in the
/// source's order round the boundary. Two fragments of one scene are the same
/// point set whenever these agree.
struct FragmentName {
  PolygonId source = 0;
  std::vector<EdgeName> edges;  ///< rotated so that the least comes first
  friend bool operator==(const FragmentName&, const FragmentName&) = default;
};

/// `edges` rotated so that the least comes first (an edge name occurs at most
/// once in a fragment, S2.2, so this is a normal form).
std::vector<EdgeName> rotated_to_least(std::vector<EdgeName> edges);

}  // namespace halfspace
