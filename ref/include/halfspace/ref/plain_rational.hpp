#pragma once

#include <cstdint>
#include <utility>

#include "halfspace/assert.hpp"
#include "halfspace/big_integer.hpp"
#include "halfspace/ref/big_rational.hpp"

namespace halfspace::ref {

/// An exact rational number, without limit of size.
class Rational {
 public:
  Rational() = default;
  Rational(int value) : value_(value) {}
  Rational(std::int64_t value) : value_(value) {}
  Rational(Int128 value) : value_(to_big<BigInteger>(value)) {}
  explicit Rational(BigRational value) : value_(std::move(value)) {}

  friend Rational operator+(const Rational& a, const Rational& b) {
    return Rational(a.value_ + b.value_);
  }
  friend Rational operator-(const Rational& a, const Rational& b) {
    return Rational(a.value_ - b.value_);
  }
  friend Rational operator*(const Rational& a, const Rational& b) {
    return Rational(a.value_ * b.value_);
  }
  /// Requires: b != 0.
  friend Rational operator/(const Rational& a, const Rational& b) {
    HALFSPACE_ASSERT(sign(b) != 0);
    return Rational(a.value_ / b.value_);
  }
  friend Rational operator-(const Rational& a) { return Rational(0) - a; }
  Rational& operator+=(const Rational& b) { return *this = *this + b; }
  Rational& operator-=(const Rational& b) { return *this = *this - b; }
  Rational& operator*=(const Rational& b) { return *this = *this * b; }

  /// The sign of the value: -1, 0 or 1.
  friend int sign(const Rational& a) { return a.value_.sign(); }
  friend bool operator==(const Rational& a, const Rational& b) {
    return a.value_ == b.value_;
  }
  friend bool operator<(const Rational& a, const Rational& b) {
    return a.value_ < b.value_;
  }
  friend bool operator>(const Rational& a, const Rational& b) { return b < a; }
  friend bool operator<=(const Rational& a, const Rational& b) {
    return !(b < a);
  }
  friend bool operator>=(const Rational& a, const Rational& b) {
    return !(a < b);
  }

  /// The sign of a x + b y + c z + d.
  friend int sign_of_affine(const Rational& a, const Rational& x,
                            const Rational& b, const Rational& y,
                            const Rational& c, const Rational& z,
                            const Rational& d) {
    return sign(a * x + b * y + c * z + d);
  }
  /// The greatest integer not above the value.
  friend Rational floor(const Rational& a) {
    return Rational(BigRational(floor_of(a.value_)));
  }
  /// The double nearest to the value, ties to even; infinite beyond doubles.
  friend double nearest_double(const Rational& a) {
    return nearest_double(a.value_);
  }
  const BigRational& big() const { return value_; }
  /// The value, if it is an integer of 64 bits.
  /// Requires: it is.
  std::int64_t to_int64() const {
    const auto whole = static_cast<std::int64_t>(numerator(value_));
    HALFSPACE_ASSERT(value_ == BigRational(whole));
    return whole;
  }

 private:
  BigRational value_ = 0;
};

}  // namespace halfspace::ref
