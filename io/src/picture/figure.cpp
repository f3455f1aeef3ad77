#include "halfspace/io/figure.hpp"

#include <zlib.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <span>

#include "halfspace/io/file.hpp"

namespace halfspace::io {
namespace {

/// The shortest text of a number with at most this number of decimals.
std::string decimal(double value, int decimals) {
  char text[64];
  const auto end = std::to_chars(text, text + sizeof text, value,
                                 std::chars_format::fixed, decimals);
  std::string number(text, end.ptr);
  if (number.find('.') != std::string::npos) {
    number.erase(number.find_last_not_of('0') + 1);
    if (number.back() == '.') number.pop_back();
  }
  return number == "-0" ? "0" : number;
}

/// A point with its digits after rounding: what is the same text is one point.
struct Pen {
  int decimals;
  double height;  ///< y is measured from there upwards; negative: downwards

  std::string at(const FigurePoint& p) const {
    return decimal(p[0], decimals) + " " +
           decimal(height < 0 ? p[1] : height - p[1], decimals);
  }
};

/// The loops of a region as texts of points. Points that fall together by
/// rounding are one, and what has fewer than three left is no loop any more.
std::vector<std::vector<std::string>> loops_of(const FigureRegion& region,
                                               const Pen& pen) {
  std::vector<std::vector<std::string>> loops;
  for (const auto& loop : region.loops) {
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

std::string hex_of(Rgb color) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text = "#";
  for (const std::uint8_t channel : {color.r, color.g, color.b}) {
    text += kDigits[channel >> 4];
    text += kDigits[channel & 15];
  }
  return text;
}

std::string rgb_of(Rgb color) {
  std::string text;
  for (const std::uint8_t channel : {color.r, color.g, color.b})
    text += (text.empty() ? "" : " ") + decimal(channel / 255.0, 4);
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

std::string size_of(const Figure& figure) {
  return std::to_string(figure.width) + " " + std::to_string(figure.height);
}

std::string svg_of(const Figure& figure, const FigureOptions& options) {
  const Pen pen = {options.decimals, -1};
  std::string text = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" +
                     std::to_string(figure.width) + "\" height=\"" +
                     std::to_string(figure.height) + "\" viewBox=\"0 0 " +
                     size_of(figure) +
                     "\">\n<defs>\n<g id=\"regions\" fill-rule=\"evenodd\" "
                     "stroke-linejoin=\"round\">\n";
  for (const FigureRegion& region : figure.regions) {
    const auto loops = loops_of(region, pen);
    if (loops.empty()) continue;
    const std::string color = hex_of(region.fill);
    text += "<path";
    if (!region.id.empty()) text += " id=\"" + escaped(region.id) + "\"";
    text += " fill=\"" + color + "\" stroke=\"" + color + "\" d=\"";
    for (const auto& loop : loops) {
      text += "M" + loop[0];
      for (std::size_t k = 1; k < loop.size(); ++k)
        text += (k == 1 ? "L" : " ") + loop[k];
      text += "Z";
    }
    text += region.title.empty()
                ? "\"/>\n"
                : "\"><title>" + escaped(region.title) + "</title></path>\n";
  }
  text +=
      "</g>\n</defs>\n<use href=\"#regions\" stroke-width=\"1\"/>\n"
      "<use href=\"#regions\" stroke-width=\"0\"/>\n";
  for (const FigureStrokes& strokes : figure.strokes) {
    text += "<path fill=\"none\" stroke=\"" + hex_of(strokes.color) +
            "\" stroke-width=\"" + decimal(strokes.width, 3) +
            "\" stroke-linecap=\"round\" d=\"";
    for (const auto& segment : strokes.segments)
      text += "M" + pen.at(segment[0]) + "L" + pen.at(segment[1]);
    text += "\"/>\n";
  }
  return text + "</svg>\n";
}

/// The words of a language that draws paths.
struct Words {
  std::string_view move, line, close, fill, fill_and_stroke;
};

/// The regions twice, first with strokes, and the strokes, as PDF and EPS have
/// them: operands first.
std::string operators_of(const Figure& figure, const FigureOptions& options,
                         const Words& words, bool is_pdf) {
  const Pen pen = {options.decimals, static_cast<double>(figure.height)};
  std::string text =
      is_pdf ? "1 j 1 J 1 w\n" : "1 setlinejoin 1 setlinecap 1 setlinewidth\n";
  for (const bool with_strokes : {true, false}) {
    for (const FigureRegion& region : figure.regions) {
      const auto loops = loops_of(region, pen);
      if (loops.empty()) continue;
      const std::string color = rgb_of(region.fill);
      text += is_pdf ? color + " rg " + color + " RG\n" : color + " c\n";
      for (const auto& loop : loops) {
        text += loop[0] + std::string(words.move);
        for (std::size_t k = 1; k < loop.size(); ++k)
          text += loop[k] + std::string(words.line);
        text += words.close;
      }
      text += with_strokes ? words.fill_and_stroke : words.fill;
    }
  }
  for (const FigureStrokes& strokes : figure.strokes) {
    const std::string width = decimal(strokes.width, 3);
    const std::string color = rgb_of(strokes.color);
    text += is_pdf ? color + " RG " + width + " w\n"
                   : color + " c " + width + " setlinewidth\n";
    for (const auto& segment : strokes.segments) {
      text += pen.at(segment[0]) + std::string(words.move) +
              pen.at(segment[1]) + std::string(words.line);
    }
    text += is_pdf ? "S\n" : "stroke\n";
  }
  return text;
}

std::string deflated(const std::string& text) {
  uLongf size = compressBound(static_cast<uLong>(text.size()));
  std::string result(size, '\0');
  compress2(reinterpret_cast<Bytef*>(result.data()), &size,
            reinterpret_cast<const Bytef*>(text.data()),
            static_cast<uLong>(text.size()), Z_BEST_COMPRESSION);
  result.resize(size);
  return result;
}

std::string pdf_of(const Figure& figure, const FigureOptions& options) {
  const Words words = {" m\n", " l\n", "h\n", "f*\n", "B*\n"};
  const std::string stream =
      deflated(operators_of(figure, options, words, true));
  const std::string objects[] = {
      "<</Type/Catalog/Pages 2 0 R>>", "<</Type/Pages/Kids[3 0 R]/Count 1>>",
      "<</Type/Page/Parent 2 0 R/MediaBox[0 0 " + size_of(figure) +
          "]/Contents 4 0 R/Resources<<>>>>",
      "<</Length " + std::to_string(stream.size()) +
          "/Filter/FlateDecode>>\nstream\n" + stream + "\nendstream"};
  std::string text = "%PDF-1.4\n%\xe2\xe3\xcf\xd3\n";
  std::string table = "xref\n0 5\n0000000000 65535 f \n";
  for (std::size_t k = 0; k < std::size(objects); ++k) {
    const std::string place = std::to_string(text.size());
    table += std::string(10 - place.size(), '0') + place + " 00000 n \n";
    text += std::to_string(k + 1) + " 0 obj\n" + objects[k] + "\nendobj\n";
  }
  const std::string place = std::to_string(text.size());
  return text + table + "trailer\n<</Size 5/Root 1 0 R>>\nstartxref\n" + place +
         "\n%%EOF\n";
}

std::string eps_of(const Figure& figure, const FigureOptions& options) {
  const Words words = {" m\n", " l\n", "h\n", "eofill\n",
                       "gsave eofill grestore stroke\n"};
  return "%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 " + size_of(figure) +
         "\n%%EndComments\n/m {moveto} def /l {lineto} def "
         "/h {closepath} def /c {setrgbcolor} def\n" +
         operators_of(figure, options, words, false) + "showpage\n%%EOF\n";
}

/// PGF's basic layer: big points, as in PDF.
std::string tex_of(const Figure& figure, const FigureOptions& options) {
  const Pen pen = {options.decimals, static_cast<double>(figure.height)};
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
      "% \\usepackage{pgf}\n\\begin{pgfpicture}\n\\pgfpathrectangle"
      "{\\pgfpointorigin}{\\pgfpoint{" +
      std::to_string(figure.width) + "bp}{" + std::to_string(figure.height) +
      "bp}}\n\\pgfusepath{use as bounding box}\n\\pgfseteorule"
      "\\pgfsetroundjoin\\pgfsetroundcap\\pgfsetlinewidth{1bp}\n";
  for (const bool with_strokes : {true, false}) {
    for (const FigureRegion& region : figure.regions) {
      const auto loops = loops_of(region, pen);
      if (loops.empty()) continue;
      text += color("\\pgfsetcolor{h}", region.fill);
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
    text += color("\\pgfsetstrokecolor{h}", strokes.color) +
            "\\pgfsetlinewidth{" + decimal(strokes.width, 3) + "bp}\n";
    for (const auto& segment : strokes.segments) {
      text += "\\pgfpathmoveto{" + point(pen.at(segment[0])) +
              "}\\pgfpathlineto{" + point(pen.at(segment[1])) + "}\n";
    }
    text += "\\pgfusepath{stroke}\n";
  }
  return text + "\\end{pgfpicture}\n";
}

struct FigureFormat {
  std::string_view ending;
  std::string (*write)(const Figure&, const FigureOptions&);
};
constexpr FigureFormat kFormats[] = {
    {".svg", svg_of}, {".pdf", pdf_of}, {".eps", eps_of}, {".tex", tex_of}};

}  // namespace

std::string figure_format_names() {
  std::string names;
  for (const FigureFormat& format : kFormats)
    names += (names.empty() ? "" : " ") + std::string(format.ending);
  return names;
}

bool is_figure_name(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  return std::any_of(
      std::begin(kFormats), std::end(kFormats),
      [&](const FigureFormat& format) { return format.ending == ending; });
}

Result<std::string> figure_bytes(std::string_view ending, const Figure& figure,
                                 const FigureOptions& options) {
  for (const FigureFormat& format : kFormats) {
    if (format.ending == ending) return format.write(figure, options);
  }
  return Error{ErrorCode::kUnknownFormat,
               "a figure's name ends in one of " + figure_format_names()};
}

Result<Done> write_figure(const std::filesystem::path& path,
                          const Figure& figure, const FigureOptions& options) {
  const Result<std::string> bytes =
      figure_bytes(path.extension().string(), figure, options);
  if (!bytes) return bytes.error();
  return write_file(path, *bytes);
}

}  // namespace halfspace::io
