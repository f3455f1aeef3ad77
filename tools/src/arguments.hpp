#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace halfspace::tools {

/// Columns and rows. Units: pixels.
struct Size {
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  friend bool operator==(const Size&, const Size&) = default;
};

/// The vector that `X,Y,Z` spells, if it is three finite numbers.
std::optional<glm::dvec3> parse_vector(std::string_view text);

/// The size that `WxH` spells, if it is two numbers from 1 to 65,536.
std::optional<Size> parse_size(std::string_view text);

/// The finite number that `text` spells.
std::optional<double> parse_real(std::string_view text);

/// The number from 0 to 2^64 - 1 that `text` spells.
std::optional<std::uint64_t> parse_natural(std::string_view text);

/// The number from 1 to 1,000,000 that `text` spells.
std::optional<std::uint32_t> parse_count(std::string_view text);

/// The grid, 26, 40 or 54, that `text` spells.
std::optional<int> parse_grid(std::string_view text);

/// Numbers from `first` up to but not including `end`; nothing: from the first
/// one there is, to the last.
struct Range {
  std::optional<std::int64_t> first;
  std::optional<std::int64_t> end;
};

/// The range that `A:B`, `A:` or `:B` spells, if it is not empty.
std::optional<Range> parse_range(std::string_view text);

/// The number from 0 to 255 that `text` spells.
std::optional<std::uint8_t> parse_byte(std::string_view text);

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

/// What a text of this form is, for people: "a whole number of at least 1".
std::string spelt_out(const std::string& form);

/// The words of the command line, an option and a value that begins with a
/// minus sign made one: else `--eye -.5,2,3` would be an option called `-.`.
std::vector<std::string> joined_arguments(int count, const char* const* words);

}  // namespace halfspace::tools
