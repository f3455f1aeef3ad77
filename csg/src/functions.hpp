#pragma once

#include <optional>
#include <vector>

#include "halfspace/csg/lexer.hpp"
#include "halfspace/csg/script.hpp"

namespace halfspace::csg {

/// Which function of a script it is.
enum class Function : std::uint8_t {
  kTranslate,
  kScale,
  kRotate,
  kMatrix,
  kMirror,
  kHalf,
  kFlip,
  kUnion,
  kIntersection,
  kDifference,
  kSymmetricDifference,
  kBox,
  kSphere,
  kCylinder,
  kCone,
  kTorus,
  kHull,
  kRange,
  kLength,
  kSin,
  kCos,
  kTan,
  kSqrt,
  kAbs,
  kFloor,
  kMin,
  kMax,
};

/// The function that the word names.
std::optional<Function> function_named(std::string_view word);

/// The error of a call of a function that there is not, with the word that may
/// be meant.
Error no_function(const Token& name);

/// The error of a call with other values than the function takes.
Error wrong_call(Function function, const Place& place);

/// The token's number, of at most this number of characters.
/// Errors: kOutOfRange.
Result<io::Number> number_in(const Token& token, bool negative);

/// The transform of `function`, called at `place` with these numbers.
///
/// Requires: it is one of kTranslate to kMirror.
/// Errors:   kSyntax (not so many numbers as it takes); kZeroArea (it flattens
///           everything, or turns about no axis); kOutOfRange (an angle or an
///           axis beyond doubles).
Result<Matrix> transform_of(Function function, const Place& place,
                            const std::vector<io::Number>& numbers);

/// The half-space of `half`, called at `place` with the coordinates of three
/// points.
/// Errors: kSyntax (not nine numbers); kZeroArea (they are on one line).
Result<HalfSpace> half_of(const Place& place,
                          const std::vector<io::Number>& numbers);

/// The primitive of `function`, called at `place` with these numbers.
///
/// Requires: it is one of kBox to kHull.
/// Errors:   kSyntax (not as many numbers as it takes, or not such a number);
///           those of hull_of().
Result<io::Mesh> primitive_of(Function function, const Place& place,
                              const std::vector<io::Number>& numbers);

/// The half-space in which a coordinate is less than `value`, or greater.
HalfSpace axis_half(std::size_t axis, bool less, const io::Number& value);

}  // namespace halfspace::csg
