#pragma once

#include <string>
#include <utility>
#include <vector>

namespace halfspace::bench {

/// A line of a chart.
struct Series {
  std::string name;
  std::vector<std::pair<double, double>> points;  ///< x ascending
};

/// A line chart with a legend.
struct Chart {
  std::string title;
  std::string x_label;
  std::string y_label;
  bool logarithmic = false;  ///< both axes; all values are above 0
  std::vector<Series> series;
};

/// The chart as the text of an SVG file.
/// Requires: some series has a point; at most eight series.
std::string to_svg(const Chart& chart);

}  // namespace halfspace::bench
