#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "base/text.hpp"
#include "figure/shading.hpp"
#include "figure/writers.hpp"
#include "halfspace/int128.hpp"

namespace halfspace::io {
namespace {

/// Signs are exact for coordinates up to this, sixteen times the widest image.
constexpr double kMostCoordinate = 0x1p20;

Int128 power_of_ten(int exponent) {
  Int128 power = 1;
  for (int k = 0; k < exponent; ++k) power *= 10;
  return power;
}

/// A coordinate as it is written, in units of 10^-12: the text is the number.
Int128 written_units(double value, int decimals) {
  Int128 units = 0;
  int after = -1;
  const std::string text = decimal(value, decimals);
  for (const char c : text) {
    if (c == '.') {
      after = 0;
    } else if (c != '-') {
      units = 10 * units + (c - '0');
      if (after >= 0) ++after;
    }
  }
  units *= power_of_ten(kMostDecimals - std::max(after, 0));
  return text.front() == '-' ? -units : units;
}

/// The sign of the area of a loop of `count` corners, corner(k) being a point
/// of whole numbers, or 0.
///
/// Coordinates up to 2^20 are below 2^61 in units of 10^-12 or 2^-41, so that
/// each difference of products is below 2^126; the sum is kept in two parts.
template <class Corner>
int exact_turn(std::size_t count, const Corner& corner) {
  Int128 high = 0;
  Int128 low = 0;
  constexpr int kHalf = 64;
  const auto o = corner(0);
  auto p = corner(1);
  for (std::size_t k = 2; k < count; ++k) {
    const auto q = corner(k);
    const Int128 twice =
        (p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0]);
    high += twice >> kHalf;
    low += twice & ((Int128{1} << kHalf) - 1);
    p = q;
  }
  high += low >> kHalf;
  low &= (Int128{1} << kHalf) - 1;
  if (high != 0) return high > 0 ? 1 : -1;
  return low != 0 ? 1 : 0;
}

/// Twice the area of a loop in doubles, and how far off that may be if each
/// coordinate is off by `off`.
struct DoubleArea {
  double twice = 0;
  double bound = 0;
  bool is_large = false;  ///< beyond kMostCoordinate

  int sign() const { return twice > bound ? 1 : twice < -bound ? -1 : 0; }
};
template <class Corner>
DoubleArea double_area(std::size_t count, const Corner& corner, double off) {
  // Of each product both factors are differences with an error of 2 off and of
  // one rounding, 2^-53 of coordinates; sums add count roundings of the whole.
  const FigurePoint o = corner(0);
  FigurePoint p = corner(1);
  double most = std::max(std::abs(o[0]), std::abs(o[1]));
  double size = 0;
  double sides = 0;
  DoubleArea area;
  for (std::size_t k = 1; k < count; ++k) {
    const FigurePoint q = corner(k);
    most = std::max({most, std::abs(q[0]), std::abs(q[1])});
    const double x = (p[0] - o[0]) * (q[1] - o[1]);
    const double y = (p[1] - o[1]) * (q[0] - o[0]);
    area.twice += x - y;
    size += std::abs(x) + std::abs(y);
    sides += std::abs(q[0] - o[0]) + std::abs(q[1] - o[1]);
    p = q;
  }
  const double each = 2 * off + 0x1p-52 * most;
  const auto n = static_cast<double>(count);
  area.bound = 4 * (sides * each + n * each * each) + n * 0x1p-51 * size;
  area.is_large = !(most <= kMostCoordinate);
  return area;
}

using FigureLoop = std::vector<FigurePoint>;

/// The way round of a loop as it is, or 0; where doubles cannot tell, of its
/// corners in whole numbers of 2^-41, which are finer than 12 decimals.
int turn_before(const FigureLoop& loop, const Pen& pen) {
  const auto at = [&](std::size_t k) { return pen.placed(loop[k]); };
  const DoubleArea area = double_area(loop.size(), at, 0);
  if (area.sign() != 0 || area.is_large) return area.sign();
  return exact_turn(loop.size(), [&](std::size_t k) {
    const FigurePoint p = at(k);
    const auto fine = [](double value) {
      return static_cast<Int128>(std::nearbyint(std::ldexp(value, 41)));
    };
    return std::array<Int128, 2>{fine(p[0]), fine(p[1])};
  });
}

/// The way round of a loop as a pen writes it, or 0.
int turn_after(const FigureLoop& loop, const Pen& pen) {
  const auto at = [&](std::size_t k) { return pen.placed(loop[k]); };
  const double off = 0.5 * std::pow(10.0, -pen.decimals);
  const DoubleArea area = double_area(loop.size(), at, off);
  if (area.sign() != 0 || area.is_large) return area.sign();
  return exact_turn(loop.size(), [&](std::size_t k) {
    const FigurePoint p = at(k);
    const int decimals =
        pen.fine ? pen.fine->decimals_at(loop[k], pen.decimals) : pen.decimals;
    return std::array<Int128, 2>{written_units(p[0], decimals),
                                 written_units(p[1], decimals)};
  });
}

bool turns_over(const FigureLoop& loop, const Pen& pen) {
  const int turn = turn_after(loop, pen);
  return turn != 0 && turn != turn_before(loop, pen);
}

Pen pen_of(std::string_view ending, const Figure& figure,
           const FigureOptions& options) {
  if (ending == ".svg") return {options.decimals, -1, 1, nullptr};
  return upright_pen(figure, options, 72 / 25.4);
}

template <class Visit>
void for_loops(const Figure& figure, const Visit& visit) {
  for (const FigureRegion& region : figure.regions) {
    for (const FigureLoop& loop : region.loops) {
      if (loop.size() > 2) visit(loop);
    }
  }
}

}  // namespace

