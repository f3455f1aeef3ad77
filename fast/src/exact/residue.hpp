#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "exact/wide.hpp"

/// Numbers modulo the prime 2^31 - 1, whose residues are sums of digits to base
/// 2^31. Residues of ratios do not depend on common factors: a hash of rays
/// that needs no common divisor.
namespace halfspace::fast {

constexpr std::uint64_t kPrime = (std::uint64_t{1} << 31) - 1;

/// Of any word. Sum of digits: below 2^32 + 4.
constexpr std::uint64_t residue(std::uint64_t a) {
  const std::uint64_t sum = (a & kPrime) + (a >> 31 & kPrime) + (a >> 62);
  const std::uint64_t again = (sum & kPrime) + (sum >> 31);
  return again >= kPrime ? again - kPrime : again;
}
/// Of a signed number in words. As 2^62 leaves 1, word i has the weight 4^i.
template <std::size_t kWords>
constexpr std::uint64_t residue(const Wide<kWords>& a) {
  std::uint64_t sum = 0;
  std::uint64_t weight = 1;
  for (const std::uint64_t word : a.words) {
    sum += weight * residue(word);
    weight *= 4;
  }
  // Less than 4^8 2^31, and 2^32 more.
  static_assert(kWords <= 8);
  return residue(a.is_negative() ? sum + (kPrime - weight % kPrime) : sum);
}
constexpr std::uint64_t residue(Int128 a) { return residue(Wide<2>(a)); }

constexpr std::uint64_t multiply_residues(std::uint64_t a, std::uint64_t b) {
  return residue(a * b);
}

/// The inverse, a^(p - 2) by Fermat; of 0: 0.
constexpr std::uint64_t inverse_residue(std::uint64_t a) {
  std::uint64_t result = 1;
  for (std::uint64_t left = kPrime - 2; left != 0; left >>= 1) {
    if ((left & 1) != 0) result = multiply_residues(result, a);
    a = multiply_residues(a, a);
  }
  return result;
}

/// Replaces each by its inverse, with the inverse of one product for all
/// (Montgomery's trick). Requires: at most 32, none of them 0.
inline void invert_residues(std::span<std::uint64_t> all) {
  std::array<std::uint64_t, 32> before;
  std::uint64_t product = 1;
  for (std::size_t i = 0; i < all.size(); ++i) {
    before[i] = product;
    product = multiply_residues(product, all[i]);
  }
  std::uint64_t inverse = inverse_residue(product);
  for (std::size_t i = all.size(); i-- > 0;) {
    const std::uint64_t value = all[i];
    all[i] = multiply_residues(inverse, before[i]);
    inverse = multiply_residues(inverse, value);
  }
}

}  // namespace halfspace::fast
