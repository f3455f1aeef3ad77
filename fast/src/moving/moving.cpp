#include "halfspace/fast/image/moving.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "base/parallel.hpp"
#include "halfspace/assert.hpp"
#include "moving/object_painter.hpp"
#include "raster/bands.hpp"
#include "raster/caps.hpp"
#include "sah/cell_tree.hpp"

namespace halfspace::fast {
namespace {

struct MovingBand {
  std::size_t pixels = 0;
  std::size_t fragments = 0;
  std::size_t tiles = 0;
  FilterStats stats;
};

template <int kBits>
MovingBand render_moving_band(const MovingFrame& all, const Frame& world,
                              TileBuffer& buffer) {
  TileView& screen = buffer.view();
  PolygonRasterizer<kBits> rasterizer(world, screen);
  ObjectPainter objects(all, buffer);
  objects.set_world(rasterizer);
  FilterStats stats;
  show_front_to_back(
      world, buffer, rasterizer, stats,
      ObjectPainter::cell(all.trees.models[0], [&](std::int32_t object) {
        objects.show(0, object);
      }));
  const std::int64_t unlit = rasterizer.fill_rest(all.image.background);
  const std::int64_t area =
      std::int64_t{screen.columns.end - screen.columns.first} *
      (screen.lines.end - screen.lines.first);
  const std::size_t fragments = rasterizer.fragments() + objects.fragments();
  stats.add(rasterizer.stats());
  stats.add(objects.stats());
  return {static_cast<std::size_t>(area - unlit), fragments,
          static_cast<std::size_t>(screen.touches), stats};
}

/// Where the winding numbers of all that is there change in the clip planes.
CapChanges cap_changes_of(const MovingFrame& all, const Frame& world,
                          const Rectangle& rectangle) {
  CapChanges changes = cap_changes(world, rectangle);
  std::map<std::int32_t, TreeReader> readers;
  const auto& occurrences = all.assembly.occurrences();
  for (std::size_t o = 1; o < occurrences.size(); ++o) {
    const auto& map = all.placement.to_world()[o];
    const std::int32_t model = occurrences[o].model;
    const Scene& scene = all.assembly.model(model).scene;
    if (!map || scene.polygon_count() == 0) continue;
    const TreeReader& reader =
        readers
            .try_emplace(model, scene,
                         all.trees.models[static_cast<std::size_t>(model)].tree)
            .first->second;
    const MovedCamera camera = moved_camera(all.camera, *map);
    const Frame frame = {reader,     all.camera,
                         all.image,  world.view,
                         all.kernel, all.clips,
                         kOpaque,    nullptr,
                         &camera,    occurrences[o].first_polygon};
    add_object_changes(frame, rectangle, changes);
  }
  for (auto& own : changes) std::sort(own.begin(), own.end());
  return changes;
}

std::optional<Error> fault_of_cells(const KeptCells& cells,
                                    std::int32_t model) {
  const std::string of_model = " of model " + std::to_string(model);
  if (const auto object = cells.locked()) {
    return Error{ErrorCode::kOutOfRange,
                 "the region of object " + std::to_string(*object) + of_model +
                     " is interlocked with others: every plane between two "
                     "of them cuts a third; move one of them",
                 *object};
  }
  if (!cells.filled() || cells.cuts()) return std::nullopt;
  const auto [object, polygon] = *cells.filled();
  return Error{ErrorCode::kOutOfRange,
               "the region of object " + std::to_string(object) + of_model +
                   " is not free: polygon " + std::to_string(polygon) +
                   " reaches into it; move it, or ask to cut",
               polygon};
}

}  // namespace

Result<ModelTree> build_model_tree(const Assembly& assembly, std::int32_t index,
                                   InRegion in_region,
                                   const DisplayTreeOptions& options) {
  const Model& model = assembly.model(index);
  KeptCells cells(model.objects, in_region == InRegion::kCut);
  FilterStats stats;
  KeptTree built = build_cell_tree(model.scene, cells, options, stats);
  if (const auto fault = fault_of_cells(cells, index)) return *fault;
  ModelTree tree;
  tree.object_at.assign(model.objects.empty() ? 0 : built.tree.nodes.size(),
                        -1);
  for (std::size_t k = 0; k < built.node_of_object.size(); ++k) {
    const NodeId node = built.node_of_object[k];
    if (node == kNoNode)
      return Error{ErrorCode::kStopped, "the build of trees was stopped"};
    tree.object_at[static_cast<std::size_t>(node)] =
        static_cast<std::int32_t>(k);
  }
  tree.tree = std::move(built.tree);
  return tree;
}

Result<MovingTrees> build_moving_trees(const Assembly& assembly,
                                       InRegion in_region,
                                       const DisplayTreeOptions& options) {
  MovingTrees trees;
  for (std::size_t m = 0; m < assembly.models().size(); ++m) {
    Result<ModelTree> tree = build_model_tree(
        assembly, static_cast<std::int32_t>(m), in_region, options);
    if (!tree) return tree.error();
    trees.models.push_back(*std::move(tree));
  }
  return trees;
}

Rendering render_moving(const Assembly& assembly, const MovingTrees& trees,
                        const Placement& placement, const Camera& camera,
                        const ImageOptions& image,
                        const RenderOptions& options) {
  HALFSPACE_ASSERT(options.threads >= 0);
  const int threads = thread_count(options.threads);
  const CameraData& data = camera.data();
  const Rectangle rectangle = options.rectangle.value_or(
      Rectangle{0, 0, data.width_px, data.height_px});
  const std::int32_t width = rectangle.right - rectangle.left;
  const std::int32_t height = rectangle.bottom - rectangle.top;
  Rendering result;
  // Caps are put where nothing else is seen, or what is behind them.
  const bool has_caps = image.caps && !image.clips.empty();
  if (options.items || has_caps) resize_image(result.items, width, height);
  if (options.colors) resize_image(result.colors, width, height);
  const Scene& scene = assembly.models()[0].scene;
  const TreeReader reader(scene, trees.models[0].tree);
  const View view = make_view(camera, scene.grid_bits());
  const ClipSet clips(image.clips, image.caps.has_value(), scene.grid_bits());
  const TileKernel& kernel = best_kernel(options.simd);
  const MovingFrame all = {assembly, trees,  placement, data,
                           image,    kernel, clips};
  const Frame world = {reader, data, image, view, kernel, clips};
  const std::vector<PixelRange> bands = bands_of(rectangle, threads);
  std::vector<MovingBand> found(bands.size());
  const auto one = [&](std::size_t b) {
    TileBuffer buffer(rectangle, bands[b], result, true);
    found[b] = with_grid(scene.grid_bits(), [&](auto bits) {
      return render_moving_band<bits()>(all, world, buffer);
    });
  };
  if (threads == 1) {
    one(0);
  } else {
    for_bands(bands.size(), threads, one);
  }
  if (has_caps) {
    add_caps(world, rectangle, cap_changes_of(all, world, rectangle),
             static_cast<PolygonId>(assembly.polygon_count()), result);
    if (!options.items) result.items = {};
  }
  for (const MovingBand& band : found) {
    result.pixels_painted += band.pixels;
    result.fragments_displayed += band.fragments;
    result.tiles_touched += band.tiles;
    result.decisions.add(band.stats);
  }
  return result;
}

std::size_t bytes_of(const MovingTrees& trees) {
  std::size_t bytes = 0;
  for (const ModelTree& model : trees.models) {
    bytes += bytes_of(model.tree) +
             model.object_at.capacity() * sizeof(model.object_at[0]);
  }
  return bytes;
}

}  // namespace halfspace::fast
