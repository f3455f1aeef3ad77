#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "exact/wide.hpp"

namespace halfspace::fast {

/// As multiply_short(), in one function for numbers of any length: drawings
/// multiply numbers of many, which would be much code in a module for the web.
/// Requires: `product` is 0.
void add_product(std::span<const std::uint64_t> a,
                 std::span<const std::uint64_t> b,
                 std::span<std::uint64_t> product);

/// a * b in `kResult` words.
template <std::size_t kResult, std::size_t kA, std::size_t kB>
Wide<kResult> short_product(const Wide<kA>& a, const Wide<kB>& b) {
  if constexpr (!kSlowProducts) return multiply_short<kResult>(a, b);
  Wide<kResult> product;
  add_product(a.words, b.words, product.words);
  return product;
}

}  // namespace halfspace::fast
