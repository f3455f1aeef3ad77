#include <charconv>

#include "base/text.hpp"
#include "halfspace/io/color_map.hpp"
#include "halfspace/io/file.hpp"

namespace halfspace::io {
namespace {

constexpr std::size_t kMostMapColors = 4096;

Result<Rgb> hex_color(const TextReader& text, std::string_view digits) {
  std::uint32_t value = 0;
  const auto [end, code] = std::from_chars(
      digits.data() + 1, digits.data() + digits.size(), value, 16);
  if (digits.size() != 7 || code != std::errc() ||
      end != digits.data() + digits.size()) {
    return text.error(
        ErrorCode::kSyntax,
        "a colour is #rrggbb or three numbers, not " + in_quotes(digits));
  }
  return Rgb{static_cast<std::uint8_t>(value >> 16),
             static_cast<std::uint8_t>(value >> 8),
             static_cast<std::uint8_t>(value)};
}

Result<Rgb> color_of_line(const TextReader& text,
                          std::span<const std::string_view> tokens) {
  if (tokens.size() == 1) return hex_color(text, tokens[0]);
  if (tokens.size() != 3) {
    return text.error(ErrorCode::kSyntax,
                      "a colour is #rrggbb or three numbers, not " +
                          std::to_string(tokens.size()) + " words");
  }
  std::uint8_t channels[3] = {};
  for (std::size_t k = 0; k < 3; ++k) {
    const Result<std::int64_t> value = parse_integer(tokens[k]);
    if (!value) return text.error(value.error().code, value.error().message);
    if (*value < 0 || *value > 255) {
      return text.error(ErrorCode::kOutOfRange,
                        in_quotes(tokens[k]) + " is not from 0 to 255");
    }
    channels[k] = static_cast<std::uint8_t>(*value);
  }
  return Rgb{channels[0], channels[1], channels[2]};
}

Result<ColorMap> parse_color_map(std::string_view bytes) {
  if (const auto error = not_plain_text(bytes)) return *error;
  TextReader text(bytes, {});
  ColorMap map;
  while (text.next_line()) {
    const auto tokens = text.left();
    const bool is_comment = tokens[0] == "#";
    if (!is_comment) {
      if (map.size() == kMostMapColors) {
        return text.error(ErrorCode::kOutOfRange,
                          "a colour map has at most 4096 colours");
      }
      const Result<Rgb> color = color_of_line(text, tokens);
      if (!color) return color.error();
      map.push_back(*color);
    }
    text.skip_line();
  }
  if (map.size() < 2) {
    return Error{ErrorCode::kOutOfRange,
                 "a colour map has at least 2 colours, not " +
                     std::to_string(map.size())};
  }
  return map;
}

}  // namespace

Result<ColorMap> read_color_map(const std::filesystem::path& path) {
  const Result<std::string> bytes = read_file(path);
  if (!bytes) return bytes.error();
  Result<ColorMap> map = parse_color_map(*bytes);
  if (map) return map;
  Error error = map.error();
  error.message = path.string() + ": " + error.message;
  return error;
}

}  // namespace halfspace::io
