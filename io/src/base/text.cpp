#include "base/text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

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

std::errc read_double(std::string_view token, double& value) {
#if defined(__cpp_lib_to_chars)
  const char* const end = token.data() + token.size();
  const auto [at, code] = std::from_chars(token.data(), end, value);
  return at == end ? code : std::errc::invalid_argument;
#else
  const bool is_negative = token.starts_with('-');
  const std::string_view word = token.substr(is_negative ? 1 : 0);
  const double sign = is_negative ? -1 : 1;
  if (is_word(word, "nan")) {
    value = std::numeric_limits<double>::quiet_NaN();
    return {};
  }
  if (is_word(word, "inf") || is_word(word, "infinity")) {
    value = sign * std::numeric_limits<double>::infinity();
    return {};
  }
  if (word.starts_with('+') || word.starts_with('-'))
    return std::errc::invalid_argument;
  const Result<Number> number = parse_number(word);
  if (!number) {
    return number.error().code == ErrorCode::kOutOfRange
               ? std::errc::result_out_of_range
               : std::errc::invalid_argument;
  }
  const double read = to_double(*number);
  const bool is_zero =
      word.substr(0, word.find_first_of("eE")).find_first_of("123456789") ==
      std::string_view::npos;
  if (!std::isfinite(read) || (read == 0 && !is_zero))
    return std::errc::result_out_of_range;
  value = sign * read;
  return {};
#endif
}

double value_or_none(std::string_view token) {
  if (token.starts_with('+')) token.remove_prefix(1);
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  double value = 0;
  if (read_double(token, value) != std::errc{}) return kNone;
  return std::isfinite(value) ? value : kNone;
}

namespace {

/// A natural number, in digits of base 10^9, the least first.
using Digits = std::vector<std::uint32_t>;
constexpr std::uint32_t kBase = 1'000'000'000;

void multiply(Digits& digits, std::uint32_t by) {
  std::uint64_t carry = 0;
  for (std::uint32_t& digit : digits) {
    carry += std::uint64_t{digit} * by;
    digit = static_cast<std::uint32_t>(carry % kBase);
    carry /= kBase;
  }
  for (; carry > 0; carry /= kBase)
    digits.push_back(static_cast<std::uint32_t>(carry % kBase));
}

/// Multiplies by base^power, where `step` is base^per_step below 2^32.
void multiply_by_power(Digits& digits, std::uint32_t base, int power,
                       std::uint32_t step, int per_step) {
  for (; power >= per_step; power -= per_step) multiply(digits, step);
  for (; power > 0; --power) multiply(digits, base);
}

std::string text_of(const Digits& digits) {
  std::string text;
  for (auto digit = digits.rbegin(); digit != digits.rend(); ++digit) {
    const std::string part = std::to_string(*digit);
    if (!text.empty()) text.append(9 - part.size(), '0');
    text += part;
  }
  return text;
}

/// Adds 1 to the last digit.
void count_up(std::string& digits) {
  std::size_t at = digits.size();
  while (at > 0 && digits[at - 1] == '9') digits[--at] = '0';
  if (at == 0) {
    digits.insert(digits.begin(), '1');
  } else {
    ++digits[at - 1];
  }
}

/// The same where the digits are an integer of 64 bits, as those of images and
/// models are; nothing where they may be more.
std::optional<std::string> short_fixed_point(std::uint64_t mantissa,
                                             int exponent, int decimals) {
  constexpr int kMost = 19;  // for 10^19 < 2^64
  if (exponent >= 0 || exponent < -116 || decimals > kMost) return std::nullopt;
  __extension__ using Wide = unsigned __int128;
  std::uint64_t power = 1;
  for (int k = 0; k < decimals; ++k) power *= 10;
  // Below 2^(53 + 64).
  const Wide product = Wide{mantissa} * power;
  const Wide unit = Wide{1} << -exponent;
  Wide whole = product / unit;
  const Wide rest = product % unit;
  const Wide half = unit / 2;
  if (rest > half || (rest == half && whole % 2 != 0)) ++whole;
  if (whole >> 64 != 0) return std::nullopt;
  return std::to_string(static_cast<std::uint64_t>(whole));
}

/// Digits with a point before the last `decimals`.
std::string with_point(std::string digits, std::size_t decimals) {
  if (digits.size() <= decimals)
    digits.insert(0, decimals + 1 - digits.size(), '0');
  if (decimals > 0) digits.insert(digits.size() - decimals, 1, '.');
  return digits;
}

/// The digits of mantissa 2^exponent to that many after the point.
std::string long_fixed_point(std::uint64_t mantissa, int exponent,
                             std::size_t decimals) {
  for (; mantissa != 0 && mantissa % 2 == 0; ++exponent) mantissa /= 2;
  Digits number;
  for (; mantissa > 0; mantissa /= kBase)
    number.push_back(static_cast<std::uint32_t>(mantissa % kBase));
  // With k = -exponent > 0 there are k digits after the point, those of
  // mantissa 5^k.
  const int places = number.empty() ? 0 : std::max(0, -exponent);
  multiply_by_power(number, 5, places, 1'220'703'125, 13);
  multiply_by_power(number, 2, number.empty() ? 0 : exponent, 1u << 31, 31);
  std::string digits = text_of(number);
  const auto had = static_cast<std::size_t>(places);
  if (had <= decimals) return digits.append(decimals - had, '0');
  const std::size_t dropped = had - decimals;
  if (digits.size() <= dropped)
    digits.insert(0, dropped + 1 - digits.size(), '0');
  const std::size_t kept = digits.size() - dropped;
  const char next = digits[kept];
  const bool is_half = next == '5' && digits.find_first_not_of('0', kept + 1) ==
                                          std::string::npos;
  const bool is_odd = (digits[kept - 1] - '0') % 2 != 0;
  digits.erase(kept);
  if (is_half ? is_odd : next >= '5') count_up(digits);
  return digits;
}

}  // namespace

std::string fixed_point(double value, int decimals) {
  int exponent = 0;
  const double share = std::frexp(std::abs(value), &exponent);
  const auto mantissa = static_cast<std::uint64_t>(std::ldexp(share, 53));
  const auto after = static_cast<std::size_t>(decimals);
  std::optional<std::string> digits =
      short_fixed_point(mantissa, exponent - 53, decimals);
  if (!digits) digits = long_fixed_point(mantissa, exponent - 53, after);
  return (std::signbit(value) ? "-" : "") + with_point(*digits, after);
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
