#include "halfspace/io/legend.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "picture/legend_layout.hpp"
#include "picture/lettering.hpp"

namespace halfspace::io {
namespace {

constexpr double kLeastLetter = 9;
constexpr double kMostLetter = 60;

std::int32_t rounded_px(double value) {
  return static_cast<std::int32_t>(std::floor(value + 0.5));
}

void fill_box(std::int32_t left, std::int32_t top, std::int32_t right,
              std::int32_t bottom, const Rgb& color, ColorImage& picture) {
  for (std::int32_t j = std::max(0, top);
       j < std::min(bottom, picture.height_px); ++j) {
    for (std::int32_t i = std::max(0, left);
         i < std::min(right, picture.width_px); ++i)
      picture.at(i, j) = color;
  }
}

/// The border, a pixel wide, of a box.
void frame_box(std::int32_t left, std::int32_t top, std::int32_t right,
               std::int32_t bottom, const Rgb& color, ColorImage& picture) {
  fill_box(left, top, right, top + 1, color, picture);
  fill_box(left, bottom - 1, right, bottom, color, picture);
  fill_box(left, top, left + 1, bottom, color, picture);
  fill_box(right - 1, top, right, bottom, color, picture);
}

/// Whether something is seen where the legend will stand.
bool is_over_something(const LegendLayout& at, const ItemImage& items,
                       const ColorImage& picture) {
  const std::int32_t samples = items.height_px / picture.height_px;
  for (std::int32_t j = std::max(0, at.box_top);
       j < std::min(at.box_bottom, picture.height_px); ++j) {
    for (std::int32_t i = std::max(0, at.box_left);
         i < std::min(at.box_right, picture.width_px); ++i) {
      if (items.at(i * samples, j * samples) != kBackground) return true;
    }
  }
  return false;
}

/// The bar, from the least at the bottom to the greatest.
void draw_bar(const Legend& legend, const LegendLayout& at,
              ColorImage& picture) {
  const auto count = static_cast<std::int64_t>(legend.scale.colors.size());
  for (std::int32_t j = 0; j < at.height; ++j) {
    const std::int64_t up = 2 * std::int64_t{at.height - 1 - j} + 1;
    const auto k = static_cast<std::size_t>(up * count / (2 * at.height));
    fill_box(at.left, at.top + j, at.left + at.width, at.top + j + 1,
             legend.scale.colors[k], picture);
  }
}

}  // namespace

Rgb letter_color(const Rgb& background) {
  const int light =
      299 * background.r + 587 * background.g + 114 * background.b;
  return light >= 128'000 ? Rgb{32, 32, 36} : Rgb{236, 236, 232};
}

LegendLayout legend_layout(const Legend& legend, std::int32_t width_px,
                           std::int32_t height_px) {
  const double letter = std::clamp(std::min(height_px / 28.0, width_px / 24.0),
                                   kLeastLetter, kMostLetter);
  const Lettering letters(letter);
  const double bar = 0.56 * height_px;
  LegendLayout at;
  at.letter = letter;
  at.width = rounded_px(1.3 * letter);
  at.height = rounded_px(bar);
  at.marks = scale_marks(legend.range, static_cast<int>(bar / (2.2 * letter)));
  at.tick = std::max(2, rounded_px(0.3 * letter));
  double widest = legend.shows_no_data ? letters.width_of("no data") : 0;
  for (const ScaleMark& mark : at.marks)
    widest = std::max(widest, letters.width_of(mark.text));
  const double right = width_px - 0.9 * letter;
  at.left = rounded_px(right - widest - at.tick - 0.3 * letter - at.width);
  at.top = (height_px - at.height) / 2;
  const double title = letters.width_of(legend.title);
  at.title_x = std::min<double>(at.left, right - title);
  const double pad = 0.6 * letter;
  at.box_left = rounded_px(std::min<double>(at.left, at.title_x) - pad);
  at.box_right = rounded_px(right + pad);
  at.box_top =
      rounded_px(at.top - (legend.title.empty() ? 0.4 : 1.7) * letter - pad);
  at.box_bottom = rounded_px(at.top + at.height +
                             (legend.shows_no_data ? 1.9 : 0.4) * letter + pad);
  at.fits = at.box_left >= 0 && at.box_top >= 0 && at.height >= 3 * letter;
  return at;
}

std::int32_t legend_width(const Legend& legend, std::int32_t width_px,
                          std::int32_t height_px) {
  const LegendLayout at = legend_layout(legend, width_px, height_px);
  return at.fits ? width_px - at.box_left : 0;
}

void draw_legend(const Legend& legend, const ItemImage& items,
                 const Rgb& background, ColorImage& picture) {
  const LegendLayout at =
      legend_layout(legend, picture.width_px, picture.height_px);
  if (!at.fits) return;
  const double letter = at.letter;
  const Lettering letters(letter);
  const Rgb ink = letter_color(background);
  if (is_over_something(at, items, picture)) {
    fill_box(at.box_left, at.box_top, at.box_right, at.box_bottom, background,
             picture);
  }
  draw_bar(legend, at, picture);
  frame_box(at.left - 1, at.top - 1, at.left + at.width + 1,
            at.top + at.height + 1, ink, picture);
  const std::int32_t right = at.left + at.width;
  const double text_x = right + at.tick + 0.3 * letter;
  const std::int32_t thick = std::max(1, rounded_px(letter / 16));
  for (const ScaleMark& mark : at.marks) {
    const double y = at.top + (1 - mark.share) * at.height;
    const std::int32_t top =
        std::clamp(rounded_px(y - thick / 2.0), at.top - 1, at.top + at.height);
    fill_box(right, top, right + at.tick, top + thick, ink, picture);
    letters.write(mark.text, text_x, y + letters.capital_height() / 2, ink,
                  picture);
  }
  letters.write(legend.title, at.title_x, at.top - 0.8 * letter, ink, picture);
  if (!legend.shows_no_data) return;
  const std::int32_t top = rounded_px(at.top + at.height + 0.8 * letter);
  const std::int32_t bottom = top + rounded_px(letter);
  fill_box(at.left, top, right, bottom, legend.scale.no_data, picture);
  frame_box(at.left - 1, top - 1, right + 1, bottom + 1, ink, picture);
  letters.write("no data", text_x,
                (top + bottom + letters.capital_height()) / 2, ink, picture);
}

}  // namespace halfspace::io
