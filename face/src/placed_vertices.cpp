#include "placed_vertices.hpp"

#include <cmath>
#include <limits>

namespace halfspace::detail {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Of which nothing is known.
constexpr Bounded kAnything{0, 0, kInfinity};

Bounded bounded_integer(const io::Integer& value) {
  const auto& digits = value.backend();
  if (digits.size() == 1) {
    const Int128 size = *digits.limbs();
    return bounded(value.sign() < 0 ? -size : size);
  }
  constexpr unsigned kMostBits = 400;
  if (msb(io::Integer(abs(value))) > kMostBits) return kAnything;
  const auto high = static_cast<double>(value);
  const auto rest = io::Integer(value - io::Integer(high));
  const auto low = static_cast<double>(rest);
  const bool is_exact = io::Integer(low) == rest;
  return {high, low, is_exact ? 0 : 0x1p-50 * std::abs(low)};
}

/// Requires: 0 <= exponent.
Bounded power_of_five(std::int32_t exponent) {
  // 5^22 is the last that a double holds.
  constexpr std::int32_t kStep = 22, kMost = 8 * kStep;
  if (exponent > kMost) return kAnything;
  Bounded power{1};
  for (; exponent > kStep; exponent -= kStep)
    power = power * Bounded{2384185791015625.0};
  double rest = 1;
  for (; exponent > 0; --exponent) rest *= 5;
  return power * Bounded{rest};
}

Bounded scaled(const Bounded& value, std::int32_t two) {
  constexpr std::int32_t kMost = 200;
  if (two == 0) return value;
  if (two > kMost || two < -kMost) return kAnything;
  const double factor = std::ldexp(1.0, two);
  return {value.high * factor, value.low * factor, value.error * factor};
}

using Vector = std::array<Bounded, 3>;

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
          a[0] * b[1] - a[1] * b[0]};
}

Bounded dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace

PlacedVertices::Factor PlacedVertices::factor_of(const io::Number& number) {
  return {bounded_integer(number.mantissa), number.two, number.five};
}

PlacedVertices::PlacedVertices(const csg::Matrix& matrix, const Unit& unit,
                               const LeafData& data)
    : matrix_(matrix),
      unit_(unit),
      from_(data.vertices),
      data_(data),
      placed_(data.vertices.size()) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      Factor& factor = rows_[i][j];
      factor = factor_of(matrix.rows[i][j]);
      if (factor.mantissa.high == 0) continue;
      factor.two -= unit.exponent;
      factor.five -= unit.base == 10 ? unit.exponent : 0;
    }
    plain_[i] = plain_row(rows_[i]);
  }
  place_by_doubles();
}

PlacedVertices::PlainRow PlacedVertices::plain_row(
    const std::array<Factor, 4>& row) const {
  PlainRow plain;
  if (row[3].mantissa.high != 0) return plain;
  std::size_t only = 3, used = 0;
  for (std::size_t j = 0; j < 3; ++j) {
    if (row[j].mantissa.high == 0) continue;
    only = j;
    ++used;
  }
  if (used != 1) return plain;
  constexpr std::int32_t kMostTwo = 200, kMostFive = 22;
  const Factor& f = row[only];
  if (std::abs(f.mantissa.high) != 1 || f.five < 0 || f.five > kMostFive ||
      std::abs(f.two) > kMostTwo || (f.five > 0 && f.two < 0))
    return plain;
  plain.from = only;
  plain.factor = scaled(f.mantissa * power_of_five(f.five), f.two).high;
  plain.is_power_of_two = f.five == 0;
  // The factor but for powers of ten is at most 2^9 or 5^4.
  plain.is_for_decimals =
      f.two >= 0 && f.two - f.five <= 9 && f.five - f.two <= 4;
  return plain;
}

/// Whether doubles tell that the coordinate is a whole number of steps: `at`.
///
/// - A whole number below 10^15 is the short decimal, too. The product is exact
///   where the factor is a power of two, and where both are whole and it is
///   below 2^53. So it is of a double that stands for itself.
/// - A decimal M * 10^-e, |M| < 10^12, times F * 10^k, F < 1000: unless that is
///   whole, it is 10^(k-e) or more away from what is, for e > k. With
///   u = 2^-53 the product is off by 2.01u of its size, at most, for its double
///   and itself are rounded. Its size is below 10^15 * 10^(k-e), so what is
///   whole comes out within 2.01u of its size, and what is not farther away
///   than 10^(k-e) * (1 - 0.23), which is more than 4u of it. Below 2^50 the
///   first is less than 1/2.
bool PlacedVertices::is_whole(const PlainRow& row, double from,
                              double& at) const {
  const double product = from * row.factor;
  at = std::nearbyint(product);
  if (product == 0 && from != 0) return false;  // maybe an underflow
  const bool is_exact =
      (std::abs(from) < 1e15 && std::floor(from) == from) ||
      (data_.from == LeafData::From::kDoubles && row.is_power_of_two);
  if (is_exact) return at == product && std::abs(at) < 0x1p53;
  return data_.from == LeafData::From::kShortDecimals && row.is_for_decimals &&
         std::abs(at) < 0x1p50 &&
         std::abs(at - product) <= 0x1p-51 * std::abs(product);
}

