#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <random>
#include <utility>

#include "exact/wide.hpp"

namespace halfspace::fast {

using boost::multiprecision::cpp_int;

template <std::size_t kWords>
cpp_int to_big(const Wide<kWords>& a) {
  cpp_int value = 0;
  for (std::size_t i = kWords; i-- > 0;) value = (value << 64) + a.words[i];
  if (a.is_negative()) value -= cpp_int(1) << (64 * kWords);
  return value;
}

/// Random words, extreme ones often: carries must run through.
template <std::size_t kWords>
Wide<kWords> random_wide(std::mt19937_64& random, std::size_t words_used) {
  Wide<kWords> value;
  const std::uint64_t extremes[] = {0, 1, ~std::uint64_t{0},
                                    std::uint64_t{1} << 63,
                                    (std::uint64_t{1} << 63) - 1};
  for (std::size_t i = 0; i < words_used; ++i) {
    value.words[i] = random() % 2 == 0 ? random() : extremes[random() % 5];
  }
  // Room for a sum of two, so that nothing overflows.
  value.words[words_used - 1] >>= 2;
  if (random() % 2 == 0) return -value;
  return value;
}

/// n / d of which n has few bits more than d, often nearly or just a double
/// or halfway between two.
inline std::pair<Wide<4>, Wide<4>> random_quotient(std::mt19937_64& random,
                                                   int dropped) {
  auto d = random_wide<4>(random, 1 + random() % 3);
  if (d.is_negative()) d = -d;
  if (sign(d) == 0) d = Wide<4>(1);
  const auto bits = static_cast<int>(random() % 54);
  auto n =
      multiply<4>(d, Int128{static_cast<std::int64_t>(random() >> dropped)});
  if (random() % 2 == 0) n = n + n + d;
  if (random() % 3 == 0) n = n + Wide<4>(static_cast<int>(random() % 3) - 1);
  if (random() % 3 == 0) n = n + random_wide<4>(random, 2);
  return {random() % 2 == 0 ? n : -n,
          multiply<4>(d, Int128{std::int64_t{1} << bits})};
}

}  // namespace halfspace::fast
