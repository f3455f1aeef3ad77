#include "halfspace/ref/rational.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace halfspace::ref {
namespace {

BigRational power_of_2(int exponent) {
  BigRational power = 1;
  for (int i = 0; i < std::abs(exponent); ++i) power *= 2;
  return exponent < 0 ? BigRational(1 / power) : power;
}

/// Values at and beside every border between the forms, and between words.
std::vector<BigRational> border_values() {
  std::vector<BigRational> values = {0, BigRational(1) / 2, BigRational(-1) / 2,
                                     BigRational(7) / 3, BigRational(-7) / 3};
  for (const int bits : {0, 1, 31, 61, 63, 64, 127, 128, 183, 184, 192, 200}) {
    for (const int beside : {-1, 0, 1}) {
      values.push_back(power_of_2(bits) + beside);
      values.push_back(-power_of_2(bits) + beside);
    }
    values.push_back(power_of_2(bits) / 3);
    values.push_back(-1 / (power_of_2(bits) + 1));
  }
  return values;
}

int sign_of(const BigRational& value) {
  return value > 0 ? 1 : value < 0 ? -1 : 0;
}

TEST(Rational, ArithmeticAgreesWithBigRationalsAtEveryBorder) {
  const std::vector<BigRational> values = border_values();
  for (const BigRational& p : values) {
    const Rational a(p);
    ASSERT_EQ(a.big(), p);
    EXPECT_EQ(sign(a), sign_of(p)) << p;
    EXPECT_EQ((-a).big(), BigRational(-p));
    for (const BigRational& q : values) {
      const Rational b(q);
      EXPECT_EQ((a + b).big(), BigRational(p + q)) << p << " + " << q;
      EXPECT_EQ((a - b).big(), BigRational(p - q)) << p << " - " << q;
      EXPECT_EQ((a * b).big(), BigRational(p * q)) << p << " * " << q;
      if (q != 0) {
        EXPECT_EQ((a / b).big(), BigRational(p / q)) << p << " / " << q;
      }
      EXPECT_EQ(a == b, p == q) << p << " == " << q;
      EXPECT_EQ(a < b, p < q) << p << " < " << q;
      EXPECT_EQ(a > b, p > q) << p << " > " << q;
      EXPECT_EQ(a <= b, p <= q) << p << " <= " << q;
      EXPECT_EQ(a >= b, p >= q) << p << " >= " << q;
    }
  }
}

TEST(Rational, AValueHasOneFormHoweverItIsReached) {
  for (const BigRational& p : border_values()) {
    const Rational a(p);
    // Away over the borders and back again.
    const Rational far(power_of_2(130));
    EXPECT_TRUE((a + far) - far == a) << p;
    EXPECT_TRUE((a * far) / far == a) << p;
    Rational b = a;
    b += far;
    b -= far;
    b *= 3;
    EXPECT_TRUE(b / 3 == a) << p;
  }
  // The ends of the integers that need no BigRational.
  const Int128 greatest = ~(Int128{1} << 127);
  EXPECT_TRUE(Rational(BigRational(power_of_2(127) - 1)) == Rational(greatest));
  EXPECT_TRUE(Rational(BigRational(-power_of_2(127))) ==
              Rational(-greatest - 1));
}

TEST(Rational, CopiesAreOfTheirOwn) {
  const Rational third = Rational(1) / 3;
  Rational a = third;
  Rational b = a;
  a += 1;
  EXPECT_EQ(b.big(), third.big());
  b = a;
  a = Rational(5);
  EXPECT_EQ(b.big(), BigRational(4) / 3);
  b = *&b;
  EXPECT_EQ(b.big(), BigRational(4) / 3);
}

TEST(Rational, TheSignOfAnAffineExpressionIsThatOfItsValue) {
  const std::vector<BigRational> values = border_values();
  std::mt19937_64 random(/*seed=*/1);
  for (const BigRational& p : values) {
    const Rational d(p);
    EXPECT_EQ(sign_of_affine(0, 1, 0, 1, 0, 1, d), sign(d)) << p;
    EXPECT_EQ(sign_of_affine(-1, 2, 1, 1, 1, 1, d), sign(d)) << p;
  }
  int zeros = 0;
  for (int run = 0; run < 5000; ++run) {
    const auto draw = [&] {
      return Rational(values[random() % values.size()]);
    };
    const Rational a = draw(), x = draw(), b = draw(), y = draw(), c = draw(),
                   z = draw();
    const Rational sum = a * x + b * y + c * z;
    for (const Rational& d : {draw(), -sum, 1 - sum, -1 - sum}) {
      const int expected = sign(sum + d);
      ASSERT_EQ(sign_of_affine(a, x, b, y, c, z, d), expected)
          << a.big() << " " << x.big() << " " << b.big() << " " << y.big()
          << " " << c.big() << " " << z.big() << " " << d.big();
      zeros += expected == 0 ? 1 : 0;
    }
  }
  EXPECT_GE(zeros, 5000);
}

TEST(Rational, FloorIsTheGreatestIntegerNotAbove) {
  for (const BigRational& p : border_values()) {
    const Rational below = floor(Rational(p));
    EXPECT_EQ(denominator(below.big()), 1) << p;
    EXPECT_LE(below.big(), p);
    EXPECT_GT(BigRational(below.big() + 1), p);
  }
}

TEST(Rational, Words) {
  constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();
  constexpr std::int64_t kGreatest = std::numeric_limits<std::int64_t>::max();
  EXPECT_EQ(Rational(kLeast).to_int64(), kLeast);
  EXPECT_EQ(Rational(kGreatest).to_int64(), kGreatest);
  EXPECT_EQ((Rational(kGreatest) * kGreatest / kGreatest).to_int64(),
            kGreatest);
  EXPECT_DEATH((void)(Rational(kGreatest) + 1).to_int64(), "precondition");
  EXPECT_DEATH((void)(Rational(1) / 2).to_int64(), "precondition");
  EXPECT_DEATH((void)(Rational(1) / 0), "precondition");
}

TEST(Rational, TheNearestDoubleHasNoDoubleNearer) {
  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<BigRational> values = border_values();
  // Ties and their neighbours: normal, on the border of subnormals, least.
  for (const int exponent : {0, 1, 53, 500, -969, -1021, -1022}) {
    for (const int odd : {0, 1}) {
      const BigRational half = power_of_2(exponent - 53);
      const BigRational tie = power_of_2(exponent) + (2 * odd + 1) * half;
      for (const BigRational& v :
           {tie, BigRational(tie + half / 1000), BigRational(tie - half / 7)}) {
        values.push_back(v);
        values.push_back(-v);
      }
    }
  }
  for (int eighths = 1; eighths < 30; ++eighths) {
    values.push_back(power_of_2(-1074) * eighths / 8);
  }
  for (const BigRational& v : values) {
    const double nearest = nearest_double(Rational(v));
    const BigRational move = abs(BigRational(BigRational(nearest) - v));
    for (const double other : {std::nextafter(nearest, infinity),
                               std::nextafter(nearest, -infinity)}) {
      const BigRational alternative = abs(BigRational(BigRational(other) - v));
      ASSERT_LE(move, alternative) << v;
      if (move == alternative) {
        EXPECT_EQ(std::bit_cast<std::uint64_t>(nearest) % 2, 0) << v;
      }
    }
  }
}

TEST(Rational, TheNearestDoubleKeepsDoublesAndEndsInInfinity) {
  const double greatest = std::numeric_limits<double>::max();
  for (const double value :
       {0.0, 1.0, -0.1, 1e300, 0x1p-1074, -0x1p-1022, greatest, -greatest}) {
    EXPECT_EQ(nearest_double(Rational(BigRational(value))), value);
  }
  const BigRational tie = BigRational(greatest) + power_of_2(970);
  EXPECT_EQ(nearest_double(Rational(BigRational(tie - 1))), greatest);
  EXPECT_EQ(nearest_double(Rational(tie)), INFINITY);
  EXPECT_EQ(nearest_double(Rational(BigRational(-tie))), -INFINITY);
  EXPECT_EQ(nearest_double(Rational(power_of_2(-1075))), 0);
}

}  // namespace
}  // namespace halfspace::ref
