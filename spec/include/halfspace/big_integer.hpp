#pragma once

#include <cstdint>

#include "halfspace/int128.hpp"

namespace halfspace {

/// The same integer in a type of any size, as Boost.Multiprecision has them,
/// which knows no integers of 128 bits.
template <class Big>
Big to_big(Int128 value) {
  Big result = static_cast<std::int64_t>(value >> 64);
  result <<= 64;
  result += static_cast<std::uint64_t>(value);
  return result;
}

/// The same integer in 128 bits.
/// Requires: it fits them.
template <class Big>
Int128 to_int128(const Big& value) {
  const bool negative = value < 0;
  const Big magnitude = negative ? Big(-value) : value;
  const Big high = magnitude >> 64;
  const Big low = magnitude - (high << 64);
  // Unsigned, so that 2^127, the magnitude of the least value, is no overflow.
  __extension__ using Uint128 = unsigned __int128;
  const Uint128 bits = Uint128{high.template convert_to<std::uint64_t>()}
                           << 64 |
                       low.template convert_to<std::uint64_t>();
  return static_cast<Int128>(negative ? -bits : bits);
}

}  // namespace halfspace
