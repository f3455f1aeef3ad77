#include "halfspace/fast/scan.hpp"
#include "raster/polygon_rasterizer.hpp"
#include "raster/tile_buffer.hpp"

namespace halfspace::fast {
namespace {

/// The fragment as the only one of a tree.
BspTree tree_of(const Scene& scene, const Fragment& fragment) {
  BspTree tree;
  const auto points = static_cast<std::int32_t>(scene.data().vertices.size());
  for (std::size_t k = 0; k < fragment.edges.size(); ++k) {
    tree.corners.push_back(
        {code_of(fragment.edges[k]), points + static_cast<std::int32_t>(k)});
    tree.cut_vertices.push_back(fragment.vertices[k]);
  }
  TreeFragment only;
  only.source = fragment.source;
  only.corner_count = static_cast<std::uint32_t>(fragment.edges.size()) &
                      kMostCornersOfFragment;
  tree.fragments.push_back(only);
  return tree;
}

/// The runs of pixels that show the polygon.
std::vector<ObjectSegment> segments_of(const ItemImage& items, PolygonId id) {
  std::vector<ObjectSegment> segments;
  for (std::int32_t j = 0; j < items.height_px; ++j) {
    for (std::int32_t i = 0; i < items.width_px; ++i) {
      if (items.at(i, j) != id) continue;
      const std::int32_t first = i;
      while (i + 1 < items.width_px && items.at(i + 1, j) == id) ++i;
      segments.push_back({j, {first, i}});
    }
  }
  return segments;
}

}  // namespace

std::vector<ObjectSegment> scan_convert(const Scene& scene,
                                        const Fragment& fragment,
                                        const Camera& camera,
                                        FilterStats& stats, SimdLevel simd) {
  const CameraData& data = camera.data();
  const Side side = side_of_eye(scene, fragment.source, camera, stats);
  if (side == Side::kOn) return {};
  const BspTree tree = tree_of(scene, fragment);
  const TreeReader reader(scene, tree);
  const View view = make_view(camera, scene.grid_bits());
  const ImageOptions options;
  const Frame frame = {reader, data, options, view, best_kernel(simd)};
  Rendering image;
  image.items = ItemImage(data.width_px, data.height_px, kBackground);
  TileBuffer buffer({0, 0, data.width_px, data.height_px}, {0, data.height_px},
                    image, false);
  buffer.view().overwrite = true;
  with_grid(scene.grid_bits(), [&](auto bits) {
    PolygonRasterizer<bits()> rasterizer(frame, buffer.view());
    rasterizer.draw(tree.fragments[0], static_cast<int>(side));
    stats.add(rasterizer.stats());
  });
  return segments_of(image.items, fragment.source);
}

}  // namespace halfspace::fast
