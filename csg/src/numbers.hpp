#pragma once

#include <cstdint>
#include <optional>

#include "halfspace/io/number.hpp"

namespace halfspace::csg {

io::Number negative(io::Number number);

/// Whether a is less than b. Exact: yes.
bool is_less(const io::Number& a, const io::Number& b);

/// a / b, exactly where that is a decimal, else the double next to it; nothing
/// where b is 0 or doubles do not reach it.
std::optional<io::Number> quotient(const io::Number& a, const io::Number& b);

/// Take an angle in degrees. Exact where the absolute value is 0, 1/2 or 1,
/// else within a few units in the last place of a double.
io::Number sine(const io::Number& degrees);
io::Number cosine(const io::Number& degrees);

/// The double next to the root, exact where that is a double. Nothing for a
/// negative number and beyond doubles.
std::optional<io::Number> square_root(const io::Number& number);

/// The greatest integer that is not above the number. Exact: yes.
io::Number floor_of(const io::Number& number);

/// The number, if it is an integer from `least` to `most`.
std::optional<std::int64_t> whole_in(const io::Number& number,
                                     std::int64_t least, std::int64_t most);

}  // namespace halfspace::csg
