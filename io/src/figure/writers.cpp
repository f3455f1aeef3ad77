#include "figure/writers.hpp"

#include <algorithm>

#include "base/text.hpp"

namespace halfspace::io {

std::string decimal(double value, int decimals) {
  std::string number = fixed_point(value, decimals);
  if (number.find('.') != std::string::npos) {
    number.erase(number.find_last_not_of('0') + 1);
    if (number.back() == '.') number.pop_back();
  }
  return number == "-0" ? "0" : number;
}

std::string Pen::at(const FigurePoint& p) const {
  const int digits = fine ? fine->decimals_at(p, decimals) : decimals;
  const FigurePoint to = placed(p);
  return decimal(to[0], digits) + " " + decimal(to[1], digits);
}

std::vector<std::vector<std::string>> loops_of(const FigureRegion& region,
                                               const Pen& pen) {
  std::vector<std::vector<std::string>> loops;
  for (const auto& loop : region.loops) {
    if (pen.fine && pen.fine->left_out.count(&loop) > 0) continue;
    std::vector<std::string> points;
    for (const FigurePoint& p : loop) {
      std::string text = pen.at(p);
      if (points.empty() || points.back() != text)
        points.push_back(std::move(text));
    }
    while (points.size() > 1 && points.front() == points.back())
      points.pop_back();
    if (points.size() > 2) loops.push_back(std::move(points));
  }
  return loops;
}

std::vector<const FigureRegion*> drawn_regions(const Figure& figure,
                                               bool with_strokes) {
  std::vector<const FigureRegion*> regions;
  for (const FigureRegion& region : figure.regions) regions.push_back(&region);
  std::stable_partition(regions.begin(), regions.end(),
                        [with_strokes](const FigureRegion* region) {
                          return region->is_background == with_strokes;
                        });
  return regions;
}

std::vector<std::vector<std::string>> chains_of(const FigureStrokes& strokes,
                                                const Pen& pen) {
  std::vector<std::vector<std::string>> chains;
  for (const FigureStroke& stroke : strokes.strokes) {
    std::string from = pen.at(stroke.from);
    std::string to = pen.at(stroke.to);
    if (from == to) continue;
    if (chains.empty() || chains.back().back() != from)
      chains.push_back({std::move(from)});
    chains.back().push_back(std::move(to));
  }
  return chains;
}

}  // namespace halfspace::io