/// Puts those on the grid of which doubles tell that they are.
void PlacedVertices::place_by_doubles() {
  if (data_.from == LeafData::From::kOthers) return;
  for (const PlainRow& row : plain_) {
    if (row.from == 3) return;
  }
  const std::vector<Point>& points = data_.properties->vertices;
  for (std::size_t v = 0; v < points.size(); ++v) {
    const std::array<double, 3> from = {points[v].x, points[v].y, points[v].z};
    std::array<double, 3> at{};
    bool are_whole = true;
    for (std::size_t i = 0; i < 3; ++i)
      are_whole &= is_whole(plain_[i], from[plain_[i].from], at[i]);
    if (!are_whole) continue;
    placed_[v] = {
        State::kGrid,
        {static_cast<std::int64_t>(at[0]), static_cast<std::int64_t>(at[1]),
         static_cast<std::int64_t>(at[2])}};
  }
}

Bounded PlacedVertices::product_of(const Factor& a, const Factor& b) {
  const Bounded mantissa = a.mantissa * b.mantissa;
  const std::int32_t five = a.five + b.five;
  const std::int32_t two = a.two + b.two;
  if (five == 0) return scaled(mantissa, two);
  if (five > 0) return scaled(mantissa * power_of_five(five), two);
  const Bounded below = power_of_five(-five);
  return scaled(is_not_zero(below) ? mantissa / below : kAnything, two);
}

Bounded PlacedVertices::coordinate(std::size_t vertex, std::size_t axis) const {
  const std::array<Factor, 4>& row = rows_[axis];
  const Factor one{Bounded{1}, 0, 0};
  Bounded sum;
  if (row[3].mantissa.high != 0) sum = product_of(row[3], one);
  for (std::size_t j = 0; j < 3; ++j) {
    const io::Number& number = from_[vertex][j];
    if (row[j].mantissa.high == 0 || number.mantissa == 0) continue;
    sum = sum + product_of(row[j], factor_of(number));
  }
  return sum;
}

void PlacedVertices::place(std::size_t vertex) {
  Vertex& v = placed_[vertex];
  v.state = State::kBetween;
  std::array<std::int64_t, 3> at{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Bounded c = coordinate(vertex, i);
    const bool is_whole = c.error == 0 && c.low == 0 &&
                          std::abs(c.high) < 0x1p53 &&
                          std::floor(c.high) == c.high;
    if (!is_whole) return;
    at[i] = static_cast<std::int64_t>(c.high);
  }
  v = {State::kGrid, {at[0], at[1], at[2]}};
}

BoundedPoint PlacedVertices::less(std::size_t vertex, const GridPoint& point) {
  if (const GridPoint* grid = on_grid(vertex)) {
    return {bounded(grid->x - point.x), bounded(grid->y - point.y),
            bounded(grid->z - point.z)};
  }
  return {coordinate(vertex, 0) - bounded(point.x),
          coordinate(vertex, 1) - bounded(point.y),
          coordinate(vertex, 2) - bounded(point.z)};
}

const csg::ExactPoint& PlacedVertices::exact(std::size_t vertex) {
  const auto [at, is_new] = exact_.try_emplace(vertex);
  if (is_new)
    at->second = csg::in_steps(csg::image_of(matrix_, from_[vertex]), unit_);
  return at->second;
}

BoundedPoint meet_less(const fast::Solid& solid,
                       const std::array<std::int32_t, 3>& planes,
                       const GridPoint& point) {
  // Cramer's rule for normal . x = normal . (origin - point).
  std::array<Vector, 3> n;
  Vector offset;
  for (std::size_t i = 0; i < 3; ++i) {
    const fast::SolidPlane plane = fast::plane_at(solid, planes[i]);
    for (std::size_t k = 0; k < 3; ++k) n[i][k] = bounded(plane.normal[k]);
    offset[i] = dot(n[i], {bounded(plane.origin.x - point.x),
                           bounded(plane.origin.y - point.y),
                           bounded(plane.origin.z - point.z)});
  }
  const Bounded below = dot(n[0], cross(n[1], n[2]));
  if (!is_not_zero(below)) return {kAnything, kAnything, kAnything};
  Vector sum;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector product = cross(n[(i + 1) % 3], n[(i + 2) % 3]);
    for (std::size_t k = 0; k < 3; ++k)
      sum[k] = sum[k] + offset[i] * product[k];
  }
  return {sum[0] / below, sum[1] / below, sum[2] / below};
}

}  // namespace halfspace::detail
