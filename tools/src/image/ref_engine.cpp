#include <algorithm>
#include <utility>

#include "halfspace/assert.hpp"
#include "halfspace/ref/area_image.hpp"
#include "halfspace/ref/build.hpp"
#include "halfspace/ref/depth_sort.hpp"
#include "halfspace/ref/drawing.hpp"
#include "halfspace/ref/lines.hpp"
#include "halfspace/ref/oracle/look.hpp"
#include "halfspace/ref/oracle/painter.hpp"
#include "halfspace/ref/oracle/raycast.hpp"
#include "halfspace/ref/oracle/zbuffer.hpp"
#include "halfspace/ref/render.hpp"
#include "halfspace/ref/scalars.hpp"
#include "halfspace/ref/screens.hpp"
#include "halfspace/ref/shade.hpp"
#include "image/engine.hpp"

namespace halfspace::tools {
namespace {

/// From here on the reference takes more than a moment.
constexpr std::size_t kManyPolygons = 2000;

class RefEngine : public Engine {
 public:
  // The reference knows no threads, no leaves, and nothing of the time.
  bool build(const Scene& scene, const TreeRequest& request) override {
    tree_ = ref::build(scene, request.rule.value_or(BuildOptions{}));
    return true;
  }

  TreeStats stats() const override { return ref::stats(tree_); }
  std::size_t tree_bytes() const override { return 0; }
  bool has_tree_files() const override { return false; }

  Result<Done> save_tree(const std::string&, const Scene&) const override {
    HALFSPACE_ASSERT(has_tree_files());
    return Done{};
  }
  Result<Done> load_tree(const std::string&, const Scene&, bool) override {
    HALFSPACE_ASSERT(has_tree_files());
    return Done{};
  }

  bool has(Method) const override { return true; }

  void set_scalars(const Scene&, ScalarField field, ColorScale scale) override {
    field_ = std::move(field);
    scale_ = std::move(scale);
  }

  Picture render(const Scene& scene, const Camera& camera,
                 const Shot& shot) const override {
    if (!shot.rows) return whole(scene, camera, shot);
    // Stripes of caps go by the pixels of the whole (S10.4).
    if (shot.options.caps)
      return rows_of(whole(scene, camera, shot), *shot.rows);
    CameraData data = camera.data();
    const Int128 first = shot.rows->first;
    data.s0 = {data.s0.x + first * data.sy.x, data.s0.y + first * data.sy.y,
               data.s0.z + first * data.sy.z};
    data.height_px = shot.rows->end - shot.rows->first;
    const Result<Camera> moved = make_camera(data, scene.grid_bits());
    if (moved) return whole(scene, *moved, shot);
    // The corner of the rows is off the lattice.
    return rows_of(whole(scene, camera, shot), *shot.rows);
  }

  // The reference shows every fragment: nothing is left out.
  Behind count_behind(const Scene&, const Camera&) const override { return {}; }

  Picture render_area(const Scene& scene, const Camera& camera,
                      const Shot& shot) const override {
    Picture picture;
    picture.colors = ref::render_area(scene, camera, shot.options);
    picture.pixels_painted = picture.colors.pixels.size();
    if (shot.items)
      picture.items = ref::render(scene, tree_, camera, shot.options).items;
    return picture;
  }

  Result<Done> add_lines(const Scene& scene, const Camera& camera,
                         const Shot& shot, const DrawingOptions& drawing,
                         const LineStyle& style,
                         ColorImage& image) const override {
    ColorImage all(camera->width_px, camera->height_px, Rgb{});
    const Rows rows = shot.rows.value_or(Rows{0, camera->height_px});
    const auto first = std::ptrdiff_t{rows.first} * all.width_px;
    std::copy(image.pixels.begin(), image.pixels.end(),
              all.pixels.begin() + first);
    ref::add_lines(ref::draw(scene, camera, drawing), style,
                   line_samples_of(shot.anti_aliasing), all);
    image = rows_of(all, rows);
    return Done{};
  }

  std::string warning(std::size_t polygons) const override {
    if (polygons < kManyPolygons) return {};
    return "the exact reference works on " + std::to_string(polygons) +
           " polygons in rational numbers; this can take long";
  }

 private:
  Picture whole(const Scene& scene, const Camera& camera,
                const Shot& shot) const {
    Picture picture;
    ref::Rendering image;
    if (shot.priority == Priority::kDepthSort && needs_tree(shot.method)) {
      const ref::DepthSort sort = ref::depth_sort(scene, camera);
      picture.listed = sort.list.nodes.size();
      picture.moves = sort.moves;
      picture.cuts = sort.cuts;
      image = image_of(scene, sort.list, camera, shot);
    } else {
      image = image_of(scene, tree_, camera, shot);
    }
    if (!is_of_look(shot)) color(scene, camera, shot, image);
    picture.items = std::move(image.items);
    picture.colors = std::move(image.colors);
    picture.pixels_painted = image.pixels_painted;
    picture.fragments_displayed = image.fragments_displayed;
    return picture;
  }

  ref::Rendering image_of(const Scene& scene, const ref::BspTree& tree,
                          const Camera& camera, const Shot& shot) const {
    const ImageOptions& options = shot.options;
    if (is_of_look(shot)) {
      return shot.by_scalars ? ref::render_look(scene, tree, camera, options,
                                                look_of(shot), field_, scale_)
                             : ref::render_look(scene, tree, camera, options,
                                                look_of(shot));
    }
    switch (shot.method) {
      case Method::kSpan:
        break;
      case Method::kPainter:
        return ref::paint(scene, tree, camera, options);
      case Method::kZBuffer:
        return ref::zbuffer(scene, camera, options);
      case Method::kRayCast:
        return ref::raycast(scene, camera, options);
    }
    return ref::render_on(scene, tree, camera, options, *shot.screen);
  }

  /// The colours that an image of opaque items has in place of the scene's.
  void color(const Scene& scene, const Camera& camera, const Shot& shot,
             ref::Rendering& image) const {
    if (shot.by_scalars) {
      image.colors = ref::color_scalars(scene, camera, shot.options,
                                        image.items, field_, scale_);
    }
    if (shot.mark) {
      ref::mark_back_faces(scene, camera, image.items, *shot.mark,
                           image.colors);
    }
  }

  ref::BspTree tree_;
  ScalarField field_;
  ColorScale scale_;
};

}  // namespace

std::unique_ptr<Engine> make_ref_engine() {
  return std::make_unique<RefEngine>();
}

}  // namespace halfspace::tools
