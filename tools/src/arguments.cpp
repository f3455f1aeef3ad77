#include "arguments.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "halfspace/camera.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::tools {
namespace {

/// The number that the whole of `text` spells.
template <class T>
std::optional<T> parse_whole(std::string_view text) {
  // from_chars knows no plus sign; people do.
  if (text.size() > 1 && text[0] == '+' && text[1] != '-')
    text.remove_prefix(1);
  T value{};
  const char* end = text.data() + text.size();
  const auto [stop, code] = std::from_chars(text.data(), end, value);
  if (code != std::errc() || stop != end) return std::nullopt;
  return value;
}

bool takes_signed_value(std::string_view word) {
  constexpr std::array<std::string_view, 3> kOptions = {"--eye", "--target",
                                                        "--up"};
  return std::find(kOptions.begin(), kOptions.end(), word) != kOptions.end();
}

}  // namespace

std::optional<double> parse_real(std::string_view text) {
  const std::optional<double> value = parse_whole<double>(text);
  if (!value || !std::isfinite(*value)) return std::nullopt;
  return value;
}

std::optional<std::uint64_t> parse_natural(std::string_view text) {
  return parse_whole<std::uint64_t>(text);
}

std::optional<std::uint32_t> parse_count(std::string_view text) {
  const std::optional<std::uint32_t> value = parse_whole<std::uint32_t>(text);
  if (!value || *value < 1 || *value > 1'000'000) return std::nullopt;
  return value;
}

std::optional<int> parse_grid(std::string_view text) {
  const std::optional<int> value = parse_whole<int>(text);
  for (const int bits : kGridBits) {
    if (value == bits) return value;
  }
  return std::nullopt;
}

std::optional<glm::dvec3> parse_vector(std::string_view text) {
  std::array<double, 3> values{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t comma = i < 2 ? text.find(',') : text.size();
    if (comma == std::string_view::npos) return std::nullopt;
    const std::optional<double> value = parse_real(text.substr(0, comma));
    if (!value) return std::nullopt;
    values[i] = *value;
    text.remove_prefix(std::min(comma + 1, text.size()));
  }
  return glm::dvec3(values[0], values[1], values[2]);
}

std::optional<Range> parse_range(std::string_view text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos || text.size() == 1) return std::nullopt;
  Range range;
  const auto take = [](std::string_view word,
                       std::optional<std::int64_t>& value) {
    if (word.empty()) return true;
    value = parse_whole<std::int64_t>(word);
    return value && *value >= 0;
  };
  if (!take(text.substr(0, colon), range.first) ||
      !take(text.substr(colon + 1), range.end)) {
    return std::nullopt;
  }
  const bool is_empty = range.end && *range.end <= range.first.value_or(0);
  if (is_empty) return std::nullopt;
  return range;
}

std::optional<std::uint8_t> parse_byte(std::string_view text) {
  return parse_whole<std::uint8_t>(text);
}

std::optional<NumberedName> NumberedName::parse(std::string_view text) {
  NumberedName name;
  bool has_place = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    std::string& part = has_place ? name.after_ : name.before_;
    if (text[k] != '%') {
      part += text[k];
      continue;
    }
    if (text.substr(k + 1).starts_with('%')) {
      part += text[++k];
      continue;
    }
    const std::size_t end = text.find_first_not_of("0123456789", k + 1);
    if (has_place || end == std::string_view::npos || text[end] != 'd') {
      return std::nullopt;
    }
    const std::string_view width = text.substr(k + 1, end - k - 1);
    // More digits than a number can have are a slip, and blanks in names too.
    if (!width.empty() && (width[0] != '0' || width.size() > 3)) {
      return std::nullopt;
    }
    if (!width.empty()) {
      name.digits_ = parse_whole<std::size_t>(width).value_or(0);
    }
    has_place = true;
    k = end;
  }
  if (!has_place || name.digits_ > 19) return std::nullopt;
  return name;
}

std::string NumberedName::with(std::int64_t number) const {
  std::string digits = std::to_string(number);
  if (digits.size() < digits_) {
    digits.insert(0, digits_ - digits.size(), '0');
  }
  return before_ + digits + after_;
}

std::optional<Size> parse_size(std::string_view text) {
  const std::size_t cross = text.find('x');
  if (cross == std::string_view::npos) return std::nullopt;
  const auto width = parse_whole<std::int32_t>(text.substr(0, cross));
  const auto height = parse_whole<std::int32_t>(text.substr(cross + 1));
  const auto is_good = [](const std::optional<std::int32_t>& length) {
    return length && 1 <= *length && *length <= kMaxImageSize;
  };
  if (!is_good(width) || !is_good(height)) return std::nullopt;
  return Size{*width, *height};
}

std::string spelt_out(const std::string& form) {
  if (form == "WxH") return "WxH, columns and rows from 1 to 65536";
  if (form == "X,Y,Z") return "X,Y,Z, three finite numbers";
  if (form == "SEED") return "a whole number of 64 bits";
  if (form == "K" || form == "N" || form == "S") {
    return "a whole number of at least 1";
  }
  if (form == "A") return "a whole number from 0 to 255";
  if (form == "SHARE") return "a number above 0 and at most 1";
  if (form == "A:B") return "A:B, A: or :B, from A up to but not including B";
  if (form == "DEG" || form == "LENGTH") return "a finite number";
  return form;
}

std::vector<std::string> joined_arguments(int count, const char* const* words) {
  std::vector<std::string> joined;
  for (int i = 1; i < count; ++i) {
    const bool is_value = i > 1 && words[i][0] == '-' && words[i][1] != '-' &&
                          takes_signed_value(words[i - 1]);
    if (is_value) {
      joined.back() += '=' + std::string(words[i]);
    } else {
      joined.emplace_back(words[i]);
    }
  }
  return joined;
}

}  // namespace halfspace::tools
