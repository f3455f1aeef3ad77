#include "moving/object_painter.hpp"

#include <iterator>
#include <utility>

namespace halfspace::fast {

ObjectPainter::Painter::Painter(const MovingFrame& all, const ModelTree& model,
                                const Scene& scene, TileView& screen)
    : clips(all.clips),
      reader(scene, model.tree),
      frame{reader, all.camera, all.image, shown.view,   all.kernel,
            clips,  kOpaque,    nullptr,   &shown.camera},
      rasterizer(frame, screen) {}

ObjectPainter::ObjectPainter(const MovingFrame& frame, TileBuffer& buffer)
    : frame_(frame),
      buffer_(buffer),
      is_gouraud_(frame.image.shading == Shading::kGouraud) {}

ObjectPainter::Painter& ObjectPainter::painter_of(std::int32_t model,
                                                  std::size_t depth) {
  std::unique_ptr<Painter>& painter = painters_[{model, depth}];
  if (!painter) {
    painter = std::make_unique<Painter>(
        frame_, frame_.trees.models[static_cast<std::size_t>(model)],
        frame_.assembly.model(model).scene, buffer_.view());
    buffer_.view().exact = this;
  }
  return *painter;
}

/// The rasterizers recurse as objects are nested: at most kMostNesting deep.
void ObjectPainter::show(std::int32_t owner, std::int32_t object) {
  const auto& occurrences = frame_.assembly.occurrences();
  const std::int32_t here =
      occurrences[static_cast<std::size_t>(owner)].first_child + object;
  const auto& map = frame_.placement.to_world()[static_cast<std::size_t>(here)];
  if (!map) return;
  const Occurrence& occurrence = occurrences[static_cast<std::size_t>(here)];
  const Scene& scene = frame_.assembly.model(occurrence.model).scene;
  Painter& painter = painter_of(occurrence.model, depth_);
  painter.shown.camera = moved_camera(frame_.camera, *map);
  painter.shown.view = make_view(painter.shown.camera, scene.grid_bits());
  if (!frame_.clips.empty())
    painter.clips = frame_.clips.moved(*map, scene.grid_bits());
  painter.frame.first_id = occurrence.first_polygon;
  painter.rasterizer.forget();
  if (is_gouraud_ && !scene.data().corner_colors.empty()) {
    shown_[occurrence.first_polygon] = {occurrence.model,
                                        std::make_unique<Shown>(painter.shown)};
  }
  ExactFallback* const before = std::exchange(current_, &painter.rasterizer);
  ++depth_;
  show_front_to_back(
      painter.frame, buffer_, painter.rasterizer, stats_,
      cell(frame_.trees.models[static_cast<std::size_t>(occurrence.model)],
           [this, here](std::int32_t inner) { show(here, inner); }));
  --depth_;
  current_ = before;
}

void ObjectPainter::shade(const PixelSource& source, std::int32_t x,
                          std::int32_t y, std::uint32_t bits,
                          std::uint8_t* colors, std::int64_t at) {
  const auto after = shown_.upper_bound(source.id);
  if (after != shown_.begin()) {
    const auto& [first, shown] = *std::prev(after);
    const Scene& scene = frame_.assembly.model(shown.first).scene;
    if (source.id - first < static_cast<PolygonId>(scene.polygon_count())) {
      GouraudShader shader(scene, frame_.camera, shown.second->view,
                           &shown.second->camera);
      shader.start(source.id - first, source.eye_sign);
      stats_.exact +=
          static_cast<std::uint64_t>(shader.shade(x, y, bits, colors, at));
      return;
    }
  }
  world_->shade(source, x, y, bits, colors, at);
}

std::size_t ObjectPainter::fragments() const {
  std::size_t count = 0;
  for (const auto& [key, painter] : painters_)
    count += painter->rasterizer.fragments();
  return count;
}

const FilterStats& ObjectPainter::stats() {
  for (const auto& [key, painter] : painters_)
    stats_.add(painter->rasterizer.stats());
  painters_.clear();
  return stats_;
}

}  // namespace halfspace::fast
