#pragma once

#include <cstdint>

namespace halfspace {

/// Where a point is against an oriented plane `h(p) = n.p + d` (S1.5):
/// positive where `h > 0`, negative where `h < 0`, on where `h = 0`.
enum class Side : std::int8_t { kNegative = -1, kOn = 0, kPositive = 1 };

/// The same plane, oriented the other way.
constexpr Side opposite(Side side) {
  return static_cast<Side>(-static_cast<std::int8_t>(side));
}

/// A polygon against a plane, by the signs at its vertices (S2.1).
enum class Relation : std::uint8_t {
  kPositive,    ///< no vertex negative, at least one positive
  kNegative,    ///< no vertex positive, at least one negative
  kCoincident,  ///< every vertex on the plane
  kSpanning,    ///< vertices on both sides
};

/// The relation of a polygon of which some vertices are on the positive side,
/// or some on the negative one, or both (S2.1).
constexpr Relation relation_of(bool some_positive, bool some_negative) {
  if (some_positive && some_negative) return Relation::kSpanning;
  if (some_positive) return Relation::kPositive;
  if (some_negative) return Relation::kNegative;
  return Relation::kCoincident;
}

}  // namespace halfspace
