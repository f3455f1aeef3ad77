#pragma once

#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace halfspace::tools {

/// The number that the whole of `text` spells, if the type holds it; finite.
template <class T>
std::optional<T> parse_number(std::string_view text) {
  // from_chars knows no plus sign; people do.
  if (text.size() > 1 && text[0] == '+' && text[1] != '-')
    text.remove_prefix(1);
  T value{};
  const char* const end = text.data() + text.size();
  const auto [stop, code] = std::from_chars(text.data(), end, value);
  if (code != std::errc() || stop != end) return std::nullopt;
  if constexpr (std::is_floating_point_v<T>) {
    if (!std::isfinite(value)) return std::nullopt;
  }
  return value;
}

/// Columns and rows. Units: pixels.
struct Size {
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  friend bool operator==(const Size&, const Size&) = default;
};

/// The size that `WxH` spells, if it is two numbers from 1 to 65,536.
std::optional<Size> parse_size(std::string_view text);

/// The vector that `X,Y,Z` spells, if it is three finite numbers.
std::optional<glm::dvec3> parse_vector(std::string_view text);

/// Numbers from `first` up to but not including `end`; nothing: from the first
/// one there is, to the last.
struct Range {
  std::optional<std::int64_t> first;
  std::optional<std::int64_t> end;
};

/// The range that `A:B`, `A:` or `:B` spells, if it is not empty.
std::optional<Range> parse_range(std::string_view text);

/// A file's name with one place for a number: `%d`, or `%05d` for a number of
/// at least 5 digits, zeros in front.
class NumberedName {
 public:
  /// The name that the text describes, if it has exactly one such place, and
  /// other percent signs only in pairs.
  static std::optional<NumberedName> parse(std::string_view text);

  std::string with(std::int64_t number) const;

 private:
  std::string before_;
  std::string after_;
  std::size_t digits_ = 0;
};

/// The words of the command line, a long option and a negative number after it
/// made one: else `--eye -.5,2,3` would be an option called `-.`.
std::vector<std::string> joined_arguments(int count, const char* const* words);

}  // namespace halfspace::tools
