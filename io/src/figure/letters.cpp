#include "figure/writers.hpp"

namespace halfspace::io {
namespace {

/// Widths of the letters from blank to tilde in thousandths of the size, from
/// the metrics of Helvetica (Adobe Font Metrics, Core 14).
constexpr short kWidths[] = {
    278, 278, 355, 556, 556,  889, 667, 191, 333, 333, 389, 584, 278, 333,
    278, 278, 556, 556, 556,  556, 556, 556, 556, 556, 556, 556, 278, 278,
    584, 584, 584, 556, 1015, 667, 667, 722, 722, 667, 611, 778, 722, 278,
    500, 667, 556, 833, 722,  778, 667, 778, 722, 667, 611, 722, 667, 944,
    667, 667, 611, 278, 278,  278, 469, 556, 333, 556, 556, 500, 556, 556,
    278, 556, 556, 222, 222,  500, 222, 833, 556, 556, 556, 556, 333, 500,
    278, 556, 500, 722, 500,  500, 500, 334, 260, 334, 584};

}  // namespace

double width_of(std::string_view letters) {
  double width = 0;
  for (const char letter : letters) {
    const int index = letter - ' ';
    const bool known =
        index >= 0 && index < static_cast<int>(std::size(kWidths));
    width += known ? kWidths[index] / 1000.0 : 0.556;
  }
  return width;
}

FigurePoint start_of(const FigureText& text) {
  const double before = 0.5 * static_cast<int>(text.anchor);
  return {text.at[0] - before * text.size * width_of(text.text), text.at[1]};
}

}  // namespace halfspace::io
