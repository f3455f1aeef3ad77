#include "halfspace/ref/small_rational.hpp"

#include <utility>

#include "halfspace/assert.hpp"
#include "halfspace/big_integer.hpp"

namespace halfspace::ref {
namespace {

const BigInteger& least_int128() {
  static const BigInteger value = -(BigInteger(1) << 127);
  return value;
}

const BigInteger& greatest_int128() {
  static const BigInteger value = (BigInteger(1) << 127) - 1;
  return value;
}

/// A value above / below, perhaps not in lowest terms. below > 0.
struct Quotient {
  BigInteger above;
  BigInteger below;
};

Quotient operator*(const Quotient& p, const Quotient& q) {
  return {p.above * q.above, p.below * q.below};
}

Quotient operator+(const Quotient& p, const Quotient& q) {
  if (p.below == q.below) return {p.above + q.above, p.below};
  return {p.above * q.below + q.above * p.below, p.below * q.below};
}

Quotient quotient_of(const BigRational& value) {
  return {numerator(value), denominator(value)};
}

}  // namespace

Rational::Rational(BigRational value) {
  if (denominator(value) == 1) {
    const BigInteger whole = numerator(value);
    if (least_int128() <= whole && whole <= greatest_int128()) {
      small_ = to_int128(whole);
      return;
    }
    if (msb(abs(whole)) < 184) {
      const BigInteger word = BigInteger(1) << 64;
      BigInteger high = whole / word;  // towards zero
      if (whole < 0 && high * word != whole) high -= 1;
      small_ = to_int128(high);
      low_ = BigInteger(whole - high * word).convert_to<std::uint64_t>();
    }
  }
  big_ = std::make_unique<BigRational>(std::move(value));
}

BigRational Rational::big() const {
  BigRational room;
  return in(room);
}

const BigRational& Rational::in(BigRational& room) const {
  if (big_) return *big_;
  if (is_word(small_)) {
    room = static_cast<std::int64_t>(small_);
  } else {
    room = to_big<BigInteger>(small_);
  }
  return room;
}

Rational Rational::big_sum(const Rational& a, const Rational& b) {
  BigRational room_a, room_b;
  return Rational(a.in(room_a) + b.in(room_b));
}

bool Rational::big_less(const Rational& a, const Rational& b) {
  BigRational room_a, room_b;
  return a.in(room_a) < b.in(room_b);
}

Rational Rational::big_difference(const Rational& a, const Rational& b) {
  BigRational room_a, room_b;
  return Rational(a.in(room_a)-b.in(room_b));
}

int Rational::sign_of_big_affine(const Rational& a, const Rational& x,
                                 const Rational& b, const Rational& y,
                                 const Rational& c, const Rational& z,
                                 const Rational& d) {
  const auto quotient = [](const Rational& value) {
    if (value.big_) return quotient_of(*value.big_);
    if (is_word(value.small_))
      return Quotient{static_cast<std::int64_t>(value.small_), 1};
    return Quotient{to_big<BigInteger>(value.small_), 1};
  };
  return (quotient(a) * quotient(x) + quotient(b) * quotient(y) +
          quotient(c) * quotient(z) + quotient(d))
      .above.sign();
}

Rational Rational::times(const Rational& a, const Rational& b) {
  Int128 product;
  if (!a.big_ && !b.big_ &&
      !__builtin_mul_overflow(a.small_, b.small_, &product))
    return product;
  BigRational room_a, room_b;
  return Rational(a.in(room_a)*b.in(room_b));
}

Rational operator/(const Rational& a, const Rational& b) {
  HALFSPACE_ASSERT(sign(b) != 0);
  BigRational room_a, room_b;
  return Rational(a.in(room_a) / b.in(room_b));
}

Rational floor(const Rational& a) {
  if (!a.big_) return a;
  return Rational(BigRational(floor_of(*a.big_)));
}

std::int64_t Rational::to_int64() const {
  HALFSPACE_ASSERT(!big_ && is_word(small_));
  return static_cast<std::int64_t>(small_);
}

}  // namespace halfspace::ref
