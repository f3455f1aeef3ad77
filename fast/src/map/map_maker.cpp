#include "map/map_maker.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <string>

#include "halfspace/assert.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "map/assembly.hpp"
#include "map/cap_pieces.hpp"

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

MapMaker::MapMaker(const Scene& scene, const BspTree& tree,
                   const Camera& camera, const ImageOptions& image)
    : tree_(tree),
      data_(camera.data()),
      image_(image),
      reader_(scene, tree),
      view_(make_view(camera, scene.grid_bits())),
      eye_side_(reader_, view_, data_, stats_),
      clips_(image_.clips, image_.caps.has_value(), scene.grid_bits()),
      lines_(reader_, data_, image_.clips),
      cells_(lines_, data_.width_px, data_.height_px,
             grid_depth(tree.fragments.size())),
      sides_(reader_, data_, lines_) {
  HALFSPACE_ASSERT(!has_leaves(tree));
}

bool MapMaker::image_box(NodeId id, CellBox& image) const {
  if (!image_of(tree_.boxes[static_cast<std::size_t>(id)], view_, image))
    return false;
  image = clamped(image, data_);
  return !is_empty(image);
}

void MapMaker::light_caps(int side, const MapLimits& limits) {
  if (!image_.caps) return;
  const auto count = static_cast<PolygonId>(reader_.scene().polygon_count());
  for (std::size_t k = 0; k < image_.clips.size(); ++k) {
    if (lines_.side_of_eye(plane_id_of_clip(k)) != side) continue;
    for (const CapPiece& piece :
         cap_pieces(reader_, view_, data_, image_, k, side, lines_)) {
      cells_.light(piece.sides, count + number_of(piece.cap));
      too_many_ = too_many_ || cells_.cell_count() > limits.most_cells;
      if (too_many_) return;
    }
  }
}

Result<VisibleMap> MapMaker::finish(
    const MapLimits& limits,
    const std::function<std::int32_t(PolygonId)>& key_of) {
  if (too_many_) {
    return Error{ErrorCode::kOutOfRange, "the visible map has more than " +
                                             std::to_string(limits.most_cells) +
                                             " cells, which is the limit"};
  }
  lines_.forget_names();
  VisibleMap map = assemble(cells_, lines_, key_of);
  map.decisions = lines_.stats();
  map.decisions.add(stats_);
  return map;
}

}  // namespace halfspace::fast
