#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/arguments.hpp"
#include "halfspace/io/color_map.hpp"
#include "halfspace/io/legend.hpp"
#include "halfspace/io/load_scene.hpp"
#include "halfspace/io/scalars.hpp"
#include "halfspace/result.hpp"
#include "halfspace/scalars.hpp"

namespace CLI {
class App;
}

namespace halfspace::tools {

/// What the command line says about scalars and their colours (S11).
struct ScalarArguments {
  std::optional<std::string> source;  ///< a property, or a file of numbers
  std::optional<std::string> owner;   ///< of the property, if not the FILE
  std::optional<io::ScalarPlace> place;
  std::string map = "viridis";
  std::optional<std::array<double, 2>> range;
  bool logarithmic = false;
  std::optional<std::int32_t> steps;
  bool clamp = true;
  std::optional<Rgb> no_data;
  bool has_legend = false;
  std::optional<std::string> title;
};

/// Adds --scalar and what belongs to it.
/// Requires: `arguments` outlives the parsing.
void add_scalar_options(CLI::App& app, ScalarArguments& arguments);

/// What is wrong with the options by themselves; empty if nothing.
std::string scalar_complaint(const ScalarArguments& arguments);

/// A scalar field as it is shown.
struct ShownScalars {
  ScalarField field;
  io::Legend legend;  ///< the scale, and what a legend says of it
  /// Of figures: by polygon whether it has several colours.
  std::vector<bool> banded = {};
};

/// The field and the scale that the arguments ask for, of the scene that was
/// loaded from `path` with the options that color_by_scalars() makes.
///
/// Requires: arguments.source.
/// Errors:   those of io::read_scalars(), io::read_ply_scalars(),
///           io::scalars_of(), io::read_color_map() and io::make_scale();
///           kEmpty (no number at all). The message names the file or option.
Result<ShownScalars> load_scalars(const std::string& path,
                                  const io::LoadedScene& loaded,
                                  const ScalarArguments& arguments);

/// How a field is shown: `source` is what the command line calls it.
/// Errors: those of io::read_color_map() and io::make_scale(); kEmpty (no
///         number at all).
Result<ShownScalars> shown_scalars(ScalarField field,
                                   const ScalarArguments& arguments);

/// The size of the part of a picture beside the legend, if there is one.
Size size_beside_legend(const std::optional<ShownScalars>& scalars,
                        const ScalarArguments& arguments, const Size& size);

/// Has a mesh imported so that its colours are the light on white, and so that
/// vertices are told apart.
void color_by_scalars(io::ImportOptions& options);

}  // namespace halfspace::tools
