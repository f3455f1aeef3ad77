#include "core/picture.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <thread>
#include <utility>

#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/shade/lines.hpp"
#include "halfspace/fast/shade/look.hpp"

namespace halfspace::viewer {
namespace {

/// Two faces that meet at more than this make a line, as `halfspace render
/// --lines features` has it, and how wide lines are there.
constexpr double kCreaseDeg = 20;
constexpr std::int32_t kLineWidth = 20;

int thread_count() {
  return static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

}  // namespace

PictureRequest picture_of(const State& state,
                          std::shared_ptr<const Model> model,
                          const Camera& camera,
                          std::shared_ptr<const ShownNumbers> numbers) {
  PictureRequest request;
  request.options = image_options(state, *model);
  request.model = std::move(model);
  request.camera = camera;
  request.alpha = state.looks.alpha;
  request.numbers = std::move(numbers);
  request.back_color = back_color_of(state);
  request.line_style.width = kLineWidth;
  request.line_style.color = line_color_of(state);
  if (state.looks.lines == Lines::kOutline)
    request.line_style.classes &= ~set_of(EdgeClass::kCrease);
  return request;
}

Result<std::shared_ptr<const fast::Drawing>> lines_for(
    const PictureRequest& picture, Lines lines) {
  DrawingOptions options = drawing_over(picture.options);
  if (lines != Lines::kWire) {
    options.crease_cosine = static_cast<std::int32_t>(std::lround(std::ldexp(
        std::cos(kCreaseDeg * std::numbers::pi / 180), kCosineBits)));
  }
  Result<fast::Drawing> drawing =
      fast::draw(picture.model->loaded.file.scene, picture.camera, options);
  if (!drawing) return drawing.error();
  return std::shared_ptr<const fast::Drawing>(
      std::make_shared<fast::Drawing>(*std::move(drawing)));
}

const fast::ScalarColors& PictureMaker::scalar_colors(
    const PictureRequest& request) {
  if (colored_ != request.numbers) {
    colored_ = request.numbers;
    scalar_colors_ =
        fast::prepare_scalars(request.model->loaded.file.scene,
                              colored_->numbers->field, colored_->scale);
  }
  return scalar_colors_;
}

void PictureMaker::draw(const PictureRequest& request, std::int32_t first_row,
                        std::int32_t end_row, fast::Rendering& rendering) {
  const Scene& scene = request.model->loaded.file.scene;
  fast::RenderOptions how;
  how.threads = thread_count();
  how.items = request.numbers && request.numbers->has_legend;
  how.rectangle = {0, first_row, request.camera->width_px, end_row};
  fast::render_look(scene, *request.model->tree, request.camera,
                    request.options, {request.alpha, 1, request.back_color},
                    how, request.numbers ? &scalar_colors(request) : nullptr,
                    rendering);
  if (request.lines)
    fast::add_lines(*request.lines, request.line_style, {}, rendering.colors);
  if (request.numbers && request.numbers->has_legend) {
    io::draw_legend(request.numbers->legend, rendering.items,
                    request.options.background, rendering.colors);
  }
}

}  // namespace halfspace::viewer
