#include "step_map.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "halfspace/big_integer.hpp"

namespace halfspace::csg {
namespace {

using io::Integer;
using io::Number;

Integer power(int base, std::int32_t exponent) {
  return pow(Integer(base), static_cast<unsigned>(exponent));
}

std::size_t bits_of(const Integer& value) {
  return value == 0 ? 0 : msb(abs(value)) + 1;
}

const Integer& widened(const Integer& value) { return value; }

Integer widened(Int128 value) { return to_big<Integer>(value); }

std::int32_t twos_in(const Integer& value) {
  return static_cast<std::int32_t>(lsb(abs(value)));
}

std::int32_t twos_in(Int128 value) {
  const auto low = static_cast<std::uint64_t>(value);
  if (low != 0) return std::countr_zero(low);
  return 64 + std::countr_zero(static_cast<std::uint64_t>(value >> 64));
}

double ratio(Int128 a, Int128 b) {
  return static_cast<double>(a) / static_cast<double>(b);
}

double ratio(const Integer& a, const Integer& b) {
  // What is beyond a double's range loses low bits, more than it would show.
  const std::size_t excess = std::max<std::size_t>(bits_of(b), 1000) - 1000;
  return Integer(a >> excess).convert_to<double>() /
         Integer(b >> excess).convert_to<double>();
}

/// The rows of a map in one type of numbers, which holds all images.
template <class Int>
struct Rows {
  std::array<std::array<Int, 4>, 3> k;

  Int image(std::size_t row, const GridPoint& v) const {
    return k[row][0] * v.x + k[row][1] * v.y + k[row][2] * v.z + k[row][3];
  }
};

/// Whether images of points on any grid stay below 2^124, which leaves 128-bit
/// integers room for being doubled. Coordinates are below 2^53 in size, and
/// four summands add two bits.
bool is_narrow(const StepMap& map) {
  for (const auto& row : map.rows) {
    for (std::size_t j = 0; j < 4; ++j) {
      if (bits_of(row[j]) > (j < 3 ? 69u : 122u)) return false;
    }
  }
  return true;
}

Rows<Int128> narrowed(const StepMap& map) {
  Rows<Int128> rows;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j)
      rows.k[i][j] = to_int128(map.rows[i][j]);
  }
  return rows;
}

template <class Int>
Extent extent_by(const Rows<Int>& rows, const StepMap& map,
                 std::span<const GridPoint> points) {
  if (points.empty()) return {};
  Int least = rows.image(0, points[0]);
  Int greatest = least;
  std::int32_t two = 0;
  std::int32_t five = -1;  // nothing but zeros so far
  Int power_of_five = 1;
  for (const GridPoint& point : points) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Int value = rows.image(i, point);
      if (value < least) least = value;
      if (greatest < value) greatest = value;
      if (value == 0) continue;
      if (five < 0) {
        two = twos_in(value);
        for (five = 0; value % Int(power_of_five * 5) == 0; ++five)
          power_of_five *= 5;
      }
      two = std::min(two, twos_in(value));
      for (; five > 0 && value % power_of_five != 0; --five) power_of_five /= 5;
    }
  }
  const auto number = [&](const Int& value) {
    return io::normalised(widened(value), map.two, map.five);
  };
  if (five < 0) return {};
  return {{1, map.two + two, map.five + five}, number(least), number(greatest)};
}

template <class Int>
PlacedPoints placed_by(const Rows<Int>& rows, const Int& divisor,
                       std::span<const GridPoint> points, const Unit& unit) {
  const double step = std::pow(static_cast<double>(unit.base), unit.exponent);
  PlacedPoints result;
  result.points.reserve(points.size());
  for (const GridPoint& point : points) {
    std::array<std::int64_t, 3> at{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Int value = rows.image(i, point);
      Int quotient = value;
      Int rest = 0;
      if (divisor != 1) {
        quotient = value / divisor;
        rest = value % divisor;
      }
      if (rest != 0) {
        const Int size = rest < 0 ? Int(-rest) : rest;
        const bool up = size + size >= divisor;
        if (up) quotient += value < 0 ? -1 : 1;
        ++result.moved;
        const Int off = up ? Int(divisor - size) : size;
        result.max_move = std::max(result.max_move, step * ratio(off, divisor));
      }
      at[i] = static_cast<std::int64_t>(quotient);
    }
    result.points.push_back({at[0], at[1], at[2]});
  }
  return result;
}

}  // namespace

StepMap step_map(const Matrix& matrix, const Unit& unit) {
  StepMap map;
  auto rows = matrix.rows;
  bool any = false;
  for (auto& row : rows) {
    for (std::size_t j = 0; j < 4; ++j) {
      Number& number = row[j];
      if (number.mantissa == 0) continue;
      if (j < 3) {
        number.two += unit.exponent;
        number.five += unit.base == 10 ? unit.exponent : 0;
      }
      map.two = any ? std::min(map.two, number.two) : number.two;
      map.five = any ? std::min(map.five, number.five) : number.five;
      any = true;
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      const Number& number = rows[i][j];
      if (number.mantissa == 0) continue;
      map.rows[i][j] = number.mantissa * power(5, number.five - map.five);
      map.rows[i][j] <<= static_cast<unsigned>(number.two - map.two);
    }
  }
  return map;
}

Extent extent_of(const StepMap& map, std::span<const GridPoint> points) {
  if (is_narrow(map)) return extent_by(narrowed(map), map, points);
  return extent_by(Rows<Integer>{map.rows}, map, points);
}

PlacedPoints placed(const StepMap& map, std::span<const GridPoint> points,
                    const Unit& unit) {
  const std::int32_t two = map.two - unit.exponent;
  const std::int32_t five = map.five - (unit.base == 10 ? unit.exponent : 0);
  const Integer factor =
      power(2, std::max(two, 0)) * power(5, std::max(five, 0));
  const Integer divisor =
      power(2, std::max(-two, 0)) * power(5, std::max(-five, 0));
  StepMap scaled = map;
  for (auto& row : scaled.rows) {
    for (Integer& entry : row) entry *= factor;
  }
  if (is_narrow(scaled) && bits_of(divisor) <= 124)
    return placed_by(narrowed(scaled), to_int128(divisor), points, unit);
  return placed_by(Rows<Integer>{scaled.rows}, divisor, points, unit);
}

}  // namespace halfspace::csg
