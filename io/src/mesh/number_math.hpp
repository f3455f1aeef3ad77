#pragma once

#include <algorithm>
#include <array>
#include <optional>

#include "halfspace/io/number.hpp"

namespace halfspace::io {

inline Number product_of(const Number& a, const Number& b) {
  return normalised(a.mantissa * b.mantissa, a.two + b.two, a.five + b.five);
}

inline Number sum_of(const Number& a, const Number& b) {
  if (a.mantissa == 0) return b;
  if (b.mantissa == 0) return a;
  const std::int32_t two = std::min(a.two, b.two);
  const std::int32_t five = std::min(a.five, b.five);
  const auto common = [two, five](const Number& number) {
    return Integer(
        (number.mantissa << static_cast<unsigned>(number.two - two)) *
        pow(Integer(5), static_cast<unsigned>(number.five - five)));
  };
  return normalised(common(a) + common(b), two, five);
}

using ExactPoint3 = std::array<Number, 3>;

/// An affine map of exact numbers: rows, the last column being what is added.
struct ExactMap {
  std::array<std::array<Number, 4>, 3> rows;
  friend bool operator==(const ExactMap&, const ExactMap&) = default;
};

inline ExactMap identity_map() {
  ExactMap map;
  for (std::size_t i = 0; i < 3; ++i) map.rows[i][i] = Number{1, 0, 0};
  return map;
}

inline ExactPoint3 image_of(const ExactMap& map, const ExactPoint3& point) {
  ExactPoint3 image;
  for (std::size_t i = 0; i < 3; ++i) {
    image[i] = map.rows[i][3];
    for (std::size_t k = 0; k < 3; ++k)
      image[i] = sum_of(image[i], product_of(map.rows[i][k], point[k]));
  }
  return image;
}

/// The map that does first `inner` and then `outer`; nothing where a number of
/// it has over 4096 bits.
inline std::optional<ExactMap> product_of(const ExactMap& outer,
                                          const ExactMap& inner) {
  constexpr unsigned kMostBits = 4096;
  ExactMap map;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      Number sum = j == 3 ? outer.rows[i][3] : Number{};
      for (std::size_t k = 0; k < 3; ++k)
        sum = sum_of(sum, product_of(outer.rows[i][k], inner.rows[k][j]));
      if (sum.mantissa != 0 && msb(Integer(abs(sum.mantissa))) > kMostBits)
        return std::nullopt;
      map.rows[i][j] = sum;
    }
  }
  return map;
}

/// Whether the map mirrors.
inline bool is_mirror(const ExactMap& map) {
  const auto& m = map.rows;
  Number sum;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    sum = sum_of(sum, product_of(m[0][i], product_of(m[1][j], m[2][k])));
    Number minus = product_of(m[0][i], product_of(m[1][k], m[2][j]));
    minus.mantissa = -minus.mantissa;
    sum = sum_of(sum, minus);
  }
  return sum.mantissa < 0;
}

}  // namespace halfspace::io
