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

/// A point of a figure; x grows to the right, y downwards. Units: pixels.
using FigurePoint = std::array<double, 2>;

/// A region of one colour: closed loops, filled by the even-odd rule.
struct FigureRegion {
  std::vector<std::vector<FigurePoint>> loops;
  Rgb fill;
  std::string id;     ///< where the format has names; empty: none
  std::string title;  ///< what a viewer shows beside the pointer; empty: none
};

/// Straight strokes of one kind.
struct FigureStrokes {
  std::vector<std::array<FigurePoint, 2>> segments;
  Rgb color;
  double width = 1;  ///< units: pixels
};

/// A figure: regions that share borders, and strokes over them.
struct Figure {
  std::int32_t width = 0;  ///< units: pixels
  std::int32_t height = 0;
  std::vector<FigureRegion> regions;
  std::vector<FigureStrokes> strokes;
};

/// How a figure is written.
struct FigureOptions {
  /// Coordinates are written with this number of decimals, zeros at the end
  /// left out: none moves by more than half a unit of the last one.
  int decimals = 3;
};

/// The endings of the formats, ".svg .pdf .eps .tex".
std::string figure_format_names();

/// Whether the ending of the name is a figure's.
bool is_figure_name(const std::filesystem::path& path);

/// Writes a figure as SVG, PDF, EPS or PGF/TikZ, by the ending of the name.
///
/// No seams: every region is drawn with a stroke in its own colour first, then
/// all of them again without, so that along a common border only the colours
/// of its two sides are mixed.
/// The same bytes for the same figure.
/// Errors: kUnknownFormat, kUnwritable.
Result<Done> write_figure(const std::filesystem::path& path,
                          const Figure& figure,
                          const FigureOptions& options = {});

/// The bytes that write_figure() writes for an ending such as ".svg".
Result<std::string> figure_bytes(std::string_view ending, const Figure& figure,
                                 const FigureOptions& options = {});

}  // namespace halfspace::io
