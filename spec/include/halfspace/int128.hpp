#pragma once

#include <string>
#include <string_view>

namespace halfspace {

/// A signed integer of 128 bits: holds every camera component (at most 68
/// bits, S4.1).
__extension__ typedef __int128 Int128;

/// Decimal text of `value`.
std::string to_string(Int128 value);

/// Reads an optional sign and decimal digits, nothing else.
/// Returns false where that is not what `text` is or it needs over 127 bits.
bool parse_int128(std::string_view text, Int128& value);

}  // namespace halfspace
