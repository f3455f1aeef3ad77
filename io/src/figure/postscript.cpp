#if defined(HALFSPACE_ZLIB)
#include <zlib.h>
#endif

#include <cmath>

#include "figure/writers.hpp"

namespace halfspace::io {
namespace {

/// The unit of PDF and EPS is 1/72 inch.
constexpr double kPointsPerMm = 72 / 25.4;

std::string postscript_rgb(Rgb color) {
  std::string text;
  for (const std::uint8_t channel : {color.r, color.g, color.b})
    text += (text.empty() ? "" : " ") + decimal(channel / 255.0, 4);
  return text;
}

/// The size in points, as numbers that hold it.
std::string size_of(const Figure& figure, int decimals) {
  const Pen pen = upright_pen(figure, {}, kPointsPerMm);
  const auto text = [&](double length) {
    const double points = pen.scale * length;
    return decimal(decimals == 0 ? std::ceil(points) : points, decimals);
  };
  return text(figure.width) + " " + text(figure.height);
}

/// The words of a language that draws paths.
struct Words {
  std::string_view move, line, close, fill, fill_and_stroke;
};

/// The regions twice, first with strokes, and the strokes, as PDF and EPS have
/// them: operands first.
std::string operators_of(const Figure& figure, const FigureOptions& options,
                         const Words& words, bool is_pdf) {
  const Pen pen = upright_pen(figure, options, kPointsPerMm);
  std::string text =
      is_pdf ? "1 j 1 J 1 w\n" : "1 setlinejoin 1 setlinecap 1 setlinewidth\n";
  for (const bool with_strokes : {true, false}) {
    for (const FigureRegion* region : drawn_regions(figure, with_strokes)) {
      const auto loops = loops_of(*region, pen);
      if (loops.empty()) continue;
      const std::string color = postscript_rgb(region->fill);
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
    const std::string width = decimal(pen.scale * strokes.width, 3);
    const std::string color = postscript_rgb(strokes.color);
    std::string dashes = "[";
    for (const double dash : strokes.dashes)
      dashes += (dashes.size() > 1 ? " " : "") + decimal(pen.scale * dash, 3);
    text += is_pdf ? color + " RG " + width + " w " + dashes + "] 0 d\n"
                   : color + " c " + width + " setlinewidth " + dashes +
                         "] 0 setdash\n";
    for (const auto& chain : chains_of(strokes, pen)) {
      text += chain[0] + std::string(words.move);
      for (std::size_t k = 1; k < chain.size(); ++k)
        text += chain[k] + std::string(words.line);
      // A path of PostScript has a limit.
      if (!is_pdf) text += "stroke\n";
    }
    if (is_pdf) text += "S\n";
  }
  return text;
}

#if defined(HALFSPACE_ZLIB)
std::string deflated(const std::string& text) {
  uLongf size = compressBound(static_cast<uLong>(text.size()));
  std::string result(size, '\0');
  compress2(reinterpret_cast<Bytef*>(result.data()), &size,
            reinterpret_cast<const Bytef*>(text.data()),
            static_cast<uLong>(text.size()), Z_BEST_COMPRESSION);
  result.resize(size);
  return result;
}
#endif

/// The text as the stream of a PDF object: its entries, and its bytes.
std::string stream_of(std::string bytes) {
  std::string filter;
#if defined(HALFSPACE_ZLIB)
  filter = "/Filter/FlateDecode";
  bytes = deflated(bytes);
#endif
  return "<</Length " + std::to_string(bytes.size()) + filter + ">>\nstream\n" +
         bytes + "\nendstream";
}

}  // namespace

std::string pdf_of(const Figure& figure, const FigureOptions& options) {
  const Words words = {" m\n", " l\n", "h\n", "f*\n", "B*\n"};
  const std::string stream =
      stream_of(operators_of(figure, options, words, true));
  const std::string objects[] = {
      "<</Type/Catalog/Pages 2 0 R>>", "<</Type/Pages/Kids[3 0 R]/Count 1>>",
      "<</Type/Page/Parent 2 0 R/MediaBox[0 0 " + size_of(figure, 3) +
          "]/Contents 4 0 R/Resources<<>>>>",
      stream};
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
  return "%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 " + size_of(figure, 0) +
         "\n%%EndComments\n/m {moveto} def /l {lineto} def "
         "/h {closepath} def /c {setrgbcolor} def\n" +
         operators_of(figure, options, words, false) + "showpage\n%%EOF\n";
}

}  // namespace halfspace::io
