#include <algorithm>
#include <cmath>

#include "figure/writers.hpp"

namespace halfspace::io {
namespace {

/// A pixel on paper.
constexpr double kPixelMm = 25.4 / 96;

std::string layer_of(const FigureStrokes& strokes, std::size_t k) {
  return strokes.name.empty() ? "strokes" + std::to_string(k) : strokes.name;
}

/// A group of DXF: its code and its value, a line each.
std::string group(int code, const std::string& value) {
  return std::to_string(code) + "\n" + value + "\n";
}

std::string dxf_tables(const Figure& figure) {
  const auto table = [](const std::string& name, std::size_t count) {
    return group(0, "TABLE") + group(2, name) +
           group(70, std::to_string(count));
  };
  std::string text = group(0, "SECTION") + group(2, "TABLES");
  text += table("LTYPE", 2) + group(0, "LTYPE") + group(2, "CONTINUOUS") +
          group(70, "0") + group(3, "Solid line") + group(72, "65") +
          group(73, "0") + group(40, "0.0");
  text += group(0, "LTYPE") + group(2, "HIDDEN") + group(70, "0") +
          group(3, "Hidden line") + group(72, "65") + group(73, "2") +
          group(40, "3.0") + group(49, "2.0") + group(49, "-1.0") +
          group(0, "ENDTAB");
  text += table("LAYER", figure.strokes.size());
  for (std::size_t k = 0; k < figure.strokes.size(); ++k) {
    const FigureStrokes& strokes = figure.strokes[k];
    text += group(0, "LAYER") + group(2, layer_of(strokes, k)) +
            group(70, "0") +
            group(62, std::to_string(7 - std::min<std::size_t>(k, 6))) +
            group(6, strokes.dashes.empty() ? "CONTINUOUS" : "HIDDEN");
  }
  return text + group(0, "ENDTAB") + group(0, "ENDSEC");
}

}  // namespace

/// DXF of release 12, in millimetres: a LINE for each stroke, on the layer of
/// its kind.
std::string dxf_of(const Figure& figure, const FigureOptions& options) {
  const double scale = figure.unit_mm > 0 ? figure.unit_mm : kPixelMm;
  const Pen pen = {options.decimals, scale * figure.height, scale, nullptr};
  const auto point = [](const std::string& text, int code) {
    const std::size_t gap = text.find(' ');
    return group(code, text.substr(0, gap)) +
           group(code + 10, text.substr(gap + 1)) + group(code + 20, "0");
  };
  std::string text =
      group(0, "SECTION") + group(2, "HEADER") + group(9, "$ACADVER") +
      group(1, "AC1009") + group(9, "$EXTMIN") + point("0 0", 10) +
      group(9, "$EXTMAX") + point(pen.at({figure.width, 0}), 10) +
      group(0, "ENDSEC") + dxf_tables(figure) + group(0, "SECTION") +
      group(2, "ENTITIES");
  for (std::size_t k = 0; k < figure.strokes.size(); ++k) {
    for (const FigureStroke& stroke : figure.strokes[k].strokes) {
      const std::string from = pen.at(stroke.from);
      const std::string to = pen.at(stroke.to);
      if (from == to) continue;
      text += group(0, "LINE") + group(8, layer_of(figure.strokes[k], k)) +
              point(from, 10) + point(to, 11);
    }
  }
  for (const FigureText& line : figure.texts) {
    const std::string size = decimal(0.7 * scale * line.size, options.decimals);
    text += group(0, "TEXT") + group(8, "texts") +
            point(pen.at(start_of(line)), 10) + group(40, size) +
            group(1, line.text);
  }
  return text + group(0, "ENDSEC") + group(0, "EOF");
}

/// HPGL, 40 units a millimetre: a pen for each kind of strokes, line type 2
/// where it is dashed.
std::string hpgl_of(const Figure& figure, const FigureOptions&) {
  constexpr double kUnitsPerMm = 40;
  const double scale =
      kUnitsPerMm * (figure.unit_mm > 0 ? figure.unit_mm : kPixelMm);
  const Pen pen = {0, std::round(scale * figure.height), scale, nullptr};
  const auto with_comma = [](std::string point) {
    std::replace(point.begin(), point.end(), ' ', ',');
    return point;
  };
  std::string text = "IN;\n";
  for (std::size_t k = 0; k < figure.strokes.size(); ++k) {
    const FigureStrokes& strokes = figure.strokes[k];
    text += "SP" + std::to_string(k + 1) + ";" +
            (strokes.dashes.empty() ? "LT;\n" : "LT2,1;\n");
    for (const auto& chain : chains_of(strokes, pen)) {
      text += "PU" + with_comma(chain[0]) + ";PD";
      for (std::size_t c = 1; c < chain.size(); ++c)
        text += (c == 1 ? "" : ",") + with_comma(chain[c]);
      text += ";\n";
    }
  }
  // The size of letters is in centimetres; a text ends with the byte 3.
  for (const FigureText& line : figure.texts) {
    const double height = 0.07 * line.size * scale / kUnitsPerMm;
    text += "PU" + with_comma(pen.at(start_of(line))) + ";SI" +
            decimal(0.6 * height, 3) + "," + decimal(height, 3) + ";LB" +
            line.text + "\x03;\n";
  }
  return text + "PU;SP0;\n";
}

}  // namespace halfspace::io
