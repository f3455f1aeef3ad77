#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "halfspace/drawing.hpp"
#include "halfspace/line_style.hpp"
#include "halfspace/polygon.hpp"

namespace CLI {
class App;
}

namespace halfspace::tools {

/// Which edges are drawn over a picture.
enum class ShownEdges : std::uint8_t { kOutline, kFeatures, kWire };

/// What the command line says about lines over a picture (S14).
struct LineArguments {
  std::optional<ShownEdges> edges;
  std::optional<double> width_px;
  std::optional<Rgb> color;
  std::optional<double> crease_deg;
};

/// Adds --lines and what belongs to it.
/// Requires: `arguments` outlives the parsing.
void add_line_options(CLI::App& app, LineArguments& arguments);

/// What is wrong with the options by themselves; empty if nothing.
std::string line_complaint(const LineArguments& arguments);

/// What is drawn of which drawing. Requires: arguments.edges.
struct ShownLines {
  LineStyle style;
  DrawingOptions drawing;
};
ShownLines shown_lines(const LineArguments& arguments,
                       const ImageOptions& image);

}  // namespace halfspace::tools
