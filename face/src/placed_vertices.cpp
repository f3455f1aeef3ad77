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
    std::size_t used = 0, only = 3;
    for (std::size_t j = 0; j < 4; ++j) {
      Factor& factor = rows_[i][j];
      factor = factor_of(matrix.rows[i][j]);
      if (factor.mantissa.high == 0) continue;
      factor.two -= unit.exponent;
      factor.five -= unit.base == 10 ? unit.exponent : 0;
      ++used;
      only = j;
    }
    constexpr std::int32_t kMostTwo = 200, kMostFive = 22;
    if (used != 1 || only == 3 || data.from == LeafData::From::kOthers)
      continue;
    const Factor& factor = rows_[i][only];
    if (std::abs(factor.mantissa.high) != 1 || factor.five < 0 ||
        factor.five > kMostFive || std::abs(factor.two) > kMostTwo ||
        (factor.five > 0 && factor.two < 0))
      continue;
    only_[i] = only;
    has_five_[i] = factor.five > 0;
    factor_[i] =
        scaled(factor.mantissa * power_of_five(factor.five), factor.two).high;
  }
}

/// The coordinate where it is a whole number of steps, and a double tells.
std::optional<double> PlacedVertices::whole_coordinate(std::size_t vertex,
                                                       std::size_t axis) const {
  const std::size_t j = only_[axis];
  if (j == 3) return std::nullopt;
  const Point& p = data_.properties->vertices[vertex];
  const double from = j == 0 ? p.x : (j == 1 ? p.y : p.z);
  const double at = from * factor_[axis];
  if (std::floor(at) != at || !(std::abs(at) < 0x1p53)) return std::nullopt;
  if (at == 0 && from != 0) return std::nullopt;  // maybe an underflow
  // Below 10^15 a whole number is the short decimal, too. The product is exact
  // where the factor is a power of two, and where both are whole and it is
  // below 2^53.
  const bool is_whole = std::abs(from) < 1e15 && std::floor(from) == from;
  const bool is_double = data_.from == LeafData::From::kDoubles;
  if (is_whole || (is_double && !has_five_[axis])) return at;
  return std::nullopt;
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

const PlacedVertices::Vertex& PlacedVertices::placed(std::size_t vertex) {
  Vertex& v = placed_[vertex];
  if (v.state != State::kUnknown) return v;
  v.state = State::kGrid;
  std::array<std::int64_t, 3> at{};
  for (std::size_t i = 0; i < 3; ++i) {
    if (const auto whole = whole_coordinate(vertex, i)) {
      at[i] = static_cast<std::int64_t>(*whole);
      continue;
    }
    const Bounded c = coordinate(vertex, i);
    const bool is_whole = c.error == 0 && c.low == 0 &&
                          std::abs(c.high) < 0x1p53 &&
                          std::floor(c.high) == c.high;
    if (!is_whole) {
      v.state = State::kBetween;
      return v;
    }
    at[i] = static_cast<std::int64_t>(c.high);
  }
  v.grid = {at[0], at[1], at[2]};
  return v;
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
