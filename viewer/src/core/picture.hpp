#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "halfspace/camera.hpp"
#include "halfspace/fast/build.hpp"
#include "halfspace/fast/drawing.hpp"
#include "halfspace/fast/render.hpp"
#include "halfspace/fast/shade/scalars.hpp"
#include "halfspace/image.hpp"
#include "halfspace/line_style.hpp"
#include "halfspace/viewer/model.hpp"

namespace halfspace::viewer {

/// All that a picture is made of.
struct PictureRequest {
  std::shared_ptr<const Model> model;
  Camera camera;
  ImageOptions options;
  std::uint8_t alpha = kOpaque;
  std::shared_ptr<const ShownNumbers> numbers;  ///< null: the scene's colours
  std::optional<Rgb> back_color;  ///< nothing with numbers, or with an alpha
  std::shared_ptr<const fast::Drawing> lines;  ///< null: none
  LineStyle line_style = {};
};

/// The picture of the state, without lines.
PictureRequest picture_of(const State& state,
                          std::shared_ptr<const Model> model,
                          const Camera& camera,
                          std::shared_ptr<const ShownNumbers> numbers);

/// The drawing whose lines are laid over the picture, but not kNone.
/// Errors: kOutOfRange: there are too many.
Result<std::shared_ptr<const fast::Drawing>> lines_for(
    const PictureRequest& picture, Lines lines);

/// Makes pictures, one after another.
class PictureMaker {
 public:
  /// Makes the rows from `first_row` up to but not including `end_row`, with as
  /// many threads as the machine has. A legend and lines are drawn over what is
  /// there, so they take all rows.
  void draw(const PictureRequest& request, std::int32_t first_row,
            std::int32_t end_row, fast::Rendering& rendering);

 private:
  const fast::ScalarColors& scalar_colors(const PictureRequest& request);

  /// The colours of the polygons by those numbers: all polygons are looked at.
  std::shared_ptr<const ShownNumbers> colored_;
  fast::ScalarColors scalar_colors_;
};

}  // namespace halfspace::viewer
