#include "figure/writers.hpp"

namespace halfspace::io {
namespace {

/// Letters as TeX prints them.
std::string tex_letters(const std::string& letters) {
  std::string text;
  for (const char letter : letters) {
    switch (letter) {
      case '\\':
        text += "\\textbackslash{}";
        break;
      case '^':
      case '~':
        text += std::string("\\") + letter + "{}";
        break;
      case '#':
      case '$':
      case '%':
      case '&':
      case '_':
      case '{':
      case '}':
        text += std::string("\\") + letter;
        break;
      default:
        text += letter;
    }
  }
  return text;
}

}  // namespace

/// PGF's basic layer: big points, as in PDF.
std::string tex_of(const Figure& shaded, const FigureOptions& options) {
  const Figure figure = in_flat_parts(shaded, options.levels);
  const Pen pen = fitted(upright_pen(figure, options, 72 / 25.4), figure);
  const auto point = [](const std::string& text) {
    const std::size_t gap = text.find(' ');
    return "\\pgfpoint{" + text.substr(0, gap) + "bp}{" + text.substr(gap + 1) +
           "bp}";
  };
  const auto color = [](const char* what, Rgb rgb) {
    std::string text = std::string("\\definecolor{h}{RGB}{");
    text += std::to_string(rgb.r) + "," + std::to_string(rgb.g) + "," +
            std::to_string(rgb.b) + "}" + what + "\n";
    return text;
  };
  std::string text =
      "% \\usepackage{pgf}\n" +
      (figure.regions.empty() ? std::string()
                              : "% " + certificate_text(figure, pen) + "\n") +
      "\\begin{pgfpicture}\n\\pgfpathrectangle"
      "{\\pgfpointorigin}{\\pgfpoint{" +
      pen.length(figure.width) + "bp}{" + pen.length(figure.height) +
      "bp}}\n\\pgfusepath{use as bounding box}\n\\pgfseteorule"
      "\\pgfsetroundjoin\\pgfsetroundcap\\pgfsetlinewidth{1bp}\n";
  for (const bool with_strokes : {true, false}) {
    for (const FigureRegion* region : drawn_regions(figure, with_strokes)) {
      const auto loops = loops_of(*region, pen);
      if (loops.empty()) continue;
      text += color("\\pgfsetcolor{h}", region->fill);
      for (const auto& loop : loops) {
        text += "\\pgfpathmoveto{" + point(loop[0]) + "}\n";
        for (std::size_t k = 1; k < loop.size(); ++k)
          text += "\\pgfpathlineto{" + point(loop[k]) + "}\n";
        text += "\\pgfpathclose\n";
      }
      text +=
          with_strokes ? "\\pgfusepath{fill,stroke}\n" : "\\pgfusepath{fill}\n";
    }
  }
  for (const FigureStrokes& strokes : figure.strokes) {
    std::string dashes;
    for (const double dash : strokes.dashes)
      dashes += "{" + decimal(pen.scale * dash, 3) + "bp}";
    text += color("\\pgfsetstrokecolor{h}", strokes.color) +
            "\\pgfsetlinewidth{" + decimal(pen.scale * strokes.width, 3) +
            "bp}\\pgfsetdash{" + dashes + "}{0pt}\n";
    for (const auto& chain : chains_of(strokes, pen)) {
      text += "\\pgfpathmoveto{" + point(chain[0]) + "}";
      for (std::size_t k = 1; k < chain.size(); ++k)
        text += "\\pgfpathlineto{" + point(chain[k]) + "}\n";
      text += "\\pgfusepath{stroke}\n";
    }
  }
  constexpr std::string_view kAnchors[] = {"left", "center", "right"};
  for (const FigureText& line : figure.texts) {
    const std::string at = pen.at(line.at);
    const std::size_t gap = at.find(' ');
    text += color("\\pgfsetcolor{h}", line.color) + "\\pgftext[base," +
            std::string(kAnchors[static_cast<int>(line.anchor)]) +
            ",x=" + at.substr(0, gap) + "bp,y=" + at.substr(gap + 1) + "bp]{" +
            "\\fontsize{" + decimal(pen.scale * line.size, 3) +
            "bp}{0pt}\\selectfont " + tex_letters(line.text) + "}\n";
  }
  return text + "\\end{pgfpicture}\n";
}

}  // namespace halfspace::io
