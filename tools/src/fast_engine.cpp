#include <utility>

#include "engine.hpp"
#include "halfspace/assert.hpp"
#include "halfspace/fast/build.hpp"
#include "halfspace/fast/painter.hpp"
#include "halfspace/fast/render.hpp"

namespace halfspace::tools {
namespace {

class FastEngine : public Engine {
 public:
  // The papers' rules build one node after another.
  void build(const Scene& scene, const BuildOptions& options, int) override {
    tree_ = fast::build(scene, options);
  }

  TreeStats stats() const override { return fast::stats(tree_); }

  // The z-buffer and ray casting are there to be believed, not to be quick.
  bool has(Method method) const override { return needs_tree(method); }

  Picture render(const Scene& scene, const Camera& camera,
                 const ImageOptions& options, Method method,
                 int threads) const override {
    HALFSPACE_ASSERT(has(method));
    fast::RenderOptions how;
    how.threads = threads;
    fast::Rendering image =
        method == Method::kSpan
            ? fast::render(scene, tree_, camera, options, how)
            : fast::paint(scene, tree_, camera, options, how);
    return {std::move(image.items), std::move(image.colors),
            image.pixels_painted, image.fragments_displayed};
  }

  bool has_booleans() const override { return false; }

  BooleanResult boolean(BooleanOp, const Solid&, const Solid&,
                        const BuildOptions&) const override {
    HALFSPACE_ASSERT(has_booleans());
    return {};
  }

  std::string warning(std::size_t) const override { return {}; }

 private:
  fast::BspTree tree_;
};

}  // namespace

std::unique_ptr<Engine> make_fast_engine() {
  return std::make_unique<FastEngine>();
}

}  // namespace halfspace::tools
