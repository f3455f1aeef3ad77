#include "functions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace halfspace::csg {
namespace {

using io::Number;

struct Named {
  std::string_view word;
  Function function;
  std::string_view wanted;
  bool is_reserved = false;  ///< no solid can have the word as its name
};

constexpr Named kFunctions[] = {
    {"translate", Function::kTranslate, "a solid and 3 numbers", true},
    {"scale", Function::kScale, "a solid and 1 or 3 numbers", true},
    {"rotate", Function::kRotate,
     "a solid, 3 numbers for the axis and 1 in degrees", true},
    {"matrix", Function::kMatrix, "a solid and 12 numbers, row by row", true},
    {"mirror", Function::kMirror,
     "a solid and 3 numbers, the normal of a plane through the origin"},
    {"half", Function::kHalf, "9 numbers for three points, or as in x < 5",
     true},
    {"flip", Function::kFlip, "a file, or a name that stands for one"},
    {"union", Function::kUnion, "solids and lists of them, at least one"},
    {"intersection", Function::kIntersection,
     "solids and lists of them, at least one"},
    {"difference", Function::kDifference,
     "solids and lists of them, at least one"},
    {"symmetric_difference", Function::kSymmetricDifference,
     "solids and lists of them, at least one"},
    {"box", Function::kBox, "1 or 3 numbers above 0"},
    {"sphere", Function::kSphere,
     "a radius above 0 and, if wanted, a number of segments from 3 to 1000"},
    {"cylinder", Function::kCylinder,
     "a radius and a height above 0 and, if wanted, a number of segments from "
     "3 to 1000"},
    {"cone", Function::kCone,
     "two radii, not both 0, a height above 0 and, if wanted, a number of "
     "segments from 3 to 1000"},
    {"torus", Function::kTorus,
     "a radius and a lesser one of its tube, both above 0, and, if wanted, one "
     "or two numbers of segments from 3 to 1000"},
    {"hull", Function::kHull,
     "3 numbers for each of at least 4 points, not all in one plane"},
    {"range", Function::kRange,
     "an end, or a begin and an end, and perhaps a step that is not 0"},
    {"length", Function::kLength, "a list"},
    {"sin", Function::kSin, "an angle in degrees"},
    {"cos", Function::kCos, "an angle in degrees"},
    {"tan", Function::kTan, "an angle in degrees"},
    {"sqrt", Function::kSqrt, "a number that is not negative"},
    {"abs", Function::kAbs, "a number"},
    {"floor", Function::kFloor, "a number"},
    {"min", Function::kMin, "numbers and lists of them, at least one"},
    {"max", Function::kMax, "numbers and lists of them, at least one"},
};

/// What other programs call these.
constexpr std::string_view kOtherWords[][2] = {
    {"cube", "box"},
    {"cuboid", "box"},
    {"block", "box"},
    {"ball", "sphere"},
    {"move", "translate"},
    {"turn", "rotate"},
    {"intersect", "intersection"},
    {"subtract", "difference"},
    {"xor", "symmetric_difference"},
    {"len", "length"},
    {"multmatrix", "matrix"},
};

/// Whether one letter more, less or other, or two that changed places, make
/// one of the other.
bool differ_by_a_slip(std::string_view a, std::string_view b) {
  const auto [in_a, in_b] =
      std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  a.remove_prefix(static_cast<std::size_t>(in_a - a.begin()));
  b.remove_prefix(static_cast<std::size_t>(in_b - b.begin()));
  while (!a.empty() && !b.empty() && a.back() == b.back()) {
    a.remove_suffix(1);
    b.remove_suffix(1);
  }
  return std::max(a.size(), b.size()) <= 1 ||
         (a.size() == 2 && b.size() == 2 && a[0] == b[1] && a[1] == b[0]);
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

/// The reflection in the plane through the origin with this normal: exact
/// along an axis, else its entries are doubles next to the true ones.
Result<Matrix> mirror_at(const Place& place,
                         const std::vector<Number>& normal) {
  std::array<double, 3> n{};
  double longest = 0;
  std::size_t zeros = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    n[i] = io::to_double(normal[i]);
    longest = std::max(longest, std::abs(n[i]));
    zeros += normal[i].mantissa == 0 ? 1u : 0u;
  }
  if (zeros == 3)
    return error_at(place, ErrorCode::kZeroArea, "the normal has no direction");
  if (!std::isfinite(longest) || longest == 0) {
    return error_at(place, ErrorCode::kOutOfRange,
                    "a normal is beyond the range of doubles");
  }
  Matrix matrix = identity_matrix();
  if (zeros == 2) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (normal[i].mantissa != 0) matrix.rows[i][i] = Number{-1, 0, 0};
    }
    return matrix;
  }
  double square = 0;
  for (double& c : n) {
    c /= longest;
    square += c * c;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const double entry = (i == j ? 1.0 : 0.0) - 2 * n[i] * n[j] / square;
      matrix.rows[i][j] = io::number_of(entry);
    }
  }
  return matrix;
}

}  // namespace

