#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "figure/figures.hpp"
#include "halfspace/camera.hpp"
#include "halfspace/result.hpp"
#include "halfspace/scene.hpp"

namespace CLI {
class App;
}

namespace halfspace::tools {

/// A sheet of paper with views, as the command line describes it.
struct SheetArguments {
  std::optional<std::pair<double, double>> size;  ///< units: millimetres
  std::vector<std::string> views = {"front", "left", "top", "iso"};
  std::optional<double> scale;  ///< of paper to model
  bool is_used() const { return size.has_value(); }
  double width_mm() const { return size->first; }
  double height_mm() const { return size->second; }
};

void add_sheet_options(CLI::App& app, SheetArguments& arguments);

/// A view on a sheet.
struct SheetView {
  Camera camera;
  Placing placing;   ///< from pixels of the camera to millimetres
  double scale = 1;  ///< of paper to model, whose unit is a millimetre
};

/// The views in rows of two, or of three if there are more than four, all in
/// one scale and with the middle of the scene in the middle of their places, so
/// that neighbours in a row, or in a column, are level with each other. If no
/// scale is asked for, it is the greatest of 1, 2, 5 and their tenfolds, or of
/// their reciprocals, that all views have room for.
///
/// Requires: the scene has polygons.
/// Errors:   kBadCamera: the views have no room, or a pixel is less than the
///           camera's lattice tells.
Result<std::vector<SheetView>> views_on(const SheetArguments& sheet,
                                        const Scene& scene);

/// A scale such as `1:2`.
std::string scale_text(double scale);

}  // namespace halfspace::tools
