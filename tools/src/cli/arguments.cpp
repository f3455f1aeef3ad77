#include "cli/arguments.hpp"

#include <algorithm>
#include <array>

#include "halfspace/camera.hpp"

namespace halfspace::tools {

std::optional<glm::dvec3> parse_vector(std::string_view text) {
  std::array<double, 3> values{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t comma = i < 2 ? text.find(',') : text.size();
    if (comma == std::string_view::npos) return std::nullopt;
    const auto value = parse_number<double>(text.substr(0, comma));
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
    value = parse_number<std::int64_t>(word);
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
      name.digits_ = parse_number<std::size_t>(width).value_or(0);
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
  const auto width = parse_number<std::int32_t>(text.substr(0, cross));
  const auto height = parse_number<std::int32_t>(text.substr(cross + 1));
  const auto is_good = [](const std::optional<std::int32_t>& length) {
    return length && 1 <= *length && *length <= kMaxImageSize;
  };
  if (!is_good(width) || !is_good(height)) return std::nullopt;
  return Size{*width, *height};
}

std::vector<std::string> joined_arguments(int count, const char* const* words) {
  constexpr std::string_view kNumberBegins = "0123456789.";
  std::vector<std::string> joined;
  for (int i = 1; i < count; ++i) {
    const std::string_view word = words[i];
    const bool is_negative = word.size() > 1 && word[0] == '-' &&
                             kNumberBegins.find(word[1]) != word.npos;
    if (is_negative && i > 1 && joined.back().starts_with("--") &&
        joined.back().find('=') == std::string::npos) {
      joined.back() += "=" + std::string(word);
    } else {
      joined.emplace_back(word);
    }
  }
  return joined;
}

}  // namespace halfspace::tools
