#include "functions.hpp"

#include <cmath>
#include <utility>

namespace halfspace::csg {
namespace {

using io::Number;

struct Named {
  std::string_view word;
  Function function;
  std::string_view wanted;
};

constexpr Named kFunctions[] = {
    {"translate", Function::kTranslate, "3 numbers"},
    {"scale", Function::kScale, "1 or 3 numbers"},
    {"rotate", Function::kRotate, "3 numbers for the axis and 1 in degrees"},
    {"matrix", Function::kMatrix, "12 numbers, row by row"},
    {"half", Function::kHalf, "9 numbers for three points, or as in x < 5"},
};

Error wrong_count(Function function, const Place& place) {
  const Named& named = kFunctions[static_cast<std::size_t>(function)];
  return error_at(
      place, ErrorCode::kSyntax,
      std::string(named.word) + " takes " + std::string(named.wanted));
}

Number difference(const Number& a, Number b) {
  b.mantissa = -b.mantissa;
  return sum(a, b);
}

/// Whether three points are on one line.
bool on_a_line(const HalfSpace& points) {
  Numbers3 u;
  Numbers3 v;
  for (std::size_t i = 0; i < 3; ++i) {
    u[i] = difference(points[1][i], points[0][i]);
    v[i] = difference(points[2][i], points[0][i]);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (difference(product(u[i], v[j]), product(u[j], v[i])).mantissa != 0)
      return false;
  }
  return true;
}

Result<Matrix> rotation_at(const Place& place,
                           const std::vector<Number>& numbers) {
  double longest = 0;
  for (std::size_t i = 0; i < 3; ++i)
    longest = std::max(longest, std::abs(io::to_double(numbers[i])));
  if (!std::isfinite(longest) || !std::isfinite(io::to_double(numbers[3]))) {
    return error_at(place, ErrorCode::kOutOfRange,
                    "an axis or an angle is beyond the range of doubles");
  }
  if (longest == 0) {
    return error_at(place, ErrorCode::kZeroArea,
                    "the axis of this turn has no direction");
  }
  return rotation({numbers[0], numbers[1], numbers[2]}, numbers[3]);
}

}  // namespace

std::optional<Function> function_named(std::string_view word) {
  for (const Named& named : kFunctions) {
    if (named.word == word) return named.function;
  }
  return std::nullopt;
}

std::string numbers_wanted(Function function) {
  return std::string(kFunctions[static_cast<std::size_t>(function)].wanted);
}

bool is_function(std::string_view word) {
  return function_named(word).has_value();
}

Result<Number> number_in(const Token& token, bool negative) {
  Result<Number> number = io::parse_number(token.text);
  if (!number || !is_handy(*number)) {
    return error_at(token.place, ErrorCode::kOutOfRange,
                    in_quotes(token.text) + " has too many digits");
  }
  if (negative) number->mantissa = -number->mantissa;
  return number;
}

Result<Matrix> transform_of(Function function, const Place& place,
                            const std::vector<Number>& numbers) {
  const std::size_t count = numbers.size();
  Matrix matrix;
  switch (function) {
    case Function::kTranslate:
      if (count != 3) return wrong_count(function, place);
      matrix = translation({numbers[0], numbers[1], numbers[2]});
      break;
    case Function::kScale:
      if (count != 1 && count != 3) return wrong_count(function, place);
      matrix = scaling({numbers[0], numbers[count == 1 ? 0 : 1],
                        numbers[count == 1 ? 0 : 2]});
      break;
    case Function::kRotate: {
      if (count != 4) return wrong_count(function, place);
      Result<Matrix> turn = rotation_at(place, numbers);
      if (!turn) return turn.error();
      matrix = *std::move(turn);
      break;
    }
    case Function::kMatrix:
      if (count != 12) return wrong_count(function, place);
      for (std::size_t i = 0; i < 12; ++i)
        matrix.rows[i / 4][i % 4] = numbers[i];
      break;
    case Function::kHalf:
      return wrong_count(function, place);
  }
  if (determinant_sign(matrix) == 0) {
    return error_at(place, ErrorCode::kZeroArea,
                    "this transform makes everything flat");
  }
  return matrix;
}

Result<HalfSpace> half_of(const Place& place,
                          const std::vector<Number>& numbers) {
  if (numbers.size() != 9) return wrong_count(Function::kHalf, place);
  HalfSpace half;
  for (std::size_t i = 0; i < 9; ++i) half[i / 3][i % 3] = numbers[i];
  if (on_a_line(half)) {
    return error_at(place, ErrorCode::kZeroArea,
                    "the three points are on one line");
  }
  return half;
}

HalfSpace axis_half(std::size_t axis, bool less, const Number& value) {
  HalfSpace half;
  for (Numbers3& point : half) point[axis] = value;
  // One step along the next axis, and one along the one after it.
  const Number one{1, 0, 0};
  half[less ? 1 : 2][(axis + 1) % 3] = one;
  half[less ? 2 : 1][(axis + 2) % 3] = one;
  return half;
}

}  // namespace halfspace::csg
