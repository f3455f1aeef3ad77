#pragma once

#include <array>
#include <optional>

#include "halfspace/io/number.hpp"

namespace halfspace::csg {

/// Three exact numbers.
using Numbers3 = std::array<io::Number, 3>;

/// An affine map, exactly: it takes (x, y, z, 1) to its rows' products with
/// that.
struct Matrix {
  std::array<std::array<io::Number, 4>, 3> rows;
  friend bool operator==(const Matrix&, const Matrix&) = default;
};

/// Whether one number, or matrix, comes before another in an order that means
/// nothing but is the same everywhere.
bool comes_before(const io::Number& a, const io::Number& b);
bool comes_before(const Matrix& a, const Matrix& b);

/// Exact: yes.
io::Number sum(const io::Number& a, const io::Number& b);
io::Number product(const io::Number& a, const io::Number& b);

Matrix identity_matrix();
Matrix translation(const Numbers3& by);
Matrix scaling(const Numbers3& by);

/// The turn by an angle about the axis through the origin, counterclockwise as
/// seen from where the axis points.
///
/// Requires: the axis is not zero. Units: degrees.
/// Exact:    quarter turns about a coordinate axis; else the entries are
///           doubles, those next to the true ones or nearly so.
Matrix rotation(const Numbers3& axis, const io::Number& degrees);

/// The map that does first `inner` and then `outer`; nothing where a number of
/// it has too many digits: over 4096 bits, or exponents beyond 2600.
std::optional<Matrix> product(const Matrix& outer, const Matrix& inner);

/// Whether the number has no more digits than that.
bool is_handy(const io::Number& number);

/// -1, 0, 1: whether the map turns solids inside out, flattens them, or does
/// neither.
int determinant_sign(const Matrix& matrix);

/// Where the map takes a point.
Numbers3 image_of(const Matrix& matrix, const Numbers3& point);

}  // namespace halfspace::csg
