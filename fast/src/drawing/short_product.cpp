#include "drawing/short_product.hpp"

#include <algorithm>

namespace halfspace::fast {
namespace {

using Words = std::span<const std::uint64_t>;

/// The words of a number that are not more of its sign.
Words short_of(Words a) {
  const std::uint64_t fill = (a.back() >> 63) != 0 ? ~std::uint64_t{0} : 0;
  std::size_t length = a.size();
  while (length > 1 && a[length - 1] == fill &&
         (a[length - 2] >> 63) == (fill & 1))
    --length;
  return a.first(length);
}

bool is_negative(Words a) { return (a.back() >> 63) != 0; }

}  // namespace

/// See multiply_short().
void add_product(std::span<const std::uint64_t> long_a,
                 std::span<const std::uint64_t> long_b,
                 std::span<std::uint64_t> product) {
  const Words a = short_of(long_a);
  const Words b = short_of(long_b);
  const std::size_t full = std::min(a.size() + b.size(), product.size());
  for (std::size_t i = 0; i < a.size() && i < full; ++i) {
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < b.size() && i + j < full; ++j)
      product[i + j] = multiply_words(a[i], b[j], product[i + j], carry);
    if (i + b.size() < full) product[i + b.size()] = carry;
  }
  const auto subtract = [&](Words value, std::size_t shift) {
    std::uint64_t borrow = 0;
    for (std::size_t i = shift; i < full && i - shift < value.size(); ++i) {
      const std::uint64_t word = value[i - shift];
      const std::uint64_t rest = product[i] - word;
      const bool under = product[i] < word || rest < borrow;
      product[i] = rest - borrow;
      borrow = under ? 1 : 0;
    }
  };
  if (is_negative(a)) subtract(b, a.size());
  if (is_negative(b)) subtract(a, b.size());
  const bool negative = (product[full - 1] >> 63) != 0;
  std::fill(product.begin() + static_cast<std::ptrdiff_t>(full), product.end(),
            negative ? ~std::uint64_t{0} : 0);
}

}  // namespace halfspace::fast
