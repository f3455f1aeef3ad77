#include "figure/writers.hpp"

namespace halfspace::io {
namespace {

std::string hex_of(Rgb color) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text = "#";
  for (const std::uint8_t channel : {color.r, color.g, color.b}) {
    text += kDigits[channel >> 4];
    text += kDigits[channel & 15];
  }
  return text;
}

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '&') {
      result += "&amp;";
    } else if (c == '<') {
      result += "&lt;";
    } else if (c == '"') {
      result += "&quot;";
    } else {
      result += c;
    }
  }
  return result;
}

std::string path_of(const std::vector<std::vector<std::string>>& runs,
                    const char* end) {
  std::string text;
  for (const auto& run : runs) {
    text += "M" + run[0];
    for (std::size_t k = 1; k < run.size(); ++k)
      text += (k == 1 ? "L" : " ") + run[k];
    text += end;
  }
  return text;
}

std::string region_of(const FigureRegion& region, const Pen& pen) {
  const auto loops = loops_of(region, pen);
  if (loops.empty()) return {};
  const std::string color = hex_of(region.fill);
  std::string text = "<path";
  if (!region.id.empty()) text += " id=\"" + escaped(region.id) + "\"";
  text += " fill=\"" + color + "\" stroke=\"" + color + "\" d=\"" +
          path_of(loops, "Z");
  return text + (region.title.empty() ? "\"/>\n"
                                      : "\"><title>" + escaped(region.title) +
                                            "</title></path>\n");
}

/// Strokes with titles are a path each, the others one path in all.
std::string strokes_of(const FigureStrokes& strokes, const Pen& pen) {
  std::string text = "<g";
  if (!strokes.name.empty()) {
    const std::string name = escaped(strokes.name);
    text += " id=\"" + name + "\" class=\"" + name + "\"";
  }
  text += " fill=\"none\" stroke=\"" + hex_of(strokes.color) +
          "\" stroke-width=\"" + decimal(strokes.width, 3) +
          "\" stroke-linecap=\"round\" stroke-linejoin=\"round\"";
  if (!strokes.dashes.empty()) {
    text += " stroke-dasharray=\"";
    for (std::size_t k = 0; k < strokes.dashes.size(); ++k)
      text += (k == 0 ? "" : " ") + decimal(strokes.dashes[k], 3);
    text += "\"";
  }
  text += ">\n";
  FigureStrokes plain;
  for (const FigureStroke& stroke : strokes.strokes) {
    if (stroke.title.empty()) {
      plain.strokes.push_back(stroke);
      continue;
    }
    text += "<path d=\"M" + pen.at(stroke.from) + "L" + pen.at(stroke.to) +
            "\"><title>" + escaped(stroke.title) + "</title></path>\n";
  }
  if (!plain.strokes.empty())
    text += "<path d=\"" + path_of(chains_of(plain, pen), "") + "\"/>\n";
  return text + "</g>\n";
}

}  // namespace

std::string svg_of(const Figure& figure, const FigureOptions& options) {
  const Pen pen = {options.decimals, -1, 1};
  const bool on_paper = figure.unit_mm > 0;
  const auto size = [&](double length) {
    return on_paper ? decimal(length * figure.unit_mm, 3) + "mm"
                    : decimal(length, 3);
  };
  std::string text = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" +
                     size(figure.width) + "\" height=\"" + size(figure.height) +
                     "\" viewBox=\"0 0 " + decimal(figure.width, 3) + " " +
                     decimal(figure.height, 3) + "\">\n";
  if (!figure.regions.empty()) {
    text += "<defs>\n";
    for (const bool background : {true, false}) {
      text += std::string("<g id=\"") +
              (background ? "background" : "regions") +
              "\" fill-rule=\"evenodd\" stroke-linejoin=\"round\">\n";
      for (const FigureRegion& region : figure.regions) {
        if (region.is_background == background) text += region_of(region, pen);
      }
      text += "</g>\n";
    }
    text += "</defs>\n";
    const std::string width = decimal(on_paper ? 0.25 / figure.unit_mm : 1, 3);
    const auto use = [&text](const char* group, const std::string& stroke) {
      text += std::string("<use href=\"#") + group + "\" stroke-width=\"" +
              stroke + "\"/>\n";
    };
    use("background", width);
    use("regions", width);
    use("regions", "0");
    use("background", "0");
  }
  for (const FigureStrokes& strokes : figure.strokes)
    text += strokes_of(strokes, pen);
  return text + "</svg>\n";
}

}  // namespace halfspace::io
