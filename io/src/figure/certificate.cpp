#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "figure/writers.hpp"
#include "halfspace/int128.hpp"

namespace halfspace::io {
namespace {

/// A coordinate as it is written, in units of its last decimal.
///
/// Exact: the text is the number; a figure of 2^20 units with 9 decimals has
/// integers below 2^51.
Int128 units_of(const std::string& text, int decimals) {
  Int128 value = 0;
  int after = -1;
  for (const char c : text) {
    if (c == '.') {
      after = 0;
    } else if (c != '-') {
      value = 10 * value + (c - '0');
      if (after >= 0) ++after;
    }
  }
  for (int k = after < 0 ? 0 : after; k < decimals; ++k) value *= 10;
  return text.front() == '-' ? -value : value;
}

/// A coordinate in 2^-40 of a unit: what rounding that loses is far below the
/// doubles' own. Areas of such loops have some 122 bits.
Int128 fine_of(double value) {
  return static_cast<Int128>(std::nearbyint(std::ldexp(value, 40)));
}

using Loop = std::vector<std::array<Int128, 2>>;

/// The sign of a loop's area, from its first corner so that numbers are small.
int turn_of(const Loop& loop) {
  Int128 twice = 0;
  for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
    const auto& o = loop[0];
    const auto& p = loop[k];
    const auto& q = loop[k + 1];
    twice += (p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0]);
  }
  return twice > 0 ? 1 : twice < 0 ? -1 : 0;
}

Pen pen_of(std::string_view ending, const Figure& figure,
           const FigureOptions& options) {
  if (ending == ".svg") return {options.decimals, -1, 1};
  return upright_pen(figure, options, 72 / 25.4);
}

}  // namespace

FigureCertificate certify(std::string_view ending, const Figure& figure,
                          const FigureOptions& options) {
  const Pen pen = pen_of(ending, figure, options);
  FigureCertificate result;
  result.bound = 0.5 * std::pow(10.0, -options.decimals);
  for (const FigureRegion& region : figure.regions) {
    for (const auto& loop : region.loops) {
      Loop before;
      Loop after;
      for (const FigurePoint& p : loop) {
        const std::string text = pen.at(p);
        const std::size_t gap = text.find(' ');
        const std::string x = text.substr(0, gap);
        const std::string y = text.substr(gap + 1);
        const double to_x = pen.scale * p[0];
        const double to_y =
            pen.height < 0 ? pen.scale * p[1] : pen.height - pen.scale * p[1];
        result.largest_move =
            std::max({result.largest_move, std::abs(value_or_none(x) - to_x),
                      std::abs(value_or_none(y) - to_y)});
        before.push_back({fine_of(to_x), fine_of(to_y)});
        after.push_back(
            {units_of(x, options.decimals), units_of(y, options.decimals)});
      }
      ++result.loops;
      const int turn = turn_of(after);
      if (turn == 0) {
        ++result.vanished;
      } else if (turn != turn_of(before)) {
        ++result.turned_over;
      }
    }
  }
  return result;
}

std::string certificate_text(std::string_view ending, const Figure& figure,
                             const FigureOptions& options) {
  const FigureCertificate c = certify(ending, figure, options);
  // Rounded up: a move is not more than what stands there.
  const int digits = options.decimals + 3;
  const double unit = std::pow(10.0, -digits);
  return "certificate: coordinates moved by at most " +
         decimal(std::ceil(c.largest_move / unit) * unit, digits) + " of " +
         decimal(c.bound, options.decimals + 1) + "; " +
         std::to_string(c.turned_over) + " of " + std::to_string(c.loops) +
         " loops turned over, " + std::to_string(c.vanished) + " vanished";
}

}  // namespace halfspace::io
