#include "halfspace/int128.hpp"

#include <algorithm>

namespace halfspace {

std::string to_string(Int128 value) {
  if (value == 0) return "0";
  const bool negative = value < 0;
  std::string digits;
  while (value != 0) {
    // The remainder has the sign of the value, so the least value works too.
    const int digit = static_cast<int>(value % 10);
    digits.push_back(static_cast<char>('0' + (digit < 0 ? -digit : digit)));
    value /= 10;
  }
  if (negative) digits.push_back('-');
  std::reverse(digits.begin(), digits.end());
  return digits;
}

bool parse_int128(std::string_view text, Int128& value) {
  const bool negative = !text.empty() && text.front() == '-';
  if (!text.empty() && (text.front() == '-' || text.front() == '+')) {
    text.remove_prefix(1);
  }
  if (text.empty()) return false;
  constexpr Int128 kMax = ~(Int128{1} << 127);
  Int128 magnitude = 0;
  for (const char c : text) {
    if (c < '0' || c > '9') return false;
    const Int128 digit = c - '0';
    if (magnitude > (kMax - digit) / 10) return false;
    magnitude = 10 * magnitude + digit;
  }
  value = negative ? -magnitude : magnitude;
  return true;
}

}  // namespace halfspace
