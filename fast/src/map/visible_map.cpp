#include "halfspace/fast/visible_map.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "halfspace/assert.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "map/assembly.hpp"
#include "map/cell_tree.hpp"
#include "map/fragment_sides.hpp"
#include "map/line_table.hpp"
#include "tree/traversal.hpp"

namespace halfspace::fast {
namespace {

/// A rectangle that holds the image of a box; false if it cannot be seen.
///
/// With e and f the errors of X and Y and of t, X / t is off by at most
/// (e + |X / t| f) / (t - f), and by rounding; twice that bounds all of it,
/// since t is beyond 2^20 f where it divides.
bool image_of(const Box& box, const View& view, CellBox& image) {
  const double infinite = std::numeric_limits<double>::infinity();
  image = {infinite, infinite, -infinite, -infinite};
  bool any_in_front = false;
  bool reaches_eye = false;
  for (int k = 0; k < 8; ++k) {
    const double x = double{(k & 1) != 0 ? box.high[0] : box.low[0]};
    const double y = double{(k & 2) != 0 ? box.high[1] : box.low[1]};
    const double z = double{(k & 4) != 0 ? box.high[2] : box.low[2]};
    const double t = view.t.at(x, y, z);
    any_in_front |= t > view.near - view.t_error;
    if (view.perspective && !(t > view.t_error * 0x1p20)) {
      reaches_eye = true;
      continue;
    }
    const double w = view.perspective ? t : 1;
    const double u = 2 * view.x.at(x, y, z) / w;
    const double v = 2 * view.y.at(x, y, z) / w;
    const double t_error = view.perspective ? view.t_error : 0;
    const auto doubt = [&](double value) {
      return 4 * (view.xy_error + std::abs(value) * t_error) / w +
             8 * kRounding * std::abs(value);
    };
    image = {std::min(image.left, u - doubt(u)),
             std::min(image.top, v - doubt(v)),
             std::max(image.right, u + doubt(u)),
             std::max(image.bottom, v + doubt(v))};
  }
  if (reaches_eye) image = {-infinite, -infinite, infinite, infinite};
  return any_in_front;
}

/// How often the image is halved beforehand, so that a cell meets few
/// fragments if they are small.
int grid_depth(std::size_t fragments) {
  constexpr int kMostHalvings = 14;
  return std::clamp(static_cast<int>(std::bit_width(fragments)) - 4, 0,
                    kMostHalvings);
}

/// The rectangle, with a margin for rounding, within the image.
CellBox clamped(const CellBox& box, const CameraData& camera) {
  constexpr double kMargin = 0.125;
  const auto within = [](double value, std::int32_t size) {
    return std::clamp(value, 0.0, 2.0 * size);
  };
  return {within(box.left - kMargin, camera.width_px),
          within(box.top - kMargin, camera.height_px),
          within(box.right + kMargin, camera.width_px),
          within(box.bottom + kMargin, camera.height_px)};
}

bool is_empty(const CellBox& box) {
  return !(box.left < box.right) || !(box.top < box.bottom);
}

}  // namespace

Result<VisibleMap> visible_map(const Scene& scene, const BspTree& tree,
                               const Camera& camera, const MapOptions& options,
                               const MapLimits& limits) {
  HALFSPACE_ASSERT(options.keys.empty() ||
                   options.keys.size() == scene.polygon_count());
  HALFSPACE_ASSERT(!has_leaves(tree));
  const CameraData& data = camera.data();
  const TreeReader reader(scene, tree);
  const View view = make_view(camera, scene.grid_bits());
  FilterStats stats;
  const EyeClassifier eye_side(reader, view, data, stats);
  LineTable lines(reader, data);
  CellTree cells(lines, data.width_px, data.height_px,
                 grid_depth(tree.fragments.size()));
  FragmentSides sides(reader, data, lines);
  const bool has_boxes = tree.boxes.size() == tree.nodes.size();
  const auto enter = [&](NodeId id) {
    if (!has_boxes) return true;
    CellBox image;
    if (!image_of(tree.boxes[static_cast<std::size_t>(id)], view, image))
      return false;
    image = clamped(image, data);
    return !is_empty(image) && cells.any_unlit(image);
  };
  bool too_many = false;
  const auto show = [&](const Node& node, int sign) {
    return for_fragments(tree, node, [&](const TreeFragment& fragment) {
      const int eye_sign = fragment.flipped != 0 ? -sign : sign;
      if (options.cull && eye_sign < 0) return true;
      cells.light(sides.of(fragment, eye_sign), fragment.source);
      too_many = cells.cell_count() > limits.most_cells;
      return !too_many && !cells.full();
    });
  };
  walk_front_to_back(tree, eye_side, enter, show);
  if (too_many) {
    return Error{ErrorCode::kOutOfRange, "the visible map has more than " +
                                             std::to_string(limits.most_cells) +
                                             " cells, which is the limit"};
  }
  lines.forget_names();
  const auto key_of = [&](PolygonId item) {
    if (item == kBackground) return kBackgroundKey;
    return options.keys.empty() ? item
                                : options.keys[static_cast<std::size_t>(item)];
  };
  VisibleMap map = assemble(cells, lines, key_of);
  map.decisions = lines.stats();
  map.decisions.add(stats);
  return map;
}

}  // namespace halfspace::fast
