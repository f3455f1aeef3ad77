#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "halfspace/fast/rounded_mesh.hpp"
#include "halfspace/fast/solid.hpp"
#include "halfspace/polygon.hpp"

namespace halfspace::fast {

/// A point in steps of a file grid, off it if need be.
using StepPoint = std::array<double, 3>;

/// The grid on which a mesh is rounded, and the numbers of the file on it.
///
/// A step is a power of two of which those vertices are multiples that doubles
/// hold, as far as 54 bits do; or that to which the others are rounded, if it
/// is less. The file's numbers are multiples of neither.
class FileGrid {
 public:
  /// The grid for coordinates of up to `greatest`, more than 0, in size, of
  /// which those that stay are multiples of 2^exponent.
  /// False: numbers do not reach so far, or are all farther apart.
  bool choose(double greatest, int exponent, FileNumber number);
  /// The grid of all points of a scene's grid of `bits` bits, whose unit is its
  /// step: for a surface that stays there.
  static FileGrid of_bits(int bits);

  /// A coordinate of the file as steps. Exact if it is a multiple of one.
  double steps(double coordinate) const;
  /// Steps as a coordinate of the file.
  /// Exact: of what holds() says.
  double coordinate(std::int64_t steps) const;
  /// Whether the file has numbers for a grid point.
  bool holds(const GridPoint& point) const;
  /// The point rounded to multiples of `width`, a power of two times the grid's
  /// spacing: numbers of the file. Ties to even.
  GridPoint rounded(const StepPoint& at, std::int64_t width) const;
  std::int64_t spacing() const { return spacing_; }
  /// The height, in steps, of a triangle that rounding its corners leaves much
  /// as it was.
  double safe_height() const { return 16 * static_cast<double>(spacing_); }
  /// The largest multiple of the spacing whose multiples still leave 12 binary
  /// digits to a number.
  std::int64_t widest() const;
  /// The length of a step in the file's unit.
  double step() const;

 private:
  bool holds(std::int64_t steps) const;

  int step_exponent_ = 0;
  std::int64_t spacing_ = 1;  ///< in steps; a power of two
  double end_ = 0;            ///< no coordinate is as large as this; in steps
  int digits_ = 0;            ///< of the greatest coordinate, in spacings
  FileNumber number_ = FileNumber::kDouble;
};

inline StepPoint step_point(const GridPoint& p) {
  return {static_cast<double>(p.x), static_cast<double>(p.y),
          static_cast<double>(p.z)};
}

/// The largest difference of coordinates.
double distance(const StepPoint& from, const GridPoint& to);

/// The exponent of the last binary digit of a double that is not 0.
int last_digit(double value);

}  // namespace halfspace::fast
