#pragma once

#include <boost/multiprecision/cpp_int.hpp>

#include "exact/wide.hpp"

/// Rationals without limit of size, for the few values that fixed widths do not
/// hold: sums of quotients that a filter has left undecided.
namespace halfspace::fast {

using BigRational =
    boost::multiprecision::number<boost::multiprecision::rational_adaptor<
                                      boost::multiprecision::cpp_int_backend<>>,
                                  boost::multiprecision::et_off>;
using BigInteger = boost::multiprecision::component_type<BigRational>::type;

/// Two's complement, least word first.
template <std::size_t kWords>
BigInteger to_big_integer(const std::array<std::uint64_t, kWords>& words) {
  BigInteger value = 0;
  for (std::size_t k = kWords; k-- > 0;) value = (value << 64) + words[k];
  if (words[kWords - 1] >> 63 != 0)
    value -= BigInteger(1) << static_cast<unsigned>(64 * kWords);
  return value;
}
template <std::size_t kWords>
BigInteger to_big_integer(const Wide<kWords>& value) {
  return to_big_integer(value.words);
}

/// n / d, for d of either sign. Requires: d != 0.
inline BigRational quotient_of(const BigInteger& n, const BigInteger& d) {
  return d < 0 ? BigRational(BigInteger(-n), BigInteger(-d))
               : BigRational(n, d);
}

/// The greatest integer not above the value.
inline BigInteger floor_of(const BigRational& value) {
  const BigInteger n = numerator(value);
  const BigInteger d = denominator(value);
  const BigInteger q = n / d;
  return n < 0 && q * d != n ? BigInteger(q - 1) : q;
}

/// A channel, rounded half up. Requires: it is from 0 to 255.
inline std::uint8_t rounded_channel(const BigRational& value) {
  return floor_of(value + BigRational(1, 2)).convert_to<std::uint8_t>();
}

}  // namespace halfspace::fast