/// A loop that turns over gets one decimal more at each of its corners, which
/// may turn over others that share them, until none is left.
Pen fitted(Pen pen, const Figure& figure) {
  const auto fine = std::make_shared<FinePoints>();
  pen.fine = fine;
  for (bool again = true; again;) {
    again = false;
    for_loops(figure, [&](const FigureLoop& loop) {
      if (fine->left_out.count(&loop) > 0 || !turns_over(loop, pen)) return;
      bool is_finer = false;
      for (const FigurePoint& p : loop) {
        int& decimals =
            fine->decimals.try_emplace(p, pen.decimals).first->second;
        if (decimals >= kMostDecimals) continue;
        ++decimals;
        is_finer = true;
      }
      if (!is_finer) fine->left_out.insert(&loop);
      again = true;
    });
  }
  if (fine->decimals.empty()) pen.fine = nullptr;
  return pen;
}

FigureCertificate certificate_of(const Figure& figure, const Pen& pen) {
  FigureCertificate result;
  result.bound = 0.5 * std::pow(10.0, -pen.decimals);
  result.most_decimals = pen.decimals;
  if (pen.fine) {
    result.finer_points = pen.fine->decimals.size();
    for (const auto& [point, decimals] : pen.fine->decimals)
      result.most_decimals = std::max(result.most_decimals, decimals);
  }
  for (const FigureRegion& region : figure.regions)
    result.loops += region.loops.size();
  for_loops(figure, [&](const FigureLoop& loop) {
    for (const FigurePoint& p : loop) {
      const FigurePoint to = pen.placed(p);
      const int decimals =
          pen.fine ? pen.fine->decimals_at(p, pen.decimals) : pen.decimals;
      for (const double value : to) {
        result.largest_move =
            std::max(result.largest_move,
                     std::abs(value_or_none(decimal(value, decimals)) - value));
      }
    }
    const bool left_out = pen.fine && pen.fine->left_out.count(&loop) > 0;
    const int turn = turn_after(loop, pen);
    if (turn == 0 || left_out) {
      ++result.vanished;
    } else if (turn != turn_before(loop, pen)) {
      ++result.turned_over;
    }
  });
  return result;
}

FigureCertificate certify(std::string_view ending, const Figure& figure,
                          const FigureOptions& options) {
  if (ending == ".eps" || ending == ".tex") {
    const Figure flat = in_flat_parts(figure, options.levels);
    return certificate_of(flat, fitted(pen_of(ending, flat, options), flat));
  }
  return certificate_of(figure,
                        fitted(pen_of(ending, figure, options), figure));
}

std::string certificate_text(const Figure& figure, const Pen& pen) {
  const FigureCertificate c = certificate_of(figure, pen);
  // Rounded up: a move is not more than what stands there.
  const int digits = pen.decimals + 3;
  const double unit = std::pow(10.0, -digits);
  return "certificate: coordinates moved by at most " +
         decimal(std::ceil(c.largest_move / unit) * unit, digits) + " of " +
         decimal(c.bound, pen.decimals + 1) + "; " +
         std::to_string(c.turned_over) + " of " + std::to_string(c.loops) +
         " loops turned over, " + std::to_string(c.vanished) + " vanished, " +
         std::to_string(c.finer_points) + " points with more decimals";
}

}  // namespace halfspace::io
