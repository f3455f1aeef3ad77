#include "map/arc_pieces.hpp"

#include <algorithm>
#include <cmath>

namespace halfspace::fast {
namespace {

/// To multiples of 2^-44, so that up to 2^8 of them add up exactly, and what an
/// arc gives to a row is the same in all that it is part of.
double on_lattice(double value) {
  constexpr double kSteps = 0x1p44;
  return std::nearbyint(value * kSteps) / kSteps;
}

/// An arc that goes down.
struct Run {
  double x0, y0, x1, y1;
  std::int32_t gains, loses;

  /// Requires: y0 <= y <= y1, and y0 < y1.
  double x_at(double y) const {
    const double x = x0 + (y - y0) / (y1 - y0) * (x1 - x0);
    return std::clamp(x, std::min(x0, x1), std::max(x0, x1));
  }
};

/// Cuts the part of an arc in a row along columns: pieces without height too,
/// so that every pixel that an arc passes is known. The part goes from (xa, ya)
/// to (xb, yb), heights from the row's top.
template <class Add>
void cut_row(const Run& run, double xa, double ya, double xb, double yb,
             std::int32_t width, const Add& add) {
  const bool leftwards = xb < xa;
  const auto column_of = [&](double x) {
    const double c = leftwards ? std::ceil(x) - 1 : std::floor(x);
    return static_cast<std::int32_t>(
        std::clamp(c, 0.0, static_cast<double>(width - 1)));
  };
  const std::int32_t last = column_of(leftwards ? std::max(xb, 0.0) : xb);
  double x = xa;
  double y = ya;
  for (std::int32_t column = column_of(xa);; column += leftwards ? -1 : 1) {
    const double border = leftwards ? column : column + 1;
    const bool ends = leftwards ? xb >= border : xb <= border;
    const double to_x = ends || column == last ? xb : border;
    double to_y = yb;
    if (to_x != xb) {
      to_y = on_lattice(ya + (border - xa) / (xb - xa) * (yb - ya));
      to_y = std::clamp(to_y, y, std::max(y, yb));
    }
    // With p and q the distances of its ends to the pixel's right side: the
    // integrals of q, (1 - (1-q)^2) / 2 and y q over y.
    const double p = column + 1 - x;
    const double q = column + 1 - to_x;
    const double dy = to_y - y;
    ArcPiece piece;
    piece.column = column;
    piece.gains = run.gains;
    piece.loses = run.loses;
    piece.rise = dy;
    piece.rise_y = dy * (y + to_y) / 2;
    piece.area = dy * (p + q) / 2;
    piece.area_x = piece.area - dy * (p * p + p * q + q * q) / 6;
    piece.area_y = dy * (y * (2 * p + q) + to_y * (p + 2 * q)) / 6;
    add(piece);
    if (to_x == xb) return;
    x = to_x;
    y = to_y;
  }
}

}  // namespace

ArcPieces cut_along_pixels(const VisibleMap& map, std::int32_t width,
                           std::int32_t height) {
  std::vector<std::vector<ArcPiece>> rows(static_cast<std::size_t>(height));
  for (const MapArc& arc : map.arcs) {
    const MapVertex& from = map.vertices[static_cast<std::size_t>(arc.from)];
    const MapVertex& to = map.vertices[static_cast<std::size_t>(arc.to)];
    // The side of greater x is the left one of an arc that goes down (S7.4).
    const bool down = from.y <= to.y;
    const Run run = down ? Run{from.x, from.y, to.x, to.y, arc.left, arc.right}
                         : Run{to.x, to.y, from.x, from.y, arc.right, arc.left};
    const auto row_of = [height](double y) {
      return std::clamp(static_cast<std::int32_t>(y), 0, height - 1);
    };
    const std::int32_t top = row_of(std::floor(run.y0));
    const std::int32_t bottom = std::max(top, row_of(std::ceil(run.y1) - 1));
    for (std::int32_t row = top; row <= bottom; ++row) {
      const double ya = std::max(run.y0 - row, 0.0);
      const double yb = std::min(run.y1 - row, 1.0);
      auto& pieces = rows[static_cast<std::size_t>(row)];
      const double xa = row == top ? run.x0 : run.x_at(row);
      const double xb = row == bottom ? run.x1 : run.x_at(row + 1);
      cut_row(run, xa, on_lattice(ya), xb, on_lattice(yb), width,
              [&](const ArcPiece& piece) { pieces.push_back(piece); });
    }
  }
  ArcPieces result;
  for (auto& pieces : rows) {
    std::stable_sort(pieces.begin(), pieces.end(),
                     [](const ArcPiece& f, const ArcPiece& g) {
                       return f.column < g.column;
                     });
    result.first.push_back(result.pieces.size());
    result.pieces.insert(result.pieces.end(), pieces.begin(), pieces.end());
    std::size_t first = 0;
    for (std::size_t k = 1; k <= pieces.size(); ++k) {
      if (k < pieces.size() && pieces[k].column == pieces[first].column)
        continue;
      result.most = std::max(result.most, k - first);
      first = k;
    }
  }
  result.first.push_back(result.pieces.size());
  return result;
}

}  // namespace halfspace::fast
