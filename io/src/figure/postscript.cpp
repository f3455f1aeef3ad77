#if defined(HALFSPACE_ZLIB)
#include <zlib.h>
#endif

#include <algorithm>
#include <cmath>
#include <vector>

#include "figure/shading.hpp"
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

/// A string of either language.
std::string quoted(const std::string& letters) {
  std::string text = "(";
  for (const char letter : letters) {
    if (letter == '(' || letter == ')' || letter == '\\') text += '\\';
    text += letter;
  }
  return text + ")";
}

std::string path_of(const std::vector<std::vector<std::string>>& loops,
                    const Words& words) {
  std::string text;
  for (const auto& loop : loops) {
    text += loop[0] + std::string(words.move);
    for (std::size_t k = 1; k < loop.size(); ++k)
      text += loop[k] + std::string(words.line);
    text += words.close;
  }
  return text;
}

/// Paints the mesh of shaded regions, the resource S, where these are. By the
/// winding rule neighbours make one area: the clip has no edge between them.
std::string mesh_of(const Figure& figure, const Words& words, const Pen& pen) {
  std::string text;
  for (const FigureRegion& region : figure.regions) {
    if (region.shade) text += path_of(loops_of(region, pen), words);
  }
  return text.empty() ? text : "q\n" + text + "W n\n/S sh\nQ\n";
}

std::string regions_of(const Figure& figure, const Words& words, const Pen& pen,
                       bool is_pdf) {
  std::string text;
  for (const bool with_strokes : {true, false}) {
    bool has_mesh = false;
    const auto add_mesh = [&] {
      if (!is_pdf || with_strokes || has_mesh) return;
      has_mesh = true;
      text += mesh_of(figure, words, pen);
    };
    for (const FigureRegion* region : drawn_regions(figure, with_strokes)) {
      const auto loops = loops_of(*region, pen);
      if (loops.empty()) continue;
      if (region->is_background) add_mesh();
      const std::string color = postscript_rgb(region->fill);
      text += is_pdf ? color + " rg " + color + " RG\n" : color + " c\n";
      text += path_of(loops, words);
      text += with_strokes ? words.fill_and_stroke : words.fill;
    }
    add_mesh();
  }
  return text;
}

/// Either language turns a text's anchor into its own words; PDF has none, so
/// it takes the widths of the letters.
std::string texts_of(const Figure& figure, const Pen& pen, bool is_pdf) {
  std::string text;
  for (const FigureText& line : figure.texts) {
    const std::string size = decimal(pen.scale * line.size, 3);
    const std::string start = pen.at(start_of(line));
    text += is_pdf ? "BT\n" + postscript_rgb(line.color) + " rg\n/F " + size +
                         " Tf\n" + start + " Td\n" + quoted(line.text) +
                         " Tj\nET\n"
                   : postscript_rgb(line.color) + " c /Helvetica findfont " +
                         size + " scalefont setfont\n" + start + " m " +
                         quoted(line.text) + " show\n";
  }
  return text;
}

/// The regions twice, first with strokes, and the strokes, as PDF and EPS have
/// them: operands first.
std::string operators_of(const Figure& figure, const Pen& pen,
                         const Words& words, bool is_pdf) {
  std::string text =
      is_pdf ? "1 j 1 J 1 w\n" : "1 setlinejoin 1 setlinecap 1 setlinewidth\n";
  text += regions_of(figure, words, pen, is_pdf);
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
  return text + texts_of(figure, pen, is_pdf);
}

