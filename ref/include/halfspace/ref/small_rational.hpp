#pragma once

#include <memory>

#include "halfspace/int128.hpp"
#include "halfspace/ref/big_rational.hpp"

namespace halfspace::ref {

/// An exact rational number.
///
/// An integer of 128 bits is kept as such, any other number as a BigRational:
/// most numbers of a scene are small integers, and this makes them cheap. The
/// form of a value cannot be seen from outside. The words of a somewhat greater
/// integer stand beside its BigRational, for the offsets of planes on the grid
/// of 54 bits.
///
/// Exact: yes, without limit of size.
class Rational {
 public:
  Rational() = default;
  Rational(int value) : small_(value) {}
  Rational(std::int64_t value) : small_(value) {}
  Rational(Int128 value) : small_(value) {}
  explicit Rational(BigRational value);

  Rational(const Rational& other)
      : small_(other.small_),
        low_(other.low_),
        big_(other.big_ ? std::make_unique<BigRational>(*other.big_)
                        : nullptr) {}
  Rational(Rational&&) noexcept = default;
  Rational& operator=(const Rational& other) {
    if (this != &other) *this = Rational(other);
    return *this;
  }
  Rational& operator=(Rational&&) noexcept = default;
  ~Rational() = default;

  friend Rational operator+(const Rational& a, const Rational& b) {
    Int128 sum;
    if (!a.big_ && !b.big_ && !__builtin_add_overflow(a.small_, b.small_, &sum))
      return sum;
    return big_sum(a, b);
  }
  friend Rational operator-(const Rational& a, const Rational& b) {
    Int128 difference;
    if (!a.big_ && !b.big_ &&
        !__builtin_sub_overflow(a.small_, b.small_, &difference))
      return difference;
    return big_difference(a, b);
  }
  friend Rational operator*(const Rational& a, const Rational& b) {
    if (!a.big_ && !b.big_ && is_word(a.small_) && is_word(b.small_))
      return a.small_ * b.small_;
    return times(a, b);
  }
  /// Requires: b != 0.
  friend Rational operator/(const Rational& a, const Rational& b);
  friend Rational operator-(const Rational& a) { return Rational(0) - a; }
  Rational& operator+=(const Rational& b) { return *this = *this + b; }
  Rational& operator-=(const Rational& b) { return *this = *this - b; }
  Rational& operator*=(const Rational& b) { return *this = *this * b; }

  /// The sign of the value: -1, 0 or 1.
  friend int sign(const Rational& a) {
    if (a.big_) return a.big_->sign();
    return a.small_ > 0 ? 1 : a.small_ < 0 ? -1 : 0;
  }
  friend bool operator==(const Rational& a, const Rational& b) {
    if (!a.big_ && !b.big_) return a.small_ == b.small_;
    // A value has one form only, so two forms are two values.
    return a.big_ && b.big_ && *a.big_ == *b.big_;
  }
  friend bool operator<(const Rational& a, const Rational& b) {
    if (!a.big_ && !b.big_) return a.small_ < b.small_;
    return big_less(a, b);
  }
  friend bool operator>(const Rational& a, const Rational& b) { return b < a; }
  friend bool operator<=(const Rational& a, const Rational& b) {
    return !(b < a);
  }
  friend bool operator>=(const Rational& a, const Rational& b) {
    return !(a < b);
  }

  /// The sign of a x + b y + c z + d, without reducing intermediate results:
  /// most of the reference's time is spent here.
  friend int sign_of_affine(const Rational& a, const Rational& x,
                            const Rational& b, const Rational& y,
                            const Rational& c, const Rational& z,
                            const Rational& d) {
    if (!a.big_ && !b.big_ && !c.big_ && d.has_words() && x.is_narrow() &&
        y.is_narrow() && z.is_narrow()) {
      return sign_of_small_affine(a, x.word(), b, y.word(), c, z.word(), d);
    }
    return sign_of_big_affine(a, x, b, y, c, z, d);
  }

  /// The greatest integer not above the value.
  friend Rational floor(const Rational& a);

  /// The double nearest to the value, ties to even; infinite beyond doubles.
  friend double nearest_double(const Rational& a) {
    return nearest_double(a.big());
  }

  /// The value as a BigRational.
  BigRational big() const;

  /// The value, if it is an integer of 64 bits.
  /// Requires: it is.
  std::int64_t to_int64() const;

 private:
  static bool is_word(Int128 value) {
    return value == static_cast<std::int64_t>(value);
  }
  /// Whether the value is an integer below 2^61 in size, as all coordinates on
  /// a grid are.
  bool is_narrow() const {
    constexpr Int128 kLimit = Int128{1} << 61;
    return !big_ && -kLimit < small_ && small_ < kLimit;
  }
  std::int64_t word() const { return static_cast<std::int64_t>(small_); }
  /// Whether the value is an integer below 2^184 in size; then it is
  /// high() 2^64 + low(), where 0 <= low() < 2^64.
  bool has_words() const { return !big_ || small_ != 0; }
  Int128 high() const { return big_ ? small_ : small_ >> 64; }
  std::uint64_t low() const {
    return big_ ? low_ : static_cast<std::uint64_t>(small_);
  }
  /// The sign of a x + b y + c z + d, where a, b, c are small, d has words, and
  /// x, y, z are narrow.
  ///
  /// The products of lower words are below 2^(64+61), so that the lower sum is
  /// below 3 * 2^125 + 2^64 < 2^127. Its bits beyond 64 carry to the higher
  /// sum, below 3 * 2^(63+61) + 2^120 + 2^64 < 2^127. The sign is that of the
  /// higher sum; if that is 0, of the lower word.
  static int sign_of_small_affine(const Rational& a, std::int64_t x,
                                  const Rational& b, std::int64_t y,
                                  const Rational& c, std::int64_t z,
                                  const Rational& d) {
    const auto times_high = [](const Rational& value, std::int64_t factor) {
      return Int128{static_cast<std::int64_t>(value.small_ >> 64)} * factor;
    };
    const auto times_low = [](const Rational& value, std::int64_t factor) {
      return Int128{static_cast<std::uint64_t>(value.small_)} * factor;
    };
    const Int128 lower =
        times_low(a, x) + times_low(b, y) + times_low(c, z) + d.low();
    const Int128 higher = times_high(a, x) + times_high(b, y) +
                          times_high(c, z) + d.high() + (lower >> 64);
    if (higher != 0) return higher > 0 ? 1 : -1;
    return static_cast<std::uint64_t>(lower) != 0 ? 1 : 0;
  }
  static int sign_of_big_affine(const Rational& a, const Rational& x,
                                const Rational& b, const Rational& y,
                                const Rational& c, const Rational& z,
                                const Rational& d);
  static Rational times(const Rational& a, const Rational& b);
  static Rational big_sum(const Rational& a, const Rational& b);
  static Rational big_difference(const Rational& a, const Rational& b);
  static bool big_less(const Rational& a, const Rational& b);
  /// The value as a BigRational: its own, or `room` set to it.
  const BigRational& in(BigRational& room) const;

  /// The value, where big_ is null; else its higher words, or 0 for a value
  /// that is no integer or too great for them.
  Int128 small_ = 0;
  std::uint64_t low_ = 0;  ///< the lowest word of such a value
  std::unique_ptr<BigRational> big_;
};

}  // namespace halfspace::ref
