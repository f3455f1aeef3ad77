#include "figure/scalar_figure.hpp"

#include <utility>

#include "cli/loading.hpp"
#include "figure/bands.hpp"
#include "figure/figure_scene.hpp"

namespace halfspace::tools {

Result<FigureScene> load_scalar_figure(const std::string& path,
                                       const io::ImportOptions& options,
                                       const ScalarArguments& scalars) {
  Result<io::LoadedScene> loaded = load(path, options);
  if (!loaded) return loaded.error();
  Result<ShownScalars> shown = load_scalars(path, *loaded, scalars);
  if (!shown) return shown.error();
  shown->banded =
      banded_polygons(loaded->file.scene, shown->field, shown->legend.scale);
  loaded->file.scene = scalar_scene(loaded->file.scene, *shown);
  FigureScene figure = figure_of(path, std::move(loaded->file));
  figure.scalars = *std::move(shown);
  return figure;
}

}  // namespace halfspace::tools
