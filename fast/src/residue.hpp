#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "wide.hpp"

/// Hashes of points that are known by multiples of their coordinates, by
/// counting modulo a prime.
namespace halfspace::fast {

/// A Mersenne prime: reduction is shifts and sums.
constexpr std::uint64_t kPrime = (std::uint64_t{1} << 61) - 1;

inline std::uint64_t reduce(Uint128 value) {
  const std::uint64_t sum = static_cast<std::uint64_t>(value & kPrime) +
                            static_cast<std::uint64_t>(value >> 61);
  const std::uint64_t once = (sum & kPrime) + (sum >> 61);
  return once >= kPrime ? once - kPrime : once;
}
inline std::uint64_t times(std::uint64_t a, std::uint64_t b) {
  return reduce(Uint128{a} * b);
}

/// The inverse modulo the prime, by Fermat: a to the power of p - 2, whose 61
/// bits are all set but the second.
inline std::uint64_t inverse(std::uint64_t a) {
  std::uint64_t power = 1;
  for (int bit = 60; bit >= 0; --bit) {
    power = times(power, power);
    if (bit != 1) power = times(power, a);
  }
  return power;
}

/// The value modulo the prime; 2^64 is 8 there.
template <std::size_t kWords>
std::uint64_t residue(const Wide<kWords>& value) {
  const bool negative = value.is_negative();
  const Wide<kWords> size = negative ? -value : value;
  std::uint64_t sum = 0;
  for (std::size_t i = kWords; i-- > 0;)
    sum = reduce(Uint128{sum} * 8 + size.words[i]);
  return negative && sum != 0 ? kPrime - sum : sum;
}

inline std::uint64_t mixed(std::uint64_t h) {
  h = (h ^ (h >> 32)) * 0x9e3779b97f4a7c15u;
  h = (h ^ (h >> 29)) * 0xbf58476d1ce4e5b9u;
  return h ^ (h >> 32);
}
inline std::uint64_t hash_of(std::uint64_t a, std::uint64_t b,
                             std::uint64_t c) {
  return mixed(mixed(mixed(a) + b) + c);
}

/// The value divided by the prime, which divides it.
template <std::size_t kWords>
Wide<kWords> without_prime(const Wide<kWords>& value) {
  const bool negative = value.is_negative();
  const Wide<kWords> size = negative ? -value : value;
  Wide<kWords> quotient;
  Uint128 rest = 0;
  for (std::size_t i = kWords; i-- > 0;) {
    rest = rest << 64 | size.words[i];
    quotient.words[i] = static_cast<std::uint64_t>(rest / kPrime);
    rest %= kPrime;
  }
  return negative ? -quotient : quotient;
}

/// A hash of the point, whatever its coordinates were multiplied with.
///
/// Modulo the prime the quotients by the last coordinate are the same for all
/// multiples, unless that is 0. It is 0 for all of them once no multiple of the
/// prime is left in all four, and then they share one hash.
template <std::size_t kWords>
std::uint64_t point_hash(std::array<Wide<kWords>, 4> c) {
  std::array<std::uint64_t, 4> r;
  const auto reduce_all = [&] {
    for (std::size_t i = 0; i < 4; ++i) r[i] = residue(c[i]);
  };
  reduce_all();
  while ((r[0] | r[1] | r[2] | r[3]) == 0) {
    for (auto& value : c) value = without_prime(value);
    reduce_all();
  }
  const std::uint64_t w = inverse(r[3]);
  return hash_of(times(r[0], w), times(r[1], w), times(r[2], w));
}

}  // namespace halfspace::fast
