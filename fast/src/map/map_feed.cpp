#include "map/map_feed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

/// The rectangle, with a margin for rounding, within the part.
CellBox clamped(const CellBox& box, const CellBox& part) {
  constexpr double kMargin = 0.125;
  return {std::clamp(box.left - kMargin, part.left, part.right),
          std::clamp(box.top - kMargin, part.top, part.bottom),
          std::clamp(box.right + kMargin, part.left, part.right),
          std::clamp(box.bottom + kMargin, part.top, part.bottom)};
}

bool is_empty(const CellBox& box) {
  return !(box.left < box.right) || !(box.top < box.bottom);
}

}  // namespace

MapFeed::MapFeed(const Scene& scene, const BspTree& tree, const Camera& camera,
                 const ImageOptions& image, const Rectangle& part)
    : tree_(tree),
      data_(camera.data()),
      image_(image),
      part_{2.0 * part.left, 2.0 * part.top, 2.0 * part.right,
            2.0 * part.bottom},
      reader_(scene, tree),
      view_(make_view(camera, scene.grid_bits())),
      eye_side_(reader_, view_, data_, stats_),
      clips_(image_.clips, image_.caps.has_value(), scene.grid_bits()),
      lines_(reader_, data_, part, image_.clips),
      sides_(reader_, data_, lines_) {}

bool MapFeed::image_box(NodeId id, CellBox& image) const {
  if (!image_of(tree_.boxes[static_cast<std::size_t>(id)], view_, image))
    return false;
  image = clamped(image, part_);
  return !is_empty(image);
}

}  // namespace halfspace::fast
