#include <algorithm>
#include <optional>
#include <utility>

#include "cli/outputs.hpp"
#include "halfspace/assert.hpp"
#include "halfspace/fast/area_image.hpp"
#include "halfspace/fast/build.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/drawing.hpp"
#include "halfspace/fast/image/behind.hpp"
#include "halfspace/fast/image/depth_sort.hpp"
#include "halfspace/fast/image/lazy_tree.hpp"
#include "halfspace/fast/image/screens.hpp"
#include "halfspace/fast/painter.hpp"
#include "halfspace/fast/render.hpp"
#include "halfspace/fast/shade/back_faces.hpp"
#include "halfspace/fast/shade/lines.hpp"
#include "halfspace/fast/shade/look.hpp"
#include "halfspace/fast/shade/scalars.hpp"
#include "halfspace/fast/tree_file.hpp"
#include "image/engine.hpp"

namespace halfspace::tools {
namespace {

class FastEngine : public Engine {
 public:
  bool build(const Scene& scene, const TreeRequest& request) override {
    if (request.rule) {
      tree_ = fast::build(scene, *request.rule);
      return true;
    }
    bool stopped = false;
    fast::DisplayTreeOptions options;
    options.threads = request.threads;
    if (request.lazy) {
      fast::LazyTreeOptions lazy;
      lazy.tree = options;
      lazy_.emplace(scene, lazy);
      return true;
    }
    if (!request.leaves) options.leaf_size = kDividedLeaf;
    options.progress = [&](double share) {
      stopped = stopped || !request.progress(share);
      return !stopped;
    };
    tree_ = fast::build_display_tree(scene, options);
    if (stopped) return false;
    if (!request.leaves) fast::divide_leaves(tree_, scene);
    return true;
  }

  TreeStats stats() const override { return fast::stats(tree_); }
  std::size_t tree_bytes() const override {
    return lazy_ ? lazy_->stats().bytes : fast::bytes_of(tree_);
  }
  std::optional<BuiltCells> built_cells() const override {
    if (!lazy_) return std::nullopt;
    const fast::LazyTreeStats built = lazy_->stats();
    return BuiltCells{built.cells, built.cells_built, built.polygons_built,
                      built.fragments, built.bytes};
  }
  bool has_tree_files() const override { return true; }

