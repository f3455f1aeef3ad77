#pragma once

#include <compare>
#include <cstdint>

namespace halfspace {

/// A closed run of pixels on a scan line: `first` to `last`, both in it (S4.6).
/// Requires: first <= last. Units: pixels.
struct Span {
  std::int32_t first = 0;
  std::int32_t last = 0;
  friend auto operator<=>(const Span&, const Span&) = default;
};

/// The eight ways an object segment lies against an unlit one (S4.7; F2B
/// fig. 9, whose numbers these are).
enum class MergeCase : std::uint8_t { k1 = 1, k2, k3, k4, k5, k6, k7, k8 };

/// The case of F2B fig. 9 that relates the two segments (S4.7).
constexpr MergeCase merge_case(Span object, Span unlit) {
  using enum MergeCase;
  if (object.last < unlit.first) return k1;
  if (object.first > unlit.last) return k8;
  const bool from_left = object.first <= unlit.first;
  if (object.last < unlit.last) return from_left ? k2 : k3;
  if (object.last == unlit.last) return from_left ? k4 : k5;
  return from_left ? k6 : k7;
}

}  // namespace halfspace
