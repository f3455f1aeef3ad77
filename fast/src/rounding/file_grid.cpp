#include "rounding/file_grid.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace halfspace::fast {
namespace {

struct NumberRange {
  int digits;        ///< binary ones, of what is rounded
  int low_exponent;  ///< that of the least positive number
  int end_exponent;  ///< 2 to this is beyond all of them
};

/// Doubles could have 53 digits. With 48 a grid of 54 bits that holds the file
/// has room for what is up to 32 times as large: the file's solid goes on as it
/// is beside others, turned ones too, and need not be rounded again.
constexpr int kDoubleDigits = 48;
/// Multiples of the widest spacing have at least so many digits.
constexpr int kFewestDigits = 12;

NumberRange range_of(FileNumber number) {
  return number == FileNumber::kFloat ? NumberRange{24, -149, 128}
                                      : NumberRange{kDoubleDigits, -1074, 1024};
}

}  // namespace

bool FileGrid::choose(double greatest, int exponent, FileNumber number) {
  number_ = number;
  const NumberRange range = range_of(number);
  if (!(greatest > 0) || !std::isfinite(greatest)) return false;
  int end = 0;
  std::frexp(greatest, &end);  // greatest < 2^end
  if (end > range.end_exponent || end <= range.low_exponent) return false;
  const int spacing = std::max(end - range.digits, range.low_exponent);
  // 54 bits hold steps of 2^(end - 53).
  step_exponent_ =
      std::max({std::min(spacing, exponent), end - 53, range.low_exponent});
  spacing_ = std::int64_t{1} << (spacing - step_exponent_);
  end_ = std::ldexp(1.0, end - step_exponent_);
  digits_ = range.digits;
  return true;
}

std::int64_t FileGrid::widest() const {
  return std::int64_t{1} << (digits_ - kFewestDigits);
}

FileGrid FileGrid::of_bits(int bits) {
  FileGrid grid;
  grid.end_ = std::ldexp(1.0, bits - 1);
  grid.digits_ = bits - 1;
  return grid;
}

double FileGrid::steps(double coordinate) const {
  return std::ldexp(coordinate, -step_exponent_);
}

double FileGrid::coordinate(std::int64_t steps) const {
  return std::ldexp(static_cast<double>(steps), step_exponent_);
}

double FileGrid::step() const { return std::ldexp(1.0, step_exponent_); }

bool FileGrid::holds(std::int64_t steps) const {
  // Doubles have all grid points: coordinates of solids have no more bits.
  if (number_ == FileNumber::kDouble) return true;
  const auto value = static_cast<double>(steps);
  return double{static_cast<float>(value)} == value;
}

bool FileGrid::holds(const GridPoint& point) const {
  return holds(point.x) && holds(point.y) && holds(point.z);
}

GridPoint FileGrid::rounded(const StepPoint& at, std::int64_t width) const {
  const auto round = [this, width](double value) {
    const auto spacing = static_cast<double>(width);
    double result = std::nearbyint(value / spacing) * spacing;
    // At the power of two itself the numbers' range may end.
    if (std::abs(result) >= end_) result -= std::copysign(spacing, result);
    return static_cast<std::int64_t>(result);
  };
  return {round(at[0]), round(at[1]), round(at[2])};
}

int last_digit(double value) {
  int exponent = 0;
  const auto digits =
      static_cast<std::int64_t>(std::ldexp(std::frexp(value, &exponent), 53));
  return exponent - 53 +
         std::countr_zero(static_cast<std::uint64_t>(std::abs(digits)));
}

double distance(const StepPoint& from, const GridPoint& to) {
  return std::max({std::abs(static_cast<double>(to.x) - from[0]),
                   std::abs(static_cast<double>(to.y) - from[1]),
                   std::abs(static_cast<double>(to.z) - from[2])});
}

}  // namespace halfspace::fast
