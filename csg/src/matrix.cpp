#include "halfspace/csg/matrix.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "numbers.hpp"

namespace halfspace::csg {
namespace {

using io::Integer;
using io::Number;

/// The most that a decimal in a text needs (io::kMaxDecimalPlaces), about.
constexpr std::size_t kMostBits = 4096;
constexpr std::int32_t kMostExponent = 2600;

/// The number's mantissa where its powers are `two` and `five`, no more than
/// its own.
Integer at_powers(const Number& number, std::int32_t two, std::int32_t five) {
  Integer value = number.mantissa *
                  pow(Integer(5), static_cast<unsigned>(number.five - five));
  return value << static_cast<unsigned>(number.two - two);
}

/// The determinant of two columns in two rows.
Number minor_of(const Matrix& m, std::size_t column, std::size_t other) {
  return sum(product(m.rows[1][column], m.rows[2][other]),
             negative(product(m.rows[1][other], m.rows[2][column])));
}

/// How many quarter turns the angle is, from 0 to 3, if it is that exactly.
std::optional<int> quarter_turns(const Number& degrees) {
  if (degrees.two < 0 || degrees.five < 0) return std::nullopt;
  const double angle = io::to_double(degrees);
  if (std::abs(angle) > 0x1p52) return std::nullopt;
  const double rest = std::fmod(angle, 360.0);
  const double quarters = rest / 90;
  if (std::floor(quarters) != quarters) return std::nullopt;
  return (static_cast<int>(quarters) + 4) % 4;
}

struct CosineAndSine {
  double cosine;
  double sine;
};

CosineAndSine of_angle(const Number& degrees) {
  if (const std::optional<int> quarters = quarter_turns(degrees)) {
    constexpr double kValues[] = {1, 0, -1, 0};
    return {kValues[*quarters], kValues[(*quarters + 3) % 4]};
  }
  const long double angle = std::fmod(io::to_double(degrees), 360.0) *
                            std::numbers::pi_v<long double> / 180;
  // Rounded to doubles from something longer: nearly always the nearest ones,
  // so that other machines make the same turn.
  return {static_cast<double>(std::cos(angle)),
          static_cast<double>(std::sin(angle))};
}

/// The turn about coordinate axis `axis`.
Matrix turn_about(std::size_t axis, const CosineAndSine& angle) {
  Matrix m = identity_matrix();
  const std::size_t u = (axis + 1) % 3;
  const std::size_t v = (axis + 2) % 3;
  m.rows[u][u] = m.rows[v][v] = io::number_of(angle.cosine);
  m.rows[v][u] = io::number_of(angle.sine);
  m.rows[u][v] = negative(m.rows[v][u]);
  return m;
}

}  // namespace

bool comes_before(const Number& a, const Number& b) {
  if (a.two != b.two) return a.two < b.two;
  if (a.five != b.five) return a.five < b.five;
  return a.mantissa < b.mantissa;
}

bool comes_before(const Matrix& a, const Matrix& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      if (!(a.rows[i][j] == b.rows[i][j]))
        return comes_before(a.rows[i][j], b.rows[i][j]);
    }
  }
  return false;
}

Number sum(const Number& a, const Number& b) {
  if (a.mantissa == 0) return b;
  if (b.mantissa == 0) return a;
  const std::int32_t two = std::min(a.two, b.two);
  const std::int32_t five = std::min(a.five, b.five);
  return io::normalised(at_powers(a, two, five) + at_powers(b, two, five), two,
                        five);
}

Number product(const Number& a, const Number& b) {
  if (a.mantissa == 0 || b.mantissa == 0) return {};
  return {a.mantissa * b.mantissa, a.two + b.two, a.five + b.five};
}

Matrix identity_matrix() {
  const Number one{1, 0, 0};
  return scaling({one, one, one});
}

Matrix translation(const Numbers3& by) {
  Matrix m = identity_matrix();
  for (std::size_t i = 0; i < 3; ++i) m.rows[i][3] = by[i];
  return m;
}

Matrix scaling(const Numbers3& by) {
  Matrix m;
  for (std::size_t i = 0; i < 3; ++i) m.rows[i][i] = by[i];
  return m;
}

Matrix rotation(const Numbers3& axis, const Number& degrees) {
  const CosineAndSine angle = of_angle(degrees);
  for (std::size_t i = 0; i < 3; ++i) {
    if (axis[(i + 1) % 3].mantissa != 0 || axis[(i + 2) % 3].mantissa != 0)
      continue;
    return turn_about(i, axis[i].mantissa > 0
                             ? angle
                             : CosineAndSine{angle.cosine, -angle.sine});
  }
  // Step 1: the axis, of length one. The longest component becomes 1 first,
  // so that squares do not overflow.
  std::array<long double, 3> k{};
  for (std::size_t i = 0; i < 3; ++i) k[i] = io::to_double(axis[i]);
  const long double longest =
      std::max({std::abs(k[0]), std::abs(k[1]), std::abs(k[2])});
  for (long double& c : k) c /= longest;
  const long double length = std::sqrt(k[0] * k[0] + k[1] * k[1] + k[2] * k[2]);
  for (long double& c : k) c /= length;
  // Step 2: the part along the axis stays, the part across it turns.
  Matrix m;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      long double entry = (1 - static_cast<long double>(angle.cosine)) * k[i];
      entry *= k[j];
      if (i == j) entry += angle.cosine;
      if (j == (i + 1) % 3) entry -= angle.sine * k[(i + 2) % 3];
      if (j == (i + 2) % 3) entry += angle.sine * k[(i + 1) % 3];
      m.rows[i][j] = io::number_of(static_cast<double>(entry));
    }
  }
  return m;
}

bool is_handy(const Number& number) {
  return number.mantissa == 0 || (msb(abs(number.mantissa)) < kMostBits &&
                                  std::abs(number.two) <= kMostExponent &&
                                  std::abs(number.five) <= kMostExponent);
}

std::optional<Matrix> product(const Matrix& outer, const Matrix& inner) {
  Matrix m;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      Number entry = j == 3 ? outer.rows[i][3] : Number{};
      for (std::size_t k = 0; k < 3; ++k)
        entry = sum(entry, product(outer.rows[i][k], inner.rows[k][j]));
      if (!is_handy(entry)) return std::nullopt;
      m.rows[i][j] = std::move(entry);
    }
  }
  return m;
}

int determinant_sign(const Matrix& m) {
  const Number value =
      sum(sum(product(m.rows[0][0], minor_of(m, 1, 2)),
              negative(product(m.rows[0][1], minor_of(m, 0, 2)))),
          product(m.rows[0][2], minor_of(m, 0, 1)));
  return value.mantissa.sign();
}

Numbers3 image_of(const Matrix& matrix, const Numbers3& point) {
  Numbers3 image;
  for (std::size_t i = 0; i < 3; ++i) {
    image[i] = matrix.rows[i][3];
    for (std::size_t j = 0; j < 3; ++j)
      image[i] = sum(image[i], product(matrix.rows[i][j], point[j]));
  }
  return image;
}

}  // namespace halfspace::csg
