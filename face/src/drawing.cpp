#include "halfspace/fast/drawing.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "display_state.hpp"
#include "halfspace/io/figure.hpp"

/// Drawings of a display: visible and hidden lines.
namespace halfspace {

Result<Done> LineDrawing::save(const std::filesystem::path& path,
                               bool with_hidden) const {
  io::Figure figure;
  figure.width = width_px;
  figure.height = height_px;
  for (const bool hidden : {true, false}) {
    if (hidden && !with_hidden) continue;
    io::FigureStrokes strokes;
    strokes.name = hidden ? "hidden" : "visible";
    strokes.width = hidden ? 0.5 : 1;
    if (hidden) strokes.dashes = {4, 3};
    for (const DrawnLine& line : lines) {
      if ((line.layers > 0) != hidden) continue;
      strokes.strokes.push_back(
          {{line.from.x, line.from.y}, {line.to.x, line.to.y}, {}});
    }
    io::order_for_pen(strokes.strokes);
    figure.strokes.push_back(std::move(strokes));
  }
  return io::write_figure(path, figure);
}

Result<LineDrawing> Display::draw(const View& view, double crease_deg) const {
  if (!(crease_deg >= 0 && crease_deg <= 180)) {
    return Error{ErrorCode::kOutOfRange,
                 "the crease angle is not from 0 to 180 degrees"};
  }
  const Result<Camera> camera = detail::camera_of(state_->scene, view);
  if (!camera) return camera.error();
  const Result<ImageOptions> section = state_->options_of(view);
  if (!section) return section.error();
  DrawingOptions options;
  options.cull = view.cull;
  options.clips = section->clips;
  options.caps = section->caps.has_value();
  options.crease_cosine = static_cast<std::int32_t>(std::lround(
      std::ldexp(std::cos(crease_deg * std::numbers::pi / 180), kCosineBits)));
  const auto drawing = fast::draw(state_->scene, *camera, options);
  if (!drawing) return drawing.error();
  LineDrawing result{view.width_px, view.height_px, {}};
  for (const fast::Stroke& stroke : drawing->strokes) {
    result.lines.push_back({{stroke.from.x, stroke.from.y},
                            {stroke.to.x, stroke.to.y},
                            stroke.edge_class,
                            stroke.layers});
  }
  return result;
}

}  // namespace halfspace
