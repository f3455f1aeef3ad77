#include "figure/shading.hpp"
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

/// The paths of a figure's regions, and the gradients that they name.
class RegionPaths {
 public:
  RegionPaths(const Pen& pen, double levels) : pen_(pen), levels_(levels) {
    // A gradient may be steep: its line has decimals to spare.
    fine_ = pen;
    fine_.decimals = pen.decimals + 3;
  }

  std::string of(const FigureRegion& region) {
    if (!region.shade) return path(region, hex_of(region.fill));
    const auto parts = shade_parts(region, levels_, true);
    if (parts.size() == 1) return path(region, paint(parts[0]));
    std::string text;
    for (const ShadePart& part : parts) {
      FigureRegion plain;
      plain.loops = part.loops;
      text += path(plain, paint(part));
    }
    if (text.empty()) return {};
    return "<g" + names(region) + ">" + title(region) + "\n" + text + "</g>\n";
  }
  const std::string& gradients() const { return gradients_; }

 private:
  static std::string names(const FigureRegion& region) {
    std::string text;
    if (!region.id.empty()) text += " id=\"" + escaped(region.id) + "\"";
    if (!region.class_of.empty())
      text += " class=\"" + escaped(region.class_of) + "\"";
    return text;
  }
  static std::string title(const FigureRegion& region) {
    return region.title.empty()
               ? ""
               : "<title>" + escaped(region.title) + "</title>";
  }

  std::string path(const FigureRegion& region, const std::string& color) const {
    const auto loops = loops_of(region, pen_);
    if (loops.empty()) return {};
    const std::string text = "<path" + names(region) + " fill=\"" + color +
                             "\" stroke=\"" + color + "\" d=\"" +
                             path_of(loops, "Z");
    return text + (region.title.empty() ? "\"/>\n"
                                        : "\">" + title(region) + "</path>\n");
  }

  /// The word for a part's colour.
  std::string paint(const ShadePart& part) {
    if (!part.has_gradient) return hex_of(part.fill);
    const std::string name = "shade-" + std::to_string(++count_);
    const auto& [from, to] = part.line;
    gradients_ +=
        "<linearGradient id=\"" + name +
        "\" gradientUnits=\"userSpaceOnUse\" x1=\"" + fine_.length(from[0]) +
        "\" y1=\"" + fine_.length(from[1]) + "\" x2=\"" + fine_.length(to[0]) +
        "\" y2=\"" + fine_.length(to[1]) + "\"><stop stop-color=\"" +
        hex_of(part.ends[0]) + "\"/><stop offset=\"1\" stop-color=\"" +
        hex_of(part.ends[1]) + "\"/></linearGradient>\n";
    return "url(#" + name + ")";
  }

  Pen pen_;
  Pen fine_;
  double levels_;
  int count_ = 0;
  std::string gradients_;
};

std::string text_of(const FigureText& text, const Pen& pen) {
  constexpr std::string_view kAnchors[] = {"start", "middle", "end"};
  std::string result = "<text x=\"" + pen.length(text.at[0]) + "\" y=\"" +
                       pen.length(text.at[1]) +
                       "\" font-family=\"Helvetica,Arial,sans-serif\" "
                       "font-size=\"" +
                       decimal(text.size, 3) + "\" text-anchor=\"" +
                       std::string(kAnchors[static_cast<int>(text.anchor)]) +
                       "\" fill=\"" + hex_of(text.color) + "\"";
  if (!text.class_of.empty())
    result += " class=\"" + escaped(text.class_of) + "\"";
  return result + ">" + escaped(text.text) + "</text>\n";
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
  const Pen pen = fitted({options.decimals, -1, 1, nullptr}, figure);
  const bool on_paper = figure.unit_mm > 0;
  const auto size = [&](double length) {
    return on_paper ? decimal(length * figure.unit_mm, 3) + "mm"
                    : decimal(length, 3);
  };
  std::string text = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" +
                     size(figure.width) + "\" height=\"" + size(figure.height) +
                     "\" viewBox=\"0 0 " + decimal(figure.width, 3) + " " +
                     decimal(figure.height, 3) + "\">\n";
  if (!figure.regions.empty())
    text += "<!-- " + certificate_text(figure, pen) + " -->\n";
  if (!figure.regions.empty()) {
    RegionPaths paths(pen, options.levels);
    std::string groups;
    for (const bool background : {true, false}) {
      groups += std::string("<g id=\"") +
                (background ? "background" : "regions") +
                "\" fill-rule=\"evenodd\" stroke-linejoin=\"round\">\n";
      for (const FigureRegion& region : figure.regions) {
        if (region.is_background == background) groups += paths.of(region);
      }
      groups += "</g>\n";
    }
    text += "<defs>\n" + paths.gradients() + groups + "</defs>\n";
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
  for (const FigureText& line : figure.texts) text += text_of(line, pen);
  return text + "</svg>\n";
}

}  // namespace halfspace::io
