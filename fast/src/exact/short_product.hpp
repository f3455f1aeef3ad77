#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "exact/wide.hpp"

namespace halfspace::fast {

/// As multiply(), for values that seldom fill their words: only the words that
/// are used are multiplied.
template <std::size_t kResult, std::size_t kA, std::size_t kB>
Wide<kResult> short_product(const Wide<kA>& a, const Wide<kB>& b) {
  if constexpr (kSlowProducts) return multiply_short<kResult>(a, b);
  const std::size_t used_a = length_of(a);
  const std::size_t used_b = length_of(b);
  const std::size_t full = std::min(used_a + used_b, kResult);
  Wide<kResult> product;
  for (std::size_t i = 0; i < used_a && i < full; ++i) {
    const std::size_t last = std::min(used_b, full - i);
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < last; ++j) {
      const Uint128 t =
          Uint128{a.words[i]} * b.words[j] + product.words[i + j] + carry;
      product.words[i + j] = static_cast<std::uint64_t>(t);
      carry = static_cast<std::uint64_t>(t >> 64);
    }
    if (i + used_b < full) product.words[i + used_b] = carry;
  }
  const auto subtract = [&](const auto& value, std::size_t used,
                            std::size_t shift) {
    std::uint64_t borrow = 0;
    for (std::size_t i = 0; i < used && shift + i < full; ++i) {
      const Uint128 d =
          Uint128{product.words[shift + i]} - value.words[i] - borrow;
      product.words[shift + i] = static_cast<std::uint64_t>(d);
      borrow = static_cast<std::uint64_t>(d >> 64) & 1u;
    }
  };
  if (a.is_negative()) subtract(b, used_b, used_a);
  if (b.is_negative()) subtract(a, used_a, used_b);
  if (full < kResult && (product.words[full - 1] >> 63) != 0)
    std::fill(product.words.begin() + static_cast<std::ptrdiff_t>(full),
              product.words.end(), ~std::uint64_t{0});
  return product;
}

}  // namespace halfspace::fast
