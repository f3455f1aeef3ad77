#include "halfspace/fast/shade/look.hpp"

#include <bit>
#include <functional>
#include <memory>
#include <span>
#include <utility>

#include "base/parallel.hpp"
#include "halfspace/assert.hpp"
#include "halfspace/fast/predicate.hpp"
#include "halfspace/fast/shade/back_faces.hpp"
#include "raster/gouraud.hpp"
#include "raster/layers/layer_colors.hpp"
#include "raster/render_pass.hpp"
#include "sah/lazy_cells.hpp"
#include "shade/mark.hpp"
#include "shade/scalar_layers.hpp"

namespace halfspace::fast {
namespace {

/// The colours of layers, marked where they are seen from behind (S5.8).
class MarkedLayers final : public LayerColors {
 public:
  MarkedLayers(const Scene& scene, const Camera& camera,
               const ImageOptions& options, const Look& look)
      : scene_(scene),
        camera_(camera),
        view_(make_view(camera, scene.grid_bits(), look.samples)),
        mark_(*look.mark),
        is_gouraud_(options.shading == Shading::kGouraud) {}

  std::uint32_t color_of(PolygonId polygon) const override {
    const auto corners =
        is_gouraud_ ? scene_.corner_colors(polygon) : std::span<const Rgb>();
    if (has_gradient(corners)) return PixelSource::kSmooth;
    Rgb color = corners.empty() ? scene_.color(polygon) : corners[0];
    FilterStats stats;
    if (is_behind(polygon, stats)) color = marked(mark_, color);
    return packed_color(color.r, color.g, color.b);
  }
  std::unique_ptr<Shader> shader() const override {
    return std::make_unique<OwnShader>(*this);
  }

 private:
  class OwnShader final : public Shader {
   public:
    explicit OwnShader(const MarkedLayers& all)
        : all_(all), shader_(all.scene_, all.camera_.data(), all.view_) {}

    void shade(PolygonId polygon, std::int32_t x, std::int32_t y,
               std::uint32_t bits, LineColors& colors) override {
      if (polygon_ != polygon) {
        polygon_ = polygon;
        is_behind_ = all_.is_behind(polygon, stats_);
        shader_.start(polygon, is_behind_ ? -1 : 1);
      }
      stats_.exact += static_cast<std::uint64_t>(
          shader_.shade(x, y, bits, colors.data(), 0));
      for (; is_behind_ && bits != 0; bits &= bits - 1) {
        std::uint8_t* const at = colors.data() + 3 * std::countr_zero(bits);
        const Rgb color = marked(all_.mark_, {at[0], at[1], at[2]});
        at[0] = color.r, at[1] = color.g, at[2] = color.b;
      }
    }
    const FilterStats& stats() const override { return stats_; }

   private:
    const MarkedLayers& all_;
    GouraudShader shader_;
    PolygonId polygon_ = kBackground;
    bool is_behind_ = false;
    FilterStats stats_;
  };

  bool is_behind(PolygonId polygon, FilterStats& stats) const {
    return side_of_eye(scene_, polygon, camera_, stats) == Side::kNegative;
  }

  const Scene& scene_;
  const Camera& camera_;
  View view_;
  Rgb mark_;
  bool is_gouraud_;
};

/// A tree and what is seen of it.
struct Subject {
  const Scene& scene;
  const BspTree& tree;
  const LazyTree::State* lazy;
  const Camera& camera;
  const ImageOptions& image;
};

void make(const Subject& subject, const RenderOptions& options, Pass pass,
          Rendering& result) {
  pass.lazy = subject.lazy;
  if (pass.samples > 1) {
    result = run_samples(subject.scene, subject.tree, subject.camera,
                         subject.image, options, pass);
  } else {
    run(subject.scene, subject.tree, subject.camera, subject.image, options,
        pass, result);
  }
}

void blend_look(const Subject& subject, const Look& look,
                const RenderOptions& options, const ScalarColors* scalars,
                Rendering& result) {
  std::unique_ptr<const LayerColors> colors;
  if (scalars != nullptr) {
    colors = scalar_layers(subject.scene, subject.camera, subject.image,
                           *scalars, look.samples);
  } else if (look.mark) {
    colors = std::make_unique<MarkedLayers>(subject.scene, subject.camera,
                                            subject.image, look);
  }
  Pass pass = {Order::kBackToFront, look.alpha, look.samples};
  pass.colors = colors.get();
  make(subject, options, pass, result);
}

/// Colours come from items, which are there for them.
void color_look(const Subject& subject, const Look& look,
                const RenderOptions& options, const ScalarColors& scalars,
                Rendering& result) {
  RenderOptions own = options;
  own.items = true;
  own.colors = false;
  Pass pass;
  pass.samples = look.samples;
  // The colours' memory is used again.
  ColorImage colors = std::move(result.colors);
  make(subject, own, pass, result);
  if (options.colors) {
    result.colors = std::move(colors);
    const Rectangle part = options.rectangle.value_or(Rectangle{});
    ScalarOptions how;
    how.samples = look.samples;
    how.left = part.left;
    how.top = part.top;
    how.threads = thread_count(options.threads);
    result.decisions.add(color_scalars(subject.scene, subject.camera,
                                       subject.image, result.items, scalars,
                                       how, result.colors));
  }
  if (!options.items) result.items = {};
}

void mark_look(const Subject& subject, const Look& look,
               const RenderOptions& options, Rendering& result) {
  const std::function<void(Rendering&)> mark = [&](Rendering& part) {
    mark_back_faces(subject.scene, subject.camera, part.items, *look.mark, 1,
                    part.colors);
  };
  Pass pass;
  pass.samples = look.samples;
  if (look.samples > 1) {
    pass.retouch = &mark;
    make(subject, options, pass, result);
    return;
  }
  RenderOptions own = options;
  own.items = true;
  make(subject, own, pass, result);
  if (options.colors) {
    mark_back_faces(subject.scene, subject.camera, result.items, *look.mark,
                    thread_count(options.threads), result.colors);
  }
  if (!options.items) result.items = {};
}

void make_look(const Subject& subject, const Look& look,
               const RenderOptions& options, const ScalarColors* scalars,
               Rendering& result) {
  HALFSPACE_ASSERT(!look.mark || scalars == nullptr);
  if (look.alpha != kOpaque) {
    blend_look(subject, look, options, scalars, result);
  } else if (scalars != nullptr) {
    color_look(subject, look, options, *scalars, result);
  } else if (look.mark) {
    mark_look(subject, look, options, result);
  } else {
    Pass pass;
    pass.samples = look.samples;
    make(subject, options, pass, result);
  }
}

}  // namespace

void render_look(const Scene& scene, const BspTree& tree, const Camera& camera,
                 const ImageOptions& image, const Look& look,
                 const RenderOptions& options, const ScalarColors* scalars,
                 Rendering& result) {
  make_look({scene, tree, nullptr, camera, image}, look, options, scalars,
            result);
}

Rendering render_look(const Scene& scene, const BspTree& tree,
                      const Camera& camera, const ImageOptions& image,
                      const Look& look, const RenderOptions& options,
                      const ScalarColors* scalars) {
  Rendering result;
  render_look(scene, tree, camera, image, look, options, scalars, result);
  return result;
}

Rendering render_look(const LazyTree& tree, const Camera& camera,
                      const ImageOptions& image, const Look& look,
                      const RenderOptions& options,
                      const ScalarColors* scalars) {
  Rendering result;
  make_look(
      {tree.scene(), tree.state().root.tree, &tree.state(), camera, image},
      look, options, scalars, result);
  return result;
}

}  // namespace halfspace::fast
