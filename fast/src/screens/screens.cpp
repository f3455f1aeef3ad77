#include "halfspace/fast/image/screens.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "halfspace/assert.hpp"
#include "map/cell_tree.hpp"
#include "map/fragment_sides.hpp"
#include "raster/caps.hpp"
#include "raster/exact_coverage.hpp"
#include "raster/sample_means.hpp"
#include "screens/line_screens.hpp"
#include "screens/square_screen.hpp"
#include "tree/traversal.hpp"

namespace halfspace::fast {
namespace {

/// What all screens of a frame read.
struct ScreenFrame {
  const TreeReader& reader;
  const CameraData& camera;
  const View& view;
  const ClipSet& clips;
};

/// The lines in which something of the fragment may be seen: those of its
/// corners and one more each way, or all where doubles do not tell.
PixelRange rows_of(const ScreenFrame& frame, const TreeFragment& fragment) {
  const View& view = frame.view;
  const std::int32_t height = frame.camera.height_px;
  double top = height;
  double bottom = 0;
  for (const Corner& corner : frame.reader.corners(fragment)) {
    const Vertex v = frame.reader.vertex(corner.vertex);
    const double t = view.t.at(v.x, v.y, v.z);
    const double t_error = 2 * (view.t_error + view.t_growth * v.error);
    double y = view.y.at(v.x, v.y, v.z);
    double doubt = 2 * (view.xy_error + view.xy_growth * v.error);
    if (view.perspective) {
      if (!(t > 4 * t_error) || !(t > 0)) return {0, height};
      y /= t;
      doubt = (doubt + std::abs(y) * t_error) / (t - t_error);
    }
    if (!(doubt < 0.5)) return {0, height};
    top = std::min(top, y);
    bottom = std::max(bottom, y);
  }
  const auto within = [height](double y) {
    return static_cast<std::int32_t>(
        std::clamp(y, 0.0, static_cast<double>(height)));
  };
  return {within(std::floor(top) - 1), within(std::ceil(bottom) + 1)};
}

/// Calls show(fragment, eye_sign) front to back, until it returns false.
template <class Show>
std::size_t show_all(const ScreenFrame& frame, bool cull, Show&& show) {
  FilterStats stats;
  std::size_t fragments = 0;
  const EyeClassifier eye_side(frame.reader, frame.view, frame.camera, stats);
  const BspTree& tree = frame.reader.tree();
  walk_front_to_back(
      tree, eye_side, [](NodeId) { return true; },
      [&](const Node& node, int sign) {
        return for_fragments(tree, node, [&](const TreeFragment& fragment) {
          const int eye_sign = fragment.flipped != 0 ? -sign : sign;
          if (cull && eye_sign < 0) return true;
          ++fragments;
          return show(fragment, eye_sign);
        });
      });
  return fragments;
}

template <int kBits, class Lines>
ScreenWork fill_lines(const ScreenFrame& frame, bool cull, Lines lines,
                      Rendering& image) {
  ExactScan<kBits> scan(frame.reader, frame.camera, frame.clips);
  image.fragments_displayed =
      show_all(frame, cull, [&](const TreeFragment& fragment, int eye_sign) {
        scan.start(fragment, eye_sign, frame.clips.all());
        const PixelRange rows = rows_of(frame, fragment);
        for (std::int32_t j = rows.first; j < rows.end; ++j) {
          if (lines.full(j)) continue;
          const PixelRange pixels = scan.line(j, {0, frame.camera.width_px});
          if (pixels.first >= pixels.end) continue;
          lines.light(j, {pixels.first, pixels.end - 1}, [&](Span lit) {
            std::fill(&image.items.at(lit.first, j),
                      &image.items.at(lit.last, j) + 1, fragment.source);
          });
        }
        return !lines.full();
      });
  return lines.work();
}

template <int kBits>
ScreenWork fill_squares(const ScreenFrame& frame, bool cull, Rendering& image) {
  ExactScan<kBits> scan(frame.reader, frame.camera, frame.clips);
  SquareScreen screen(frame.camera.width_px, frame.camera.height_px);
  image.fragments_displayed =
      show_all(frame, cull, [&](const TreeFragment& fragment, int eye_sign) {
        scan.start(fragment, eye_sign, frame.clips.all());
        screen.light(scan.lines(), rows_of(frame, fragment),
                     [&](std::int32_t j, Span lit) {
                       std::fill(&image.items.at(lit.first, j),
                                 &image.items.at(lit.last, j) + 1,
                                 fragment.source);
                     });
        return !screen.full();
      });
  return screen.work();
}

/// A line of a cell, as a function of pixels: both count half pixels.
EdgeFunction<8> function_of(const MapLine& line, std::int32_t side) {
  const auto wide = [side](const MapLine::Integer& words) {
    Wide<8> value;
    value.words = words;
    return side > 0 ? value : -value;
  };
  return {wide(line.a), wide(line.b), wide(line.c)};
}

/// Gives the pixels whose samples are in the cell its item: no sample is on a
/// line, so each is in one cell.
void fill_cell(const Cell& cell, const CellTree& cells, const LineTable& lines,
               ItemImage& items) {
  double top = 2.0 * items.height_px;
  double bottom = 0;
  std::vector<EdgeFunction<8>> sides;
  for (std::size_t k = 0; k < cell.edge_count; ++k) {
    const CellEdge& edge = cells.edges()[cell.first_edge + k];
    sides.push_back(function_of(lines.exact(edge.line), edge.side));
    const double error = double{edge.start.error};
    top = std::min(top, edge.start.y - error);
    bottom = std::max(bottom, edge.start.y + error);
  }
  // Points whose error is not finite leave all lines.
  const auto row = [&](double y, double margin) {
    if (!std::isfinite(y)) return margin < 0 ? 0 : items.height_px;
    return static_cast<std::int32_t>(std::clamp(
        std::floor(y / 2) + margin, 0.0, static_cast<double>(items.height_px)));
  };
  for (std::int32_t j = row(top, -1); j < row(bottom, 2); ++j) {
    PixelRange range = {0, items.width_px};
    for (const EdgeFunction<8>& side : sides) range = clipped(range, side, j);
    for (std::int32_t i = range.first; i < range.end; ++i)
      items.at(i, j) = cell.item;
  }
}

ScreenWork fill_cells(const ScreenFrame& frame, const ImageOptions& options,
                      Rendering& image) {
  const Rectangle all = {0, 0, frame.camera.width_px, frame.camera.height_px};
  LineTable lines(frame.reader, frame.camera, all, options.clips);
  CellTree cells(lines, all, 0);
  FragmentSides sides(frame.reader, frame.camera, lines);
  std::vector<HalfPlane> left;
  image.fragments_displayed = show_all(
      frame, options.cull, [&](const TreeFragment& fragment, int eye_sign) {
        const auto whole = sides.of(fragment, eye_sign);
        left.assign(whole.begin(), whole.end());
        if (!add_clips(frame.clips, frame.clips.all(), fragment.source,
                       eye_sign, lines, left))
          return true;
        cells.light(left, fragment.source);
        return !cells.full();
      });
  cells.for_cells([&](const Cell& cell) {
    if (cell.item != kBackground) fill_cell(cell, cells, lines, image.items);
  });
  return {cells.cell_count(), static_cast<std::size_t>(cells.node_count())};
}

}  // namespace

Rendering render_on(const Scene& scene, const BspTree& tree,
                    const Camera& camera, const ImageOptions& image,
                    ScreenKind kind, ScreenWork* work) {
  HALFSPACE_ASSERT(!has_leaves(tree));
  const CameraData& data = camera.data();
  const TreeReader reader(scene, tree);
  const View view = make_view(camera, scene.grid_bits());
  const bool has_caps = image.caps && !image.clips.empty();
  const ClipSet clips(image.clips, has_caps, scene.grid_bits());
  const ScreenFrame frame = {reader, data, view, clips};
  Rendering result;
  result.items = ItemImage(data.width_px, data.height_px, kBackground);
  const ScreenWork took = with_grid(scene.grid_bits(), [&](auto bits) {
    switch (kind) {
      case ScreenKind::kList:
        break;
      case ScreenKind::kBsp1:
        return fill_lines<bits()>(frame, image.cull,
                                  TreeLines(data.width_px, data.height_px),
                                  result);
      case ScreenKind::kQuad:
        return fill_squares<bits()>(frame, image.cull, result);
      case ScreenKind::kBsp2:
        return fill_cells(frame, image, result);
    }
    return fill_lines<bits()>(frame, image.cull,
                              ListLines(data.width_px, data.height_px), result);
  });
  if (work != nullptr) *work = took;
  result.colors = ColorImage(data.width_px, data.height_px, image.background);
  SampleMeans colors(reader, view, data, image, best_kernel(SimdLevel::kBest));
  for (std::int32_t j = 0; j < data.height_px; ++j) {
    const PolygonId* items = &result.items.at(0, j);
    for (std::int32_t i = 0; i < data.width_px; ++i)
      result.pixels_painted += items[i] == kBackground ? 0 : 1;
    colors.row(items, data.width_px, 0, data.width_px, j,
               &result.colors.at(0, j));
  }
  if (has_caps) {
    const Frame all = {reader, data, image, view, best_kernel(SimdLevel::kBest),
                       clips};
    const Rectangle whole = {0, 0, data.width_px, data.height_px};
    add_caps(all, whole, cap_changes(all, whole),
             static_cast<PolygonId>(scene.polygon_count()), result);
  }
  return result;
}

}  // namespace halfspace::fast