/// The shaded regions as a mesh of triangles, three vertices each: the flag, a
/// byte; x and y, 32 bits each, over the page; three channels of 16 bits.
std::string mesh_bytes(const Figure& figure, double levels) {
  std::string bytes;
  const auto put = [&bytes](std::uint64_t value, int size) {
    for (int k = size - 1; k >= 0; --k)
      bytes += static_cast<char>(value >> (8 * k) & 255);
  };
  const auto share = [](double value, double most) {
    return static_cast<std::uint64_t>(
        std::llround(std::clamp(value, 0.0, 1.0) * most));
  };
  for (const FigureRegion& region : figure.regions) {
    if (!region.shade) continue;
    for (const ShadeTriangle& triangle : shade_triangles(region, levels)) {
      for (const FigurePoint& p : triangle) {
        put(0, 1);
        put(share(p[0] / figure.width, 0xFFFFFFFFp0), 4);
        put(share(1 - p[1] / figure.height, 0xFFFFFFFFp0), 4);
        for (const double channel : region.shade->at(p))
          put(share(channel / 255, 0xFFFFp0), 2);
      }
    }
  }
  return bytes;
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
std::string stream_of(std::string bytes, const std::string& entries = {}) {
  std::string filter = entries;
#if defined(HALFSPACE_ZLIB)
  filter += "/Filter/FlateDecode";
  bytes = deflated(bytes);
#endif
  return "<</Length " + std::to_string(bytes.size()) + filter + ">>\nstream\n" +
         bytes + "\nendstream";
}

}  // namespace

std::string pdf_of(const Figure& figure, const FigureOptions& options) {
  const Words words = {" m\n", " l\n", "h\n", "f*\n", "B*\n"};
  const Pen pen = fitted(upright_pen(figure, options, kPointsPerMm), figure);
  const std::string stream = stream_of(operators_of(figure, pen, words, true));
  const std::string mesh = mesh_bytes(figure, options.levels);
  std::string resources;
  if (!mesh.empty()) resources += "/Shading<</S 5 0 R>>";
  if (!figure.texts.empty()) {
    resources +=
        "/Font<</F<</Type/Font/Subtype/Type1/BaseFont/Helvetica/Encoding"
        "/WinAnsiEncoding>>>>";
  }
  std::vector<std::string> objects = {
      "<</Type/Catalog/Pages 2 0 R>>", "<</Type/Pages/Kids[3 0 R]/Count 1>>",
      "<</Type/Page/Parent 2 0 R/MediaBox[0 0 " + size_of(figure, 3) +
          "]/Contents 4 0 R/Resources<<" + resources + ">>>>",
      stream};
  if (!mesh.empty()) {
    const auto span = [&](double length) {
      return "0 " + decimal(pen.scale * length, 9) + " ";
    };
    objects.push_back(stream_of(
        mesh,
        "/ShadingType 4/ColorSpace/DeviceRGB/BitsPerCoordinate 32"
        "/BitsPerComponent 16/BitsPerFlag 8/Decode[" +
            span(figure.width) + span(figure.height) + "0 1 0 1 0 1]"));
  }
  std::string text = "%PDF-1.4\n%\xe2\xe3\xcf\xd3\n";
  if (!figure.regions.empty())
    text += "% " + certificate_text(figure, pen) + "\n";
  const std::string count = std::to_string(objects.size() + 1);
  std::string table = "xref\n0 " + count + "\n0000000000 65535 f \n";
  for (std::size_t k = 0; k < std::size(objects); ++k) {
    const std::string place = std::to_string(text.size());
    table += std::string(10 - place.size(), '0') + place + " 00000 n \n";
    text += std::to_string(k + 1) + " 0 obj\n" + objects[k] + "\nendobj\n";
  }
  const std::string place = std::to_string(text.size());
  return text + table + "trailer\n<</Size " + count +
         "/Root 1 0 R>>\nstartxref\n" + place + "\n%%EOF\n";
}

std::string eps_of(const Figure& shaded, const FigureOptions& options) {
  const Figure figure = in_flat_parts(shaded, options.levels);
  const Pen pen = fitted(upright_pen(figure, options, kPointsPerMm), figure);
  const Words words = {" m\n", " l\n", "h\n", "eofill\n",
                       "gsave eofill grestore stroke\n"};
  const std::string note = figure.regions.empty()
                               ? std::string()
                               : "% " + certificate_text(figure, pen) + "\n";
  return "%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 " + size_of(figure, 0) +
         "\n%%EndComments\n" + note +
         "/m {moveto} def /l {lineto} def "
         "/h {closepath} def /c {setrgbcolor} def\n" +
         operators_of(figure, pen, words, false) + "showpage\n%%EOF\n";
}

}  // namespace halfspace::io
