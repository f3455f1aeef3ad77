#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace halfspace::csg {

/// Which of these hashes may be there twice: all that are, and few others, some
/// tenth where none is. One bit for each hash tells whether it came up.
inline std::vector<bool> may_repeat(std::span<const std::uint64_t> hashes) {
  const std::size_t size = std::bit_ceil(8 * hashes.size() + 64);
  std::vector<bool> once(size), twice(size);
  for (const std::uint64_t hash : hashes) {
    const std::size_t at = hash & (size - 1);
    if (once[at]) twice[at] = true;
    once[at] = true;
  }
  std::vector<bool> may(hashes.size());
  for (std::size_t i = 0; i < hashes.size(); ++i)
    may[i] = twice[hashes[i] & (size - 1)];
  return may;
}

/// Spreads the bits of `z` over all of it.
constexpr std::uint64_t spread(std::uint64_t z) {
  z = (z ^ (z >> 32)) * 0x9e3779b97f4a7c15u;
  return z ^ (z >> 29);
}

}  // namespace halfspace::csg