std::optional<Function> function_named(std::string_view word) {
  for (const Named& named : kFunctions) {
    if (named.word == word) return named.function;
  }
  return std::nullopt;
}

bool is_function(std::string_view word) {
  for (const Named& named : kFunctions) {
    if (named.word == word) return named.is_reserved;
  }
  return false;
}

Error no_function(const Token& name) {
  std::string sentence = "there is no function " + in_quotes(name.text);
  for (const auto& [other, word] : kOtherWords) {
    if (other == name.text)
      return error_at(
          name.place, ErrorCode::kBadIndex,
          sentence + "; it is called " + std::string(word) + " here");
  }
  for (const Named& named : kFunctions) {
    if (differ_by_a_slip(named.word, name.text))
      return error_at(name.place, ErrorCode::kBadIndex,
                      sentence + "; is " + std::string(named.word) + " meant?");
  }
  return error_at(name.place, ErrorCode::kBadIndex, std::move(sentence));
}

Error wrong_call(Function function, const Place& place) {
  const Named& named = kFunctions[static_cast<std::size_t>(function)];
  return error_at(
      place, ErrorCode::kSyntax,
      std::string(named.word) + " takes " + std::string(named.wanted));
}

Result<Number> number_in(const Token& token, bool negative) {
  Result<Number> number = io::parse_number(token.text);
  if (!number) {
    return error_at(token.place, number.error().code, number.error().message);
  }
  if (!is_handy(*number)) {
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
      if (count != 3) return wrong_call(function, place);
      matrix = translation({numbers[0], numbers[1], numbers[2]});
      break;
    case Function::kScale:
      if (count != 1 && count != 3) return wrong_call(function, place);
      matrix = scaling({numbers[0], numbers[count == 1 ? 0 : 1],
                        numbers[count == 1 ? 0 : 2]});
      break;
    case Function::kRotate: {
      if (count != 4) return wrong_call(function, place);
      Result<Matrix> turn = rotation_at(place, numbers);
      if (!turn) return turn.error();
      matrix = *std::move(turn);
      break;
    }
    case Function::kMatrix:
      if (count != 12) return wrong_call(function, place);
      for (std::size_t i = 0; i < 12; ++i)
        matrix.rows[i / 4][i % 4] = numbers[i];
      break;
    case Function::kMirror: {
      if (count != 3) return wrong_call(function, place);
      Result<Matrix> mirrored = mirror_at(place, numbers);
      if (!mirrored) return mirrored.error();
      matrix = *std::move(mirrored);
      break;
    }
    default:
      return wrong_call(function, place);
  }
  if (determinant_sign(matrix) == 0) {
    return error_at(place, ErrorCode::kZeroArea,
                    "this transform makes everything flat");
  }
  return matrix;
}

Result<HalfSpace> half_of(const Place& place,
                          const std::vector<Number>& numbers) {
  if (numbers.size() != 9) return wrong_call(Function::kHalf, place);
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
