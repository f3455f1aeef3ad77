#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/polygon.hpp"
#include "halfspace/result.hpp"

namespace halfspace::io {

/// A point of a figure; x grows to the right, y downwards. Units: the figure's.
using FigurePoint = std::array<double, 2>;

/// A colour that changes over a figure: at the point (x, y) a channel, from 0
/// to 255, is the quotient of its form and the last one, each being
/// `form[0] x + form[1] y + form[2]`. Requires: the last one is positive
/// wherever the colour is asked for.
struct FigureShade {
  std::array<std::array<double, 3>, 4> forms{};

  /// Red, green and blue, not rounded.
  std::array<double, 3> at(const FigurePoint& p) const;
};

/// A region of one colour: closed loops, filled by the even-odd rule.
struct FigureRegion {
  std::vector<std::vector<FigurePoint>> loops;
  Rgb fill;  ///< with `shade` the colour of its middle
  std::optional<FigureShade> shade;
  std::string id;        ///< where the format has names; empty: none
  std::string class_of;  ///< the class of its path in SVG; empty: none
  std::string title;  ///< what a viewer shows beside the pointer; empty: none
  bool is_background = false;  ///< nothing of the scene is seen in it
};

/// A straight stroke.
struct FigureStroke {
  FigurePoint from{};
  FigurePoint to{};
  std::string title;  ///< what a viewer shows beside the pointer; empty: none
  friend bool operator==(const FigureStroke&, const FigureStroke&) = default;
};

/// Strokes of one kind.
struct FigureStrokes {
  std::vector<FigureStroke> strokes;
  Rgb color;
  double width = 1;  ///< units: those of points
  /// The lengths of dashes and the gaps after them, in turn; empty: solid.
  std::vector<double> dashes;
  std::string name;  ///< of the layer, where the format has such; empty: none
};

/// Where a text stands on its point: the point is at its left, in its middle
/// or at its right, on the line that its letters stand on.
enum class TextAnchor : std::uint8_t { kStart, kMiddle, kEnd };

/// A line of letters of ASCII, in Helvetica or what a viewer has in its place.
struct FigureText {
  FigurePoint at{};
  std::string text;
  double size = 12;  ///< the height of a line. Units: those of points
  TextAnchor anchor = TextAnchor::kStart;
  Rgb color;
  std::string class_of;  ///< its class in SVG; empty: none
};

/// A figure: regions that share borders, strokes over them, texts over all.
struct Figure {
  double width = 0;
  double height = 0;
  /// The length of a unit of points on paper. 0: they are pixels, which are as
  /// long as each format's own units; of SVG and plotters 1/96 inch, of the
  /// others 1/72.
  double unit_mm = 0;
  std::vector<FigureRegion> regions;
  std::vector<FigureStrokes> strokes;
  std::vector<FigureText> texts;
};

/// How a figure is written.
struct FigureOptions {
  /// Coordinates are written with this number of decimals, zeros at the end
  /// left out: none moves by more than half a unit of the last one, and there
  /// is no shorter number that is as near. Where that would turn a loop of a
  /// region over, the loop's corners get more, up to 12.
  int decimals = 3;
  /// How far a channel of a shaded region may be off, from 1 on. Units: levels,
  /// of which a channel has 255.
  double levels = 2;
};

/// What rounding its coordinates did to the regions of a figure.
struct FigureCertificate {
  /// The farthest that a coordinate has moved, and the most that it may have.
  /// Units: those of the format.
  double largest_move = 0;
  double bound = 0;
  std::size_t loops = 0;
  std::size_t turned_over = 0;  ///< loops that go round the other way: none
  /// Loops without area, and those that would turn over even so.
  std::size_t vanished = 0;
  std::size_t finer_points = 0;  ///< with more than FigureOptions::decimals
  int most_decimals = 0;         ///< of any point
};

/// The endings of the formats, ".svg .pdf .eps .tex .dxf .hpgl".
std::string figure_format_names();

/// Whether the ending of the name is a figure's.
bool is_figure_name(const std::filesystem::path& path);

/// Whether files of this ending hold strokes alone, such as ".hpgl".
bool is_plotter_format(std::string_view ending);

/// Writes a figure as SVG, PDF, EPS, PGF/TikZ, DXF or HPGL, by the ending of
/// the name. DXF and HPGL hold the strokes and texts alone.
///
/// Shaded regions: PDF has one mesh of triangles whose colours a viewer
/// interpolates (ISO 32000, shading type 4). The others have parts of a region:
/// SVG with a linear gradient each, EPS and PGF of one colour. No channel is
/// off by more than `options.levels` anywhere, but for what a viewer rounds.
///
/// No seams: every region is drawn with a stroke in its own colour first, the
/// background before the others, then all of them again without, the background
/// after the others. So along a common border only the colours of its two sides
/// are mixed, and background only where it has a share of the pixel.
/// The same bytes for the same figure.
/// Errors: kUnknownFormat, kUnwritable.
Result<Done> write_figure(const std::filesystem::path& path,
                          const Figure& figure,
                          const FigureOptions& options = {});

/// The bytes that write_figure() writes for an ending such as ".svg".
Result<std::string> figure_bytes(std::string_view ending, const Figure& figure,
                                 const FigureOptions& options = {});

/// The certificate of the file that write_figure() writes, which SVG, PDF, EPS
/// and PGF also hold as a comment.
/// Exact: signs of the loops' areas before and after rounding.
FigureCertificate certify(std::string_view ending, const Figure& figure,
                          const FigureOptions& options = {});

/// The part of loops where `line[0] x + line[1] y + line[2]` is below 0, or
/// where it is not, by the even-odd rule, each loop for itself.
std::vector<std::vector<FigurePoint>> cut_loops(
    const std::vector<std::vector<FigurePoint>>& loops,
    const std::array<double, 3>& line, bool below);

/// Orders strokes for the pen of a plotter, and turns them round: each begins
/// where the one before it ended if one can, else at the end that is nearest,
/// of ties the first. Begins at the first stroke.
/// Cost: n log n where strokes are spread evenly.
void order_for_pen(std::vector<FigureStroke>& strokes);

/// Parallel strokes that hatch a region at 45 degrees, `gap` apart.
std::vector<FigureStroke> hatching(const FigureRegion& region, double gap);

}  // namespace halfspace::io
