#include "halfspace/fast/scan.hpp"
#include "raster/polygon_rasterizer.hpp"
#include "raster/tile_buffer.hpp"

namespace halfspace::fast {
namespace {

/// A fragment of a tree as the only one of another.
BspTree tree_of(const Scene& scene, const BspTree& tree,
                const TreeFragment& fragment) {
  const auto points = static_cast<std::int32_t>(scene.data().vertices.size());
  const auto polygons = static_cast<PlaneId>(scene.polygon_count());
  BspTree result;
  result.slanted = tree.slanted;
  for (std::uint32_t k = 0; k < fragment.corner_count; ++k) {
    Corner corner = tree.corners[fragment.first_corner + k];
    if (corner.vertex >= points) {
      const auto cut = static_cast<std::size_t>(corner.vertex - points);
      corner.vertex =
          points + static_cast<std::int32_t>(result.cut_vertices.size());
      result.cut_vertices.push_back(tree.cut_vertices[cut]);
    }
    const PlaneId plane = -1 - corner.edge;
    if (corner.edge < 0 && plane >= polygons) {
      corner.edge =
          -1 - polygons - static_cast<PlaneId>(result.free_planes.size());
      result.free_planes.push_back(
          tree.free_planes[static_cast<std::size_t>(plane - polygons)]);
    }
    result.corners.push_back(corner);
  }
  result.fragments.push_back(fragment);
  result.fragments[0].first_corner = 0;
  return result;
}

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

/// The segments of the tree's only fragment.
std::vector<ObjectSegment> segments_of(const Scene& scene, const BspTree& tree,
                                       const Camera& camera, FilterStats& stats,
                                       SimdLevel simd) {
  const CameraData& data = camera.data();
  const PolygonId source = tree.fragments[0].source;
  const Side side = side_of_eye(scene, source, camera, stats);
  if (side == Side::kOn) return {};
  const TreeReader reader(scene, tree);
  const View view = make_view(camera, scene.grid_bits());
  const ImageOptions options;
  const ClipSet clips(options.clips, false, scene.grid_bits());
  const Frame frame = {reader, data, options, view, best_kernel(simd), clips};
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
  return segments_of(image.items, source);
}

}  // namespace

std::vector<ObjectSegment> scan_convert(const Scene& scene,
                                        const Fragment& fragment,
                                        const Camera& camera,
                                        FilterStats& stats, SimdLevel simd) {
  return segments_of(scene, tree_of(scene, fragment), camera, stats, simd);
}

std::vector<ObjectSegment> scan_convert(const Scene& scene, const BspTree& tree,
                                        const TreeFragment& fragment,
                                        const Camera& camera,
                                        FilterStats& stats) {
  return segments_of(scene, tree_of(scene, tree, fragment), camera, stats,
                     SimdLevel::kBest);
}

}  // namespace halfspace::fast
