#include "halfspace/fast/visible_map.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "halfspace/assert.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "map/assembly.hpp"
#include "map/cap_pieces.hpp"
#include "map/cell_tree.hpp"
#include "map/fragment_sides.hpp"
#include "map/line_table.hpp"
#include "map/section_map.hpp"
#include "raster/clip_set.hpp"
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

/// The cells of a map while they are lit from front to back.
class MapMaker {
 public:
  MapMaker(const Scene& scene, const BspTree& tree, const Camera& camera,
           const MapOptions& options, const ImageOptions& image,
           const MapLimits& limits)
      : tree_(tree),
        camera_(camera.data()),
        options_(options),
        image_(image),
        limits_(limits),
        reader_(scene, tree),
        view_(make_view(camera, scene.grid_bits())),
        eye_side_(reader_, view_, camera_, stats_),
        clips_(image.clips, image.caps.has_value(), scene.grid_bits()),
        lines_(reader_, camera_, image.clips),
        cells_(lines_, camera_.width_px, camera_.height_px,
               grid_depth(tree.fragments.size())),
        sides_(reader_, camera_, lines_),
        has_boxes_(tree.boxes.size() == tree.nodes.size()) {}

  Result<VisibleMap> run() {
    // What is kept is behind the planes that the eye is behind (S10, "Caps need
    // no depth order").
    light_caps(-1);
    if (!is_too_large()) {
      walk_front_to_back(
          tree_, eye_side_, [&](NodeId id) { return enter(id); },
          [&](const Node& node, int sign) { return show(node, sign); });
    }
    if (!options_.cull) light_caps(1);
    if (is_too_large()) {
      return Error{ErrorCode::kOutOfRange,
                   "the visible map has more than " +
                       std::to_string(limits_.most_cells) +
                       " cells, which is the limit"};
    }
    lines_.forget_names();
    const auto key_of = [&](PolygonId item) {
      if (item == kBackground) return kBackgroundKey;
      return options_.keys.empty()
                 ? item
                 : options_.keys[static_cast<std::size_t>(item)];
    };
    VisibleMap map = assemble(cells_, lines_, key_of);
    map.decisions = lines_.stats();
    map.decisions.add(stats_);
    return map;
  }

 private:
  bool is_too_large() const { return cells_.cell_count() > limits_.most_cells; }

  bool enter(NodeId id) {
    if (!has_boxes_) return true;
    const Box& box = tree_.boxes[static_cast<std::size_t>(id)];
    if (!clips_.empty() && clips_.classify(box).is_gone) return false;
    CellBox image;
    if (!image_of(box, view_, image)) return false;
    image = clamped(image, camera_);
    return !is_empty(image) && cells_.any_unlit(image);
  }

  bool show(const Node& node, int sign) {
    ClipMask mask = clips_.all();
    if (has_boxes_ && !clips_.empty()) {
      const auto id = static_cast<std::size_t>(&node - tree_.nodes.data());
      mask = clips_.classify(tree_.boxes[id]).mask;
    }
    return for_fragments(tree_, node, [&](const TreeFragment& fragment) {
      const int eye_sign = fragment.flipped != 0 ? -sign : sign;
      if (options_.cull && eye_sign < 0) return true;
      std::span<const HalfPlane> sides = sides_.of(fragment, eye_sign);
      if (mask != 0) {
        clipped_.assign(sides.begin(), sides.end());
        if (!clip(fragment.source, eye_sign, mask)) return true;
        sides = clipped_;
      }
      cells_.light(sides, fragment.source);
      return !is_too_large() && !cells_.full();
    });
  }

  /// Adds what the planes of the mask leave (S10.2); false for polygons that
  /// caps take away (S10.3).
  bool clip(PolygonId source, int eye_sign, ClipMask mask) {
    for (std::size_t k = 0; k < image_.clips.size(); ++k) {
      if ((mask >> k & 1) == 0) continue;
      const LineId line = lines_.meet(source, plane_id_of_clip(k));
      if (!lines_.is_zero(line)) {
        clipped_.push_back({line, eye_sign});
      } else if (image_.caps) {
        return false;
      }
    }
    return true;
  }

  /// Lights the caps of the planes that the eye is on side `side` of.
  void light_caps(int side) {
    if (!image_.caps) return;
    const auto count = reader_.scene().polygon_count();
    for (std::size_t k = 0; k < image_.clips.size(); ++k) {
      if (lines_.side_of_eye(plane_id_of_clip(k)) != side) continue;
      for (const CapPiece& piece :
           cap_pieces(reader_, view_, camera_, image_, k, side, lines_)) {
        const std::size_t hatching = piece.is_hatched ? kMostClipPlanes : 0;
        cells_.light(piece.sides, static_cast<PolygonId>(count + k + hatching));
        if (is_too_large()) return;
      }
    }
  }

  const BspTree& tree_;
  const CameraData& camera_;
  const MapOptions& options_;
  const ImageOptions& image_;
  const MapLimits& limits_;
  TreeReader reader_;
  View view_;
  FilterStats stats_;
  EyeClassifier eye_side_;
  ClipSet clips_;
  LineTable lines_;
  CellTree cells_;
  FragmentSides sides_;
  bool has_boxes_;
  std::vector<HalfPlane> clipped_;
};

}  // namespace

Result<VisibleMap> section_map(const Scene& scene, const BspTree& tree,
                               const Camera& camera, const MapOptions& options,
                               const ImageOptions& image,
                               const MapLimits& limits) {
  HALFSPACE_ASSERT(options.keys.empty() ||
                   options.keys.size() >= scene.polygon_count());
  HALFSPACE_ASSERT(!has_leaves(tree));
  return MapMaker(scene, tree, camera, options, image, limits).run();
}

Result<VisibleMap> visible_map(const Scene& scene, const BspTree& tree,
                               const Camera& camera, const MapOptions& options,
                               const MapLimits& limits) {
  HALFSPACE_ASSERT(options.keys.empty() ||
                   options.keys.size() == scene.polygon_count());
  return section_map(scene, tree, camera, options, ImageOptions(), limits);
}

}  // namespace halfspace::fast
