#include "weights.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "halfspace/io/attributes.hpp"

namespace halfspace::csg {
namespace {

/// A double as mantissa * 2^exponent.
struct Binary {
  std::int64_t mantissa = 0;
  int exponent = 0;
};

Binary binary_of(double value) {
  if (value == 0) return {};
  Binary result;
  result.mantissa = static_cast<std::int64_t>(
      std::ldexp(std::frexp(value, &result.exponent), 53));
  result.exponent -= 53;
  return result;
}

/// The doubles as integers of one unit, a power of two, whose exponent it is.
template <std::size_t n>
int as_integers(const std::array<double, n>& values,
                std::array<Integer, n>& integers) {
  std::array<Binary, n> parts;
  int least = 0;
  for (std::size_t i = 0; i < n; ++i) {
    parts[i] = binary_of(values[i]);
    least = std::min(least, parts[i].exponent);
  }
  for (std::size_t i = 0; i < n; ++i) {
    integers[i] = Integer(parts[i].mantissa)
                  << static_cast<unsigned>(parts[i].exponent - least);
  }
  return least;
}

}  // namespace

Weights weights_of(const std::array<DoublePoint, 3>& p, const DoublePoint& at,
                   std::size_t axis) {
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  std::array<Integer, 8> q;
  as_integers<8>(
      {p[0][u], p[0][v], p[1][u], p[1][v], p[2][u], p[2][v], at[u], at[v]}, q);
  const auto area2 = [&q](std::size_t a, std::size_t b, std::size_t c) {
    return Integer((q[2 * b] - q[2 * a]) * (q[2 * c + 1] - q[2 * a + 1]) -
                   (q[2 * b + 1] - q[2 * a + 1]) * (q[2 * c] - q[2 * a]));
  };
  Weights weights{{area2(1, 2, 3), area2(2, 0, 3), area2(0, 1, 3)},
                  area2(0, 1, 2)};
  if (weights.below < 0) {
    weights.below = -weights.below;
    for (Integer& weight : weights.weight) weight = -weight;
  }
  return weights;
}

double mean_of(const Weights& weights, const std::array<double, 3>& values) {
  for (const double value : values) {
    if (std::isnan(value)) return io::kNoValue;
  }
  if (values[0] == values[1] && values[1] == values[2]) return values[0];
  std::array<Integer, 3> v;
  const int exponent = as_integers<3>(values, v);
  Integer sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += weights.weight[k] * v[k];
  return nearest_double(sum, weights.below << static_cast<unsigned>(-exponent));
}

}  // namespace halfspace::csg
