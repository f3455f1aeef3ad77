#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "halfspace/fast/simd.hpp"

/// Span merging over every pair of sets of pixels of one line: nothing is
/// drawn at random, so nothing of that length is left out.
namespace halfspace::exhaustive {

/// What has been compared; adds up over ranges.
struct MergeTally {
  std::uint64_t pairs = 0;
  std::uint64_t steps = 0;
  std::uint64_t steps_of_case[9] = {};  ///< by the number of S4.7
  std::uint64_t mismatches = 0;
  std::string first_mismatch;  ///< the lowest pair's, in words; or empty

  void add(const MergeTally& other);
};

/// Merges every set of object pixels from `first` up to but not including
/// `end` into every set of unlit pixels of a line of `width_px` pixels. Bit i
/// of a set is pixel i.
///
/// Compared are, between the reference, the fast library by each of the levels
/// and sets of bits: the segments that become lit, those left unlit, and the
/// case of every step (S4.7), so also which list advances when.
/// Requires: 1 <= width_px <= 16; first <= end <= 2^width_px.
/// Cost:     (end - first) 2^width_px merges by each.
MergeTally merge_lines(int width_px, std::uint32_t first, std::uint32_t end,
                       std::span<const fast::SimdLevel> levels);

/// What `count` merges of lines of 64 pixels come to, drawn from the seed: sets
/// of object pixels and of unlit pixels, by the loops of one level and by sets
/// of bits.
///
/// Eight lines of a tile are merged together, as render() does.
MergeTally merge_random(std::uint64_t count, std::uint64_t seed,
                        fast::SimdLevel level);

}  // namespace halfspace::exhaustive
