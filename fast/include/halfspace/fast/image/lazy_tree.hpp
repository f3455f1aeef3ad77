#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "halfspace/camera.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/render.hpp"
#include "halfspace/image.hpp"
#include "halfspace/ray.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::fast {

/// The options of a LazyTree.
struct LazyTreeOptions {
  /// Of the cells' trees; `threads` is of the opening. Its `progress` is not
  /// called.
  DisplayTreeOptions tree;
  /// Cells are divided down to about this many polygons.
  std::size_t cell_size = 512;
  /// A cell with more polygons is divided into cells again when it is asked
  /// for.
  std::size_t most_in_cell = 16384;
  /// In how many cells a polygon may be, on average: where polygons are large
  /// cells are larger. Divisions of cells add less, each half of the one
  /// before.
  double most_listed = 1.5;
};

/// How much of a LazyTree is there.
struct LazyTreeStats {
  std::size_t cells = 0;           ///< that are known
  std::size_t cells_built = 0;     ///< of them
  std::size_t polygons_built = 0;  ///< with a part in a cell that is built
  std::size_t fragments = 0;       ///< of what is built
  std::size_t bytes = 0;           ///< in all, lists of what is not built too
  friend bool operator==(const LazyTreeStats&, const LazyTreeStats&) = default;
};

/// A display tree of which that part is built that is looked at (S3.12).
///
/// It opens with planes across axes alone, at borders of a grid that counts
/// where polygons are, and lists of the polygons that reach the cells between
/// them. The first image whose walk comes to a cell while pixels in front of
/// its box are unlit builds its tree: cuts the polygons at the cell's faces and
/// divides what is in it, as build_display_tree() does. Cells that are hidden
/// or outside the image stay lists. A ray builds the cells on its way, as far
/// as it goes.
///
/// Images (S5.3), hits (S8.3) and picks are those of every other tree, whatever
/// was built before. Several threads may make images and ask rays of one tree
/// at once: a cell is built by one of them, in its own thread, and who comes to
/// it meanwhile waits. move_to() and stats() are for one thread alone.
/// Requires: the scene outlives it, and does not change or move;
///           options.tree.leaf_size >= 1, options.tree.threads >= 0,
///           options.cell_size >= 1, options.most_in_cell >= 1,
///           1 <= options.most_listed <= 64.
/// Exact:    yes: lists are made by comparing integers, cuts as by any tree.
/// Cost:     two passes over the polygons to open; a cell n log n, once.
class LazyTree {
 public:
  explicit LazyTree(const Scene& scene, const LazyTreeOptions& options = {});
  LazyTree(LazyTree&&) noexcept;
  LazyTree& operator=(LazyTree&&) noexcept;
  ~LazyTree();

  const Scene& scene() const;

  /// Goes on with a scene in which polygons have moved, or become others
  /// (S3.13): the cells that they were in, and those that they are in now, are
  /// pending again, and built when an image or a ray asks for them.
  ///
  /// Boxes are not made smaller: where much has gone far a new tree is better.
  /// Requires: `scene` as the constructor does, and until this returns the one
  ///           before; as many polygons and vertices, on the same grid; those
  ///           that `polygons` does not name have the same corners, at the same
  ///           points. No other call at the same time.
  /// Cost:     a few ways through the tree's planes for each of `polygons`, and
  ///           the lists of the cells there; no other polygon is looked at.
  void move_to(const Scene& scene, std::span<const PolygonId> polygons);

  /// No other call at the same time. Cost: linear in what is built.
  LazyTreeStats stats() const;

  struct State;
  const State& state() const { return *state_; }

 private:
  std::unique_ptr<State> state_;
};

/// The images of the tree's scene: as those of the same names with a BspTree,
/// in render.hpp and painter.hpp, to which the options are explained. What goes
/// back to front builds all that is in the image.
Rendering render(const LazyTree& tree, const Camera& camera,
                 const ImageOptions& image, const RenderOptions& options = {});
Rendering render_samples(const LazyTree& tree, const Camera& camera,
                         const ImageOptions& image, std::int32_t samples,
                         const RenderOptions& options = {});
Rendering paint(const LazyTree& tree, const Camera& camera,
                const ImageOptions& image, const RenderOptions& options = {});
Rendering blend(const LazyTree& tree, const Camera& camera,
                const ImageOptions& image, std::uint8_t alpha,
                const RenderOptions& options = {});

/// The rays of the tree's scene, and its picks: as those of the same names with
/// a BspTree, in ray.hpp. They build what they come to.
std::optional<RayHit> first_hit(const LazyTree& tree, const Ray& ray);
std::vector<RayHit> all_hits(const LazyTree& tree, const Ray& ray);
PolygonId pick(const LazyTree& tree, const Camera& camera,
               const ImageOptions& options, std::int32_t i, std::int32_t j);
bool see_each_other(const LazyTree& tree, const Ray& between);

}  // namespace halfspace::fast
