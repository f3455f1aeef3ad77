#include "papers/chart.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "halfspace/assert.hpp"
#include "papers/table.hpp"

namespace halfspace::bench {
namespace {

constexpr double kLeft = 70, kTop = 40, kWidth = 480, kHeight = 320;
constexpr double kLegendLine = 18;

/// Colours that stay apart for colour-blind eyes, and in grey.
constexpr std::array<const char*, 8> kColors = {"#0072b2", "#d55e00", "#009e73",
                                                "#cc79a7", "#56b4e9", "#e69f00",
                                                "#000000", "#999999"};

/// An axis from `least` to `greatest`, in the chart's own scale.
struct Axis {
  double least = 0;
  double greatest = 1;
  bool logarithmic = false;
  std::vector<double> ticks;

  double share(double value) const {
    const double v = logarithmic ? std::log10(value) : value;
    return (v - least) / (greatest - least);
  }
};

Axis axis_of(double least, double greatest, bool logarithmic) {
  Axis axis;
  axis.logarithmic = logarithmic;
  if (logarithmic) {
    axis.least = std::floor(std::log10(least));
    axis.greatest = std::max(std::ceil(std::log10(greatest)), axis.least + 1);
    for (double power = axis.least; power <= axis.greatest; ++power) {
      axis.ticks.push_back(std::pow(10.0, power));
    }
    return axis;
  }
  // Five to ten steps of 1, 2 or 5 times a power of ten, from 0.
  const double raw = std::max(greatest, 1e-9) / 5;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double lead = raw / power;
  const double step = power * (lead < 2 ? 1 : lead < 5 ? 2 : 5);
  const double count = std::ceil(greatest / step - 1e-9);
  axis.greatest = step * count;
  for (double k = 0; k <= count; ++k) axis.ticks.push_back(k * step);
  return axis;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<') {
      out += "&lt;";
    } else if (c == '&') {
      out += "&amp;";
    } else {
      out += c;
    }
  }
  return out;
}

class Writer {
 public:
  explicit Writer(const Chart& chart) : chart_(chart) {
    double x[2] = {1e300, -1e300}, y[2] = {1e300, -1e300};
    for (const Series& series : chart.series) {
      for (const auto& [px, py] : series.points) {
        x[0] = std::min(x[0], px);
        x[1] = std::max(x[1], px);
        y[0] = std::min(y[0], py);
        y[1] = std::max(y[1], py);
      }
    }
    HALFSPACE_ASSERT(x[0] <= x[1]);
    HALFSPACE_ASSERT(chart.series.size() <= kColors.size());
    x_ = axis_of(x[0], x[1], chart.logarithmic);
    y_ = axis_of(y[0], y[1], chart.logarithmic);
  }

  std::string svg() {
    const double height =
        kTop + kHeight + 60 +
        kLegendLine * static_cast<double>(chart_.series.size());
    add("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" "
        "height=\"%.0f\" font-family=\"sans-serif\" font-size=\"12\">\n",
        kLeft + kWidth + 30, height);
    add("<rect width=\"%.0f\" height=\"%.0f\" fill=\"white\"/>\n",
        kLeft + kWidth + 30, height);
    text(kLeft + kWidth / 2, 22, "middle", chart_.title);
    axes();
    for (std::size_t k = 0; k < chart_.series.size(); ++k) line(k);
    return out_ + "</svg>\n";
  }

 private:
  template <class... Values>
  void add(const char* format, Values... values) {
    char buffer[512];
    std::snprintf(buffer, sizeof buffer, format, values...);
    out_ += buffer;
  }

  void text(double x, double y, const char* anchor, const std::string& words) {
    add("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\">", x, y, anchor);
    out_ += escaped(words) + "</text>\n";
  }

  double x_at(double value) const { return kLeft + kWidth * x_.share(value); }
  double y_at(double value) const {
    return kTop + kHeight * (1 - y_.share(value));
  }

  void axes() {
    constexpr const char* kLine =
        "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" "
        "stroke=\"#ddd\"/>\n";
    for (const double tick : x_.ticks) {
      add(kLine, x_at(tick), kTop, x_at(tick), kTop + kHeight);
      text(x_at(tick), kTop + kHeight + 16, "middle", digits(tick, 2));
    }
    for (const double tick : y_.ticks) {
      add(kLine, kLeft, y_at(tick), kLeft + kWidth, y_at(tick));
      text(kLeft - 6, y_at(tick) + 4, "end", digits(tick, 2));
    }
    text(kLeft + kWidth / 2, kTop + kHeight + 34, "middle", chart_.x_label);
    add("<text transform=\"translate(16 %.1f) rotate(-90)\" "
        "text-anchor=\"middle\">",
        kTop + kHeight / 2);
    out_ += escaped(chart_.y_label) + "</text>\n";
  }

  void line(std::size_t index) {
    const Series& series = chart_.series[index];
    const char* const color = kColors[index];
    add("<polyline fill=\"none\" stroke=\"%s\" stroke-width=\"2\" points=\"",
        color);
    for (const auto& [x, y] : series.points)
      add("%.1f,%.1f ", x_at(x), y_at(y));
    out_ += "\"/>\n";
    for (const auto& [x, y] : series.points) {
      add("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3\" fill=\"%s\"/>\n", x_at(x),
          y_at(y), color);
    }
    const double y =
        kTop + kHeight + 54 + kLegendLine * static_cast<double>(index);
    add("<rect x=\"%.1f\" y=\"%.1f\" width=\"14\" height=\"4\" fill=\"%s\"/>\n",
        kLeft, y - 6, color);
    text(kLeft + 22, y, "start", series.name);
  }

  const Chart& chart_;
  Axis x_, y_;
  std::string out_;
};

}  // namespace

std::string to_svg(const Chart& chart) { return Writer(chart).svg(); }

}  // namespace halfspace::bench
