#include "canonical/own_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "canonical/big_vector.hpp"

namespace halfspace::fast {
namespace {

/// How often a prime divides a number that is not 0, which is divided by it so
/// often.
int take_out(BigInteger& number, int prime) {
  int count = 0;
  if (prime == 2) {
    count = static_cast<int>(lsb(abs(number)));
    number >>= static_cast<unsigned>(count);
    return count;
  }
  for (; number % prime == 0; ++count) number /= prime;
  return count;
}

BigInteger power(int base, int exponent) {
  return pow(BigInteger(base), static_cast<unsigned>(exponent));
}

}  // namespace

void Fineness::add(const Fineness& other) {
  two = std::max(two, other.two);
  five = std::max(five, other.five);
}

std::optional<Fineness> fineness_of(BigInteger numerator,
                                    BigInteger denominator, const Unit& unit) {
  if (numerator == 0) return Fineness{};
  const BigInteger divisor = gcd(numerator, denominator);
  numerator /= divisor;
  denominator /= divisor;
  const int five_of_unit = unit.base == 10 ? unit.exponent : 0;
  Fineness need;
  need.two = take_out(denominator, 2) - take_out(numerator, 2) - unit.exponent;
  need.five = take_out(denominator, 5) - take_out(numerator, 5) - five_of_unit;
  if (abs(denominator) != 1) return std::nullopt;
  return Fineness{std::max(need.two, 0), std::max(need.five, 0)};
}

Unit unit_of(const Fineness& need) {
  if (need.five == 0 && need.two > 0) return {2, -need.two};
  return {10, -std::max(need.two, need.five)};
}

StepRatio::StepRatio(const Unit& from, const Unit& to) {
  const auto five = [](const Unit& unit) {
    return unit.base == 10 ? unit.exponent : 0;
  };
  const int two_exponent = from.exponent - to.exponent;
  const int five_exponent = five(from) - five(to);
  (two_exponent < 0 ? by_ : times_) *= power(2, std::abs(two_exponent));
  (five_exponent < 0 ? by_ : times_) *= power(5, std::abs(five_exponent));
  value_ = std::ldexp(std::pow(5.0, five_exponent), two_exponent);
}

std::optional<BigInteger> StepRatio::operator()(const BigInteger& steps,
                                                const BigInteger& below) const {
  const BigInteger product = steps * times_;
  const BigInteger divisor = by_ * below;
  BigInteger quotient = product / divisor;
  if (quotient * divisor != product) return std::nullopt;
  return quotient;
}

std::optional<GridPoint> StepRatio::operator()(const GridPoint& point) const {
  if (is_one()) return point;
  return (*this)({point.x, point.y, point.z, 1});
}

std::optional<GridPoint> StepRatio::operator()(
    const std::array<BigInteger, 4>& vertex) const {
  std::array<std::int64_t, 3> at{};
  const BigInteger limit = BigInteger(1) << 53;
  const BigInteger below = by_ * vertex[3];
  for (std::size_t k = 0; k < 3; ++k) {
    const BigInteger product = vertex[k] * times_;
    const BigInteger steps = product / below;
    if (steps * below != product || steps < -limit || steps >= limit)
      return std::nullopt;
    at[k] = steps.convert_to<std::int64_t>();
  }
  return GridPoint{at[0], at[1], at[2]};
}

BigInteger offset_of(const GeometryTable& table, std::int32_t plane) {
  const GridPoint& at = table.plane(plane).origin;
  return dot(to_big_vector(table.reduced_normal(plane)), {at.x, at.y, at.z});
}

std::array<BigInteger, 4> exact_vertex(const GeometryTable& table,
                                       std::int32_t vertex) {
  const TableVertex& v = table.vertex(vertex);
  if (v.is_grid()) {
    const GridPoint at = v.point();
    return {at.x, at.y, at.z, 1};
  }
  // Cramer's rule: the offsets weigh the cross products of the other two.
  std::array<BigVector, 3> n;
  for (std::size_t i = 0; i < 3; ++i)
    n[i] = to_big_vector(table.reduced_normal(v.planes[i]));
  std::array<BigInteger, 4> exact;
  for (std::size_t i = 0; i < 3; ++i) {
    const BigInteger offset = offset_of(table, v.planes[i]);
    const BigVector product = cross(n[(i + 1) % 3], n[(i + 2) % 3]);
    for (std::size_t k = 0; k < 3; ++k) exact[k] += offset * product[k];
    if (i == 0) exact[3] = dot(n[0], product);
  }
  if (exact[3] < 0) {
    for (BigInteger& value : exact) value = -value;
  }
  return exact;
}

}  // namespace halfspace::fast
