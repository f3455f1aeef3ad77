#include "base/text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "halfspace/io/number.hpp"

namespace halfspace::io {

bool is_word(std::string_view token, std::string_view lower) {
  return std::equal(token.begin(), token.end(), lower.begin(), lower.end(),
                    [](char a, char b) {
                      return a == b || (a >= 'A' && a <= 'Z' &&
                                        static_cast<char>(a - 'A' + 'a') == b);
                    });
}

std::optional<Error> not_plain_text(std::string_view bytes) {
  if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff") ||
      bytes.starts_with(std::string_view("\0\0\xfe\xff", 4))) {
    return Error{ErrorCode::kUnknownFormat,
                 "the text is in UTF-16 or UTF-32, which is not read; save it "
                 "as UTF-8",
                 0};
  }
  const std::size_t zero = bytes.find('\0');
  if (zero == std::string_view::npos) return std::nullopt;
  return Error{ErrorCode::kSyntax,
               "byte " + std::to_string(zero) +
                   " is zero, so this is not text (perhaps UTF-16)",
               static_cast<std::int64_t>(zero)};
}

Result<std::int64_t> parse_integer(std::string_view token) {
  std::string_view digits = token;
  if (digits.starts_with('+') && !digits.starts_with("+-")) {
    digits.remove_prefix(1);
  }
  std::int64_t value = 0;
  const auto [end, code] =
      std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (code == std::errc::result_out_of_range) {
    return Error{ErrorCode::kOutOfRange, in_quotes(token) + " is too large"};
  }
  if (code != std::errc{} || end != digits.data() + digits.size()) {
    return Error{ErrorCode::kSyntax, in_quotes(token) + " is not an integer"};
  }
  return value;
}

double value_or_none(std::string_view token) {
  if (token.starts_with('+')) token.remove_prefix(1);
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  double value = 0;
#if defined(__cpp_lib_to_chars)
  const char* const end = token.data() + token.size();
  const auto [at, code] = std::from_chars(token.data(), end, value);
  if (code != std::errc{} || at != end) return kNone;
#else
  // Not every library has that for doubles.
  const Result<Number> number = parse_number(token);
  if (!number) return kNone;
  value = to_double(*number);
#endif
  return std::isfinite(value) ? value : kNone;
}

std::string joined(std::span<const std::string_view> tokens) {
  std::string text;
  for (const std::string_view token : tokens) {
    if (!text.empty()) text += ' ';
    text += token;
  }
  return text;
}

TextReader::TextReader(std::string_view text, Rules rules)
    : rest_(text), rules_(rules) {
  constexpr std::string_view kUtf8Mark = "\xef\xbb\xbf";
  if (rest_.starts_with(kUtf8Mark)) rest_.remove_prefix(kUtf8Mark.size());
}

/// Adds the tokens of a line; says whether the line goes on.
bool TextReader::take_tokens(std::string_view line) {
  if (rules_.comments) line = line.substr(0, line.find('#'));
  constexpr std::string_view kBlank = " \t\r\v\f";
  const std::size_t last = line.find_last_not_of(kBlank);
  const bool goes_on =
      rules_.continued && last != std::string_view::npos && line[last] == '\\';
  if (goes_on) line = line.substr(0, last);
  const auto is_blank = [](char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
  };
  const char* at = line.data();
  const char* const end = at + line.size();
  while (true) {
    while (at != end && is_blank(*at)) ++at;
    if (at == end) return goes_on;
    const char* const first = at;
    while (at != end && !is_blank(*at)) ++at;
    tokens_.emplace_back(first, static_cast<std::size_t>(at - first));
  }
}

bool TextReader::next_line() {
  tokens_.clear();
  used_ = 0;
  bool goes_on = false;
  while (tokens_.empty() || goes_on) {
    if (rest_.empty()) break;
    if (tokens_.empty()) line_ = next_number_;
    ++next_number_;
    const std::size_t feed = rest_.find('\n');
    is_cut_ = feed == std::string_view::npos;
    const std::string_view line = rest_.substr(0, feed);
    rest_.remove_prefix(is_cut_ ? rest_.size() : feed + 1);
    goes_on = take_tokens(line);
  }
  if (tokens_.empty()) line_ = next_number_;
  return !tokens_.empty();
}

bool TextReader::next(std::string_view& token) {
  if (used_ == tokens_.size() && !next_line()) return false;
  token = tokens_[used_++];
  return true;
}

Error TextReader::error(ErrorCode code, const std::string& what) const {
  const bool cut = is_cut_ && code == ErrorCode::kSyntax;
  return {cut ? ErrorCode::kTruncated : code,
          "line " + std::to_string(line_) + ": " + what +
              (cut ? ", and the file ends there" : ""),
          line_};
}

}  // namespace halfspace::io
