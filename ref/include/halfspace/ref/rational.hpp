#pragma once

#include <memory>

#if defined(HALFSPACE_REF_GMP)
#include <boost/multiprecision/gmp.hpp>
#else
#include <boost/multiprecision/cpp_int.hpp>
#endif

#include "halfspace/int128.hpp"

namespace halfspace::ref {

/// The rationals of Boost.Multiprecision: over GMP where that is there (four
/// times faster), else all Boost's own.
#if defined(HALFSPACE_REF_GMP)
using BigRational =
    boost::multiprecision::number<boost::multiprecision::gmp_rational,
                                  boost::multiprecision::et_off>;
#else
using BigRational = boost::multiprecision::number<
    boost::multiprecision::rational_adaptor<
        boost::multiprecision::cpp_int_backend<> >,
    boost::multiprecision::et_off>;
#endif

/// An exact rational number.
///
/// An integer of 128 bits is kept as such and everything else as a
/// BigRational: most numbers of a scene are small integers, and this makes
/// them cheap. Which of the two holds a value cannot be seen from outside.
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

  /// The sign of a x + b y + c z + d. What the operators give, without
  /// reducing what is on the way: most of the reference's time goes in here.
  friend int sign_of_affine(const Rational& a, const Rational& x,
                            const Rational& b, const Rational& y,
                            const Rational& c, const Rational& z,
                            const Rational& d) {
    Int128 value;
    if (small_affine(a, x, b, y, c, z, d, value))
      return value > 0 ? 1 : value < 0 ? -1 : 0;
    return sign_of_big_affine(a, x, b, y, c, z, d);
  }

  /// The greatest integer not above the value.
  friend Rational floor(const Rational& a);

  /// The double nearest to the value, ties to even; infinite beyond doubles.
  friend double nearest_double(const Rational& a);

  /// The value as a BigRational.
  BigRational big() const;

  /// The value, if it is an integer of 64 bits.
  /// Requires: it is.
  std::int64_t to_int64() const;

 private:
  static bool is_word(Int128 value) {
    return value == static_cast<std::int64_t>(value);
  }
  bool is_small_word() const { return !big_ && is_word(small_); }
  /// a x + b y + c z + d, if all are small and no step overflows.
  static bool small_affine(const Rational& a, const Rational& x,
                           const Rational& b, const Rational& y,
                           const Rational& c, const Rational& z,
                           const Rational& d, Int128& value) {
    return a.is_small_word() && x.is_small_word() && b.is_small_word() &&
           y.is_small_word() && c.is_small_word() && z.is_small_word() &&
           !d.big_ &&
           !__builtin_add_overflow(a.small_ * x.small_, b.small_ * y.small_,
                                   &value) &&
           !__builtin_add_overflow(value, c.small_ * z.small_, &value) &&
           !__builtin_add_overflow(value, d.small_, &value);
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

  Int128 small_ = 0;  ///< the value, where big_ is null
  std::unique_ptr<BigRational> big_;
};

}  // namespace halfspace::ref