  Result<Done> save_tree(const std::string& path,
                         const Scene& scene) const override {
    const std::vector<std::byte> bytes = fast::encode_tree(tree_, scene);
    return write_output(
        path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }

  Result<Done> load_tree(const std::string& path, const Scene& scene,
                         bool leaves) override {
    Result<fast::BspTree> tree = fast::load_tree(path, scene);
    if (!tree) return tree.error();
    tree_ = *std::move(tree);
    if (!leaves) fast::divide_leaves(tree_, scene);
    return Done{};
  }

  // The z-buffer and ray casting are there to be believed, not to be quick.
  bool has(Method method) const override { return needs_tree(method); }

  Picture render(const Scene& scene, const Camera& camera,
                 const Shot& shot) const override {
    HALFSPACE_ASSERT(has(shot.method));
    fast::RenderOptions how;
    how.threads = shot.threads;
    how.simd = shot.simd;
    if (shot.rows) {
      how.rectangle = {0, shot.rows->first, camera->width_px, shot.rows->end};
    }
    how.items = shot.items;
    Picture picture;
    fast::Rendering image;
    if (shot.priority == Priority::kDepthSort) {
      const fast::DepthSort sort = fast::depth_sort(scene, camera);
      picture.listed = sort.list.fragments.size();
      picture.moves = sort.moves;
      picture.cuts = sort.cuts;
      image = image_of(scene, sort.list, camera, shot, how);
    } else if (lazy_) {
      image = image_of(*lazy_, camera, shot, how);
    } else {
      image = image_of(scene, tree_, camera, shot, how);
    }
    if (!is_of_look(shot)) color(scene, camera, shot, image);
    picture.items = std::move(image.items);
    picture.colors = std::move(image.colors);
    picture.pixels_painted = image.pixels_painted;
    picture.fragments_displayed = image.fragments_displayed;
    picture.tiles_touched = image.tiles_touched;
    picture.exact_decisions = image.decisions.exact;
    return picture;
  }

  void set_scalars(const Scene& scene, ScalarField field,
                   ColorScale scale) override {
    scalars_ = fast::prepare_scalars(scene, std::move(field), std::move(scale));
  }

  Behind count_behind(const Scene& scene, const Camera& camera) const override {
    const auto count = fast::count_behind(scene, tree_, camera);
    return {count.subtrees, count.fragments};
  }

  Picture render_area(const Scene& scene, const Camera& camera,
                      const Shot& shot) const override {
    fast::AreaImage image =
        fast::render_area(scene, tree_, camera, shot.options, shot.threads);
    Picture picture;
    picture.exact_pixels = image.exact_pixels;
    picture.pixels_painted =
        image.colors.pixels.size() -
        static_cast<std::size_t>(std::count(image.colors.pixels.begin(),
                                            image.colors.pixels.end(),
                                            shot.options.background));
    picture.colors = std::move(image.colors);
    if (shot.items) {
      fast::RenderOptions how;
      how.threads = shot.threads;
      how.colors = false;
      picture.items =
          fast::render(scene, tree_, camera, shot.options, how).items;
    }
    return picture;
  }

  Result<Done> add_lines(const Scene& scene, const Camera& camera,
                         const Shot& shot, const DrawingOptions& drawing,
                         const LineStyle& style,
                         ColorImage& image) const override {
    const auto drawn = fast::draw(scene, camera, drawing);
    if (!drawn) return drawn.error();
    fast::LineOptions how;
    how.samples = line_samples_of(shot.anti_aliasing);
    how.top = shot.rows ? shot.rows->first : 0;
    fast::add_lines(*drawn, style, how, image);
    return Done{};
  }

  std::string warning(std::size_t) const override { return {}; }

 private:
  const fast::ScalarColors* scalars_of(const Shot& shot) const {
    return shot.by_scalars ? &scalars_ : nullptr;
  }

  fast::Rendering image_of(const Scene& scene, const fast::BspTree& tree,
                           const Camera& camera, const Shot& shot,
                           const fast::RenderOptions& how) const {
    if (is_of_look(shot)) {
      return fast::render_look(scene, tree, camera, shot.options, look_of(shot),
                               how, scalars_of(shot));
    }
    if (shot.screen)
      return fast::render_on(scene, tree, camera, shot.options, *shot.screen);
    return fast::paint(scene, tree, camera, shot.options, how);
  }

  fast::Rendering image_of(const fast::LazyTree& tree, const Camera& camera,
                           const Shot& shot,
                           const fast::RenderOptions& how) const {
    HALFSPACE_ASSERT(!shot.screen);
    if (is_of_look(shot)) {
      return fast::render_look(tree, camera, shot.options, look_of(shot), how,
                               scalars_of(shot));
    }
    return fast::paint(tree, camera, shot.options, how);
  }

  /// The colours that an image of opaque items has in place of the scene's.
  void color(const Scene& scene, const Camera& camera, const Shot& shot,
             fast::Rendering& image) const {
    if (shot.by_scalars) {
      fast::ScalarOptions how;
      how.top = shot.rows ? shot.rows->first : 0;
      how.threads = shot.threads;
      image.colors = fast::color_scalars(scene, camera, shot.options,
                                         image.items, scalars_, how);
    }
    if (shot.mark) {
      fast::mark_back_faces(scene, camera, image.items, *shot.mark,
                            shot.threads, image.colors);
    }
  }

  fast::BspTree tree_;
  std::optional<fast::LazyTree> lazy_;  ///< instead of that
  fast::ScalarColors scalars_;
};

}  // namespace

std::unique_ptr<Engine> make_fast_engine() {
  return std::make_unique<FastEngine>();
}

}  // namespace halfspace::tools
