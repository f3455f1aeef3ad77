#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "camera/moved_camera.hpp"
#include "halfspace/fast/image/moving.hpp"
#include "raster/band_walk.hpp"

namespace halfspace::fast {

/// What all bands of a frame share.
struct MovingFrame {
  const Assembly& assembly;
  const MovingTrees& trees;
  const Placement& placement;
  const CameraData& camera;
  const ImageOptions& image;
  const TileKernel& kernel;
  const ClipSet& clips;  ///< in the world
};

/// Displays the objects of a frame in one band, each where the walk of its
/// owner's tree comes to its region.
///
/// Tiles are coloured long after their polygons were displayed. So what shades
/// them finds the object by the polygon's id; all else goes to the rasterizer
/// of the object that is being displayed.
class ObjectPainter final : public ExactFallback {
 public:
  ObjectPainter(const MovingFrame& frame, TileBuffer& buffer);

  /// Displays object `object` of occurrence `owner`, if it is there.
  void show(std::int32_t owner, std::int32_t object);
  /// Makes what the world's rasterizer decides go through this.
  void set_world(ExactFallback& world) {
    world_ = current_ = &world;
    buffer_.view().exact = this;
  }

  /// The cell of a model's tree, to its object.
  template <class Show>
  static auto cell(const ModelTree& model, Show&& show) {
    return [&model, show](NodeId id) {
      const std::int32_t object = model.object_at[static_cast<std::size_t>(id)];
      if (object >= 0) show(object);
    };
  }

  std::size_t fragments() const;
  const FilterStats& stats();

 private:
  /// An object in a frame: what its shader needs later.
  struct Shown {
    MovedCamera camera;
    View view;
  };
  /// What displays objects of one model, at one depth of nesting: its view is
  /// another one for each object.
  struct Painter {
    Painter(const MovingFrame& frame, const ModelTree& model,
            const Scene& scene, TileView& screen);
    Shown shown;
    ClipSet clips;
    TreeReader reader;
    Frame frame;
    PolygonRasterizer<kMovedGrid> rasterizer;
  };

  Painter& painter_of(std::int32_t model, std::size_t depth);
  void fetch(std::uint32_t some) const override { current_->fetch(some); }
  PixelSource begin(std::int32_t k, std::int32_t turn) override {
    return current_->begin(k, turn);
  }
  PixelRange exact_line(std::int32_t j, PixelRange range) override {
    return current_->exact_line(j, range);
  }
  void nearer(std::int32_t other, std::int32_t x, std::int32_t y,
              std::uint32_t* lit) override {
    current_->nearer(other, x, y, lit);
  }
  const Gradient& gradient() override { return current_->gradient(); }
  void shade(const PixelSource& source, std::int32_t x, std::int32_t y,
             std::uint32_t bits, std::uint8_t* colors,
             std::int64_t at) override;
  void blend(std::int32_t x, std::int32_t y,
             const std::uint32_t* bits) override {
    current_->blend(x, y, bits);
  }

  const MovingFrame& frame_;
  TileBuffer& buffer_;
  ExactFallback* world_ = nullptr;
  ExactFallback* current_ = nullptr;
  std::size_t depth_ = 0;
  bool is_gouraud_;
  std::map<std::pair<std::int32_t, std::size_t>, std::unique_ptr<Painter>>
      painters_;
  /// Objects whose polygons have colours at corners, by their first ids.
  std::map<PolygonId, std::pair<std::int32_t, std::unique_ptr<Shown>>> shown_;
  FilterStats stats_;
};

}  // namespace halfspace::fast
