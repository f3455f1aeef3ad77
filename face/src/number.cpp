#include "number.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

namespace halfspace::detail {
namespace {

/// The shortest decimal from which the double reads back.
class Shortest {
 public:
  explicit Shortest(double value) {
    const auto end = std::to_chars(text_.data(), text_.data() + text_.size(),
                                   value, std::chars_format::scientific);
    size_ = static_cast<std::size_t>(end.ptr - text_.data());
  }
  std::string_view text() const { return {text_.data(), size_}; }
  int digits() const {
    const auto mantissa = text().substr(0, text().find('e'));
    return static_cast<int>(
        std::count_if(mantissa.begin(), mantissa.end(),
                      [](char c) { return c >= '0' && c <= '9'; }));
  }

 private:
  std::array<char, 32> text_{};
  std::size_t size_ = 0;
};

constexpr int kShortDigits = 12;

}  // namespace

bool is_short_decimal(double value) {
  return Shortest(value).digits() <= kShortDigits;
}

io::Number number_of(double value) {
  // Small integers, most of what is typed, need no text.
  if (std::abs(value) < 1e15 && std::floor(value) == value)
    return io::number_of(value);
  const Shortest shortest(value);
  if (shortest.digits() > kShortDigits) return io::number_of(value);
  return *io::parse_number(shortest.text());
}

csg::Numbers3 numbers_of(const Point& point) {
  return {number_of(point.x), number_of(point.y), number_of(point.z)};
}

bool is_finite(const Point& point) {
  return std::isfinite(point.x) && std::isfinite(point.y) &&
         std::isfinite(point.z);
}

ExactPoints exact_points(std::span<const Point> points) {
  ExactPoints result;
  result.decimal =
      std::all_of(points.begin(), points.end(), [](const Point& p) {
        return is_short_decimal(p.x) && is_short_decimal(p.y) &&
               is_short_decimal(p.z);
      });
  result.points.reserve(points.size());
  for (const Point& p : points) {
    result.points.push_back(result.decimal ? numbers_of(p)
                                           : csg::Numbers3{io::number_of(p.x),
                                                           io::number_of(p.y),
                                                           io::number_of(p.z)});
  }
  return result;
}

}  // namespace halfspace::detail
