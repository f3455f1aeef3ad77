#include "halfspace/io/figure_legend.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "picture/legend_layout.hpp"
#include "picture/lettering.hpp"

namespace halfspace::io {
namespace {

FigureRegion box(double left, double top, double right, double bottom,
                 const Rgb& fill) {
  FigureRegion region;
  region.loops = {{{left, top}, {right, top}, {right, bottom}, {left, bottom}}};
  region.fill = fill;
  region.class_of = "legend";
  return region;
}

/// Leaves of the figure's regions what is outside of a box.
void clear_box(double left, double top, double right, double bottom,
               Figure& figure) {
  for (FigureRegion& region : figure.regions) {
    auto within = cut_loops(region.loops, {-1, 0, left}, true);
    within = cut_loops(within, {1, 0, -right}, true);
    auto covered = cut_loops(within, {0, -1, top}, true);
    covered = cut_loops(covered, {0, 1, -bottom}, true);
    if (covered.empty()) continue;
    std::vector<std::vector<FigurePoint>> rest;
    const auto keep = [&rest](std::vector<std::vector<FigurePoint>> loops) {
      for (auto& loop : loops) rest.push_back(std::move(loop));
    };
    keep(cut_loops(region.loops, {-1, 0, left}, false));
    keep(cut_loops(region.loops, {1, 0, -right}, false));
    keep(cut_loops(within, {0, -1, top}, false));
    keep(cut_loops(within, {0, 1, -bottom}, false));
    region.loops = std::move(rest);
  }
}

void add_frame(double left, double top, double right, double bottom,
               std::vector<FigureStroke>& strokes) {
  strokes.push_back({{left, top}, {right, top}, {}});
  strokes.push_back({{right, top}, {right, bottom}, {}});
  strokes.push_back({{right, bottom}, {left, bottom}, {}});
  strokes.push_back({{left, bottom}, {left, top}, {}});
}

}  // namespace

bool add_legend(const Legend& legend, const Rgb& background, Figure& figure) {
  const auto px = [](double length) {
    return static_cast<std::int32_t>(std::floor(length));
  };
  const LegendLayout at =
      legend_layout(legend, px(figure.width), px(figure.height));
  if (!at.fits) return false;
  const Rgb ink = letter_color(background);
  const double right = at.left + at.width;
  const double bottom = at.top + at.height;
  const double second_top = bottom + 0.8 * at.letter;
  const double second_bottom = second_top + at.letter;
  clear_box(at.left, at.top, right, bottom, figure);
  if (legend.shows_no_data)
    clear_box(at.left, second_top, right, second_bottom, figure);
  // One box a colour: those that are equal are one.
  const std::vector<Rgb>& colors = legend.scale.colors;
  const auto count = static_cast<double>(colors.size());
  for (std::size_t k = 0; k < colors.size();) {
    std::size_t end = k + 1;
    while (end < colors.size() && colors[end] == colors[k]) ++end;
    const auto y = [&](std::size_t band) {
      return bottom - at.height * (static_cast<double>(band) / count);
    };
    figure.regions.push_back(box(at.left, y(end), right, y(k), colors[k]));
    k = end;
  }
  FigureStrokes lines;
  lines.name = "legend";
  lines.color = ink;
  lines.width = std::max(0.5, at.letter / 16);
  add_frame(at.left, at.top, right, bottom, lines.strokes);
  const double text_x = right + at.tick + 0.3 * at.letter;
  const double half_capital = Lettering(at.letter).capital_height() / 2;
  const auto write = [&](const std::string& text, double x, double y) {
    FigureText line;
    line.at = {x, y};
    line.text = text;
    line.size = at.letter;
    line.color = ink;
    line.class_of = "legend";
    figure.texts.push_back(std::move(line));
  };
  for (const ScaleMark& mark : at.marks) {
    const double y = at.top + (1 - mark.share) * at.height;
    lines.strokes.push_back({{right, y}, {right + at.tick, y}, {}});
    write(mark.text, text_x, y + half_capital);
  }
  if (!legend.title.empty())
    write(legend.title, at.title_x, at.top - 0.8 * at.letter);
  if (legend.shows_no_data) {
    figure.regions.push_back(
        box(at.left, second_top, right, second_bottom, legend.scale.no_data));
    add_frame(at.left, second_top, right, second_bottom, lines.strokes);
    write("no data", text_x, (second_top + second_bottom) / 2 + half_capital);
  }
  figure.strokes.push_back(std::move(lines));
  return true;
}

}  // namespace halfspace::io
