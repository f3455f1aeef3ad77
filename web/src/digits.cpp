// Digits after the point, in place of libc++'s own: its tables for them do not
// pack, and were a sixteenth of the module. Its shortest digits stay.
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>

#include "base/text.hpp"

namespace {

/// The text from `first` on, or that there is no room for it.
std::to_chars_result copied(const std::string& text, char* first, char* last) {
  if (last - first < static_cast<std::ptrdiff_t>(text.size()))
    return {last, std::errc::value_too_large};
  std::memcpy(first, text.data(), text.size());
  return {first + text.size(), std::errc{}};
}

}  // namespace

// What std::to_chars() calls for "%.*f" of a number without its sign.
std::to_chars_result fixed_digits(
    char* first, char* last, double value,
    std::uint32_t precision) __asm__("_ZNSt3__220__d2fixed_buffered_nEPcS0_dj");
std::to_chars_result fixed_digits(char* first, char* last, double value,
                                  std::uint32_t precision) {
  return copied(halfspace::io::fixed_point(value, static_cast<int>(precision)),
                first, last);
}

// The same for "%.*e".
std::to_chars_result power_digits(
    char* first, char* last, double value,
    std::uint32_t precision) __asm__("_ZNSt3__218__d2exp_buffered_nEPcS0_dj");
std::to_chars_result power_digits(char* first, char* last, double value,
                                  std::uint32_t precision) {
  // A double has 767 digits at most; nobody here asks for more.
  char text[800];
  const int size = std::snprintf(text, sizeof text, "%.*e",
                                 static_cast<int>(precision), value);
  if (size >= static_cast<int>(sizeof text))
    return {last, std::errc::value_too_large};
  return copied({text, static_cast<std::size_t>(size)}, first, last);
}

// What else stands in that file of the library, for its shortest floats.
void some_digits(std::uint32_t count, std::uint32_t digits,
                 char* to) __asm__("_ZNSt3__217__append_n_digitsEjjPc");
void some_digits(std::uint32_t count, std::uint32_t digits, char* to) {
  for (std::uint32_t k = count; k > 0; --k, digits /= 10)
    to[k - 1] = static_cast<char>('0' + digits % 10);
}
void nine_digits(std::uint32_t digits,
                 char* to) __asm__("_ZNSt3__220__append_nine_digitsEjPc");
void nine_digits(std::uint32_t digits, char* to) { some_digits(9, digits, to); }
