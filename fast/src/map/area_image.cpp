#include "halfspace/fast/area_image.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <unordered_map>

#include "halfspace/assert.hpp"
#include "halfspace/cap_parts.hpp"
#include "map/arc_pieces.hpp"
#include "map/exact_moments.hpp"
#include "raster/gouraud.hpp"
#include "tree/eye_classifier.hpp"

namespace halfspace::fast {
namespace {

/// What is seen of a key in a pixel, as ArcPiece.
struct Share {
  std::int32_t key = kBackgroundKey;
  double area = 0;
  double x = 0;
  double y = 0;
};

/// The heights of the parts of a column's right side on which a key is seen.
struct Crossing {
  std::int32_t key = kBackgroundKey;
  double rise = 0;
  double rise_y = 0;
};

using Channels = std::array<double, 3>;

class AreaPainter {
 public:
  AreaPainter(const Scene& scene, const BspTree& tree, const Camera& camera,
              const ImageOptions& image, bool smooth, const VisibleMap& map,
              AreaImage& result)
      : scene_(scene),
        image_(image),
        smooth_(smooth),
        map_(map),
        result_(result),
        reader_(scene, tree),
        view_(make_view(camera, scene.grid_bits())),
        eye_side_(reader_, view_, camera.data(), stats_),
        shader_(scene, camera.data(), view_) {
    for (const MapRegion& region : map.regions)
      item_of_.emplace(region.key, region.item);
    result.colors =
        ColorImage(camera->width_px, camera->height_px, image.background);
  }

  void run() {
    const ArcPieces pieces = cut_along_pixels(map_, result_.colors.width_px,
                                              result_.colors.height_px);
    // A vertex is off by half a step of doubles and of the lattice of heights,
    // a point between by some of these: 2^-50 of the image's size and 2^-43
    // bound that. An arc that is off by d changes the area beside it by d times
    // its length, which is below 2 in a pixel: so 16 d for an arc and what is
    // rounded. It does so where it passes, or in a pixel next to that.
    const double off = 0x1p-43 + 0x1p-50 * std::max(result_.colors.width_px,
                                                    result_.colors.height_px);
    doubt_ = 16 * off * 9 * static_cast<double>(pieces.most);
    for (std::int32_t row = 0; row < result_.colors.height_px; ++row) {
      const auto r = static_cast<std::size_t>(row);
      paint_row(row, {pieces.pieces.data() + pieces.first[r],
                      pieces.pieces.data() + pieces.first[r + 1]});
    }
  }

 private:
  void paint_row(std::int32_t row, std::span<const ArcPiece> pieces) {
    crossings_.clear();
    std::int32_t next = 0;
    for (std::size_t first = 0; first < pieces.size();) {
      std::size_t end = first;
      const std::int32_t column = pieces[first].column;
      while (end < pieces.size() && pieces[end].column == column) ++end;
      fill(next, column, row);
      mix(column, row, pieces.subspan(first, end - first));
      next = column + 1;
      first = end;
    }
    fill(next, result_.colors.width_px, row);
  }

  /// Pixels that one key has all of.
  void fill(std::int32_t from, std::int32_t end, std::int32_t row) {
    if (from >= end) return;
    HALFSPACE_ASSERT(crossings_.size() == 1);
    const std::int32_t key = crossings_[0].key;
    const PolygonId item = item_of(key);
    if (!is_smooth(item)) {
      std::fill(&result_.colors.at(from, row),
                &result_.colors.at(from, row) + (end - from), flat_color(item));
      return;
    }
    start(item);
    for (std::int32_t x = from; x < end; x += 32) {
      const int count = std::min(end - x, 32);
      std::uint8_t bytes[96];
      shader_.shade(x, row, ~std::uint32_t{0} >> (32 - count), bytes, 0);
      for (int k = 0; k < count; ++k) {
        result_.colors.at(x + k, row) = {bytes[3 * k], bytes[3 * k + 1],
                                         bytes[3 * k + 2]};
      }
    }
  }

  void mix(std::int32_t column, std::int32_t row,
           std::span<const ArcPiece> pieces) {
    shares_.clear();
    for (const Crossing& c : crossings_)
      shares_.push_back({c.key, c.rise, c.rise / 2, c.rise_y});
    for (const ArcPiece& piece : pieces) {
      for (const bool gains : {true, false}) {
        const std::int32_t region = gains ? piece.gains : piece.loses;
        if (region < 0) continue;
        const std::int32_t key =
            map_.regions[static_cast<std::size_t>(region)].key;
        const double s = gains ? 1 : -1;
        Share& share = find(shares_, key);
        share.area += s * piece.area;
        share.x += s * piece.area_x;
        share.y += s * piece.area_y;
        Crossing& crossing = find(crossings_, key);
        crossing.rise += s * piece.rise;
        crossing.rise_y += s * piece.rise_y;
      }
    }
    std::erase_if(crossings_, [](const Crossing& c) { return c.rise == 0; });
    Channels sum = {};
    double doubt = 256 * doubt_;
    for (const Share& share : shares_) add(share, column, row, sum, doubt);
    Rgb color;
    bool exact = false;
    for (std::size_t c = 0; c < 3; ++c) {
      const double level = std::floor(sum[c] + 0.5);
      const double above = sum[c] + 0.5 - level;
      exact |= !(above > doubt && above < 1 - doubt);
      channel(color, c) = static_cast<std::uint8_t>(level);
    }
    if (exact) {
      ++result_.exact_pixels;
      color = exact_color(column, row);
    }
    result_.colors.at(column, row) = color;
  }

  template <class Keyed>
  static Keyed& find(std::vector<Keyed>& list, std::int32_t key) {
    for (Keyed& entry : list) {
      if (entry.key == key) return entry;
    }
    return list.emplace_back(Keyed{key});
  }
  static std::uint8_t& channel(Rgb& color, std::size_t c) {
    return c == 0 ? color.r : c == 1 ? color.g : color.b;
  }

  /// Adds what a key gives to a pixel's colour.
  ///
  /// A smooth colour is between 0 and 256, so that of an area too small to have
  /// a sure centroid is in doubt by so much. Else the centroid is off by
  /// 4 e / area, and the quotient of affine functions by that times its slopes.
  void add(const Share& share, std::int32_t column, std::int32_t row,
           Channels& sum, double& doubt) {
    const PolygonId item = item_of(share.key);
    if (!is_smooth(item)) {
      Rgb color = flat_color(item);
      for (std::size_t c = 0; c < 3; ++c)
        sum[c] += share.area * channel(color, c);
      return;
    }
    if (share.area < 16 * doubt_) {
      doubt += 256 * (std::abs(share.area) + doubt_);
      return;
    }
    start(item);
    const Gradient& g = shader_.gradient();
    const double u = column + share.x / share.area - 0.5;
    const double v = row + share.y / share.area - 0.5;
    const double off = 4 * doubt_ / share.area;
    const double total = g.a[3] * u + (g.b[3] * v + g.c[3]);
    const double slope = std::abs(g.a[3]) + std::abs(g.b[3]);
    const double least = total - slope * off - g.doubt;
    if (!(least > 0)) {
      doubt = 1;
      return;
    }
    double steepest = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      sum[c] += share.area * ((g.a[c] * u + (g.b[c] * v + g.c[c])) / total);
      steepest =
          std::max(steepest, std::abs(g.a[c]) + std::abs(g.b[c]) + 256 * slope);
    }
    doubt += share.area * (steepest * off + g.doubt) / least + 256 * doubt_;
  }

  Rgb exact_color(std::int32_t column, std::int32_t row) {
    std::array<BigRational, 3> sum = {0, 0, 0};
    for (const auto& [key, seen] : exact_moments(map_, column, row)) {
      if (seen.area == 0) continue;
      const PolygonId item = item_of(key);
      if (!is_smooth(item)) {
        Rgb color = flat_color(item);
        for (std::size_t c = 0; c < 3; ++c)
          sum[c] += seen.area * int{channel(color, c)};
        continue;
      }
      start(item);
      const BigRational x = 2 * (column + seen.x / seen.area);
      const BigRational y = 2 * (row + seen.y / seen.area);
      for (std::size_t c = 0; c < 3; ++c)
        sum[c] += seen.area * shader_.exact_value_at(c, x, y);
    }
    return {rounded_channel(sum[0]), rounded_channel(sum[1]),
            rounded_channel(sum[2])};
  }

  void start(PolygonId item) {
    if (item == started_) return;
    started_ = item;
    shader_.start(item, eye_side_(reader_.planes().plane(item), item));
  }
  PolygonId item_of(std::int32_t key) const { return item_of_.at(key); }
  bool is_smooth(PolygonId item) const {
    return smooth_ && item != kBackground && !is_cap(item) &&
           has_gradient(scene_, item);
  }
  bool is_cap(PolygonId item) const {
    return item >= static_cast<PolygonId>(scene_.polygon_count());
  }
  Rgb flat_color(PolygonId item) const {
    if (item == kBackground) return image_.background;
    if (is_cap(item)) {
      return color_of(image_, cap_item(static_cast<std::size_t>(item) -
                                       scene_.polygon_count()));
    }
    return smooth_ ? scene_.corner_colors(item)[0] : scene_.color(item);
  }

  const Scene& scene_;
  const ImageOptions& image_;
  bool smooth_;
  const VisibleMap& map_;
  AreaImage& result_;
  TreeReader reader_;
  View view_;
  FilterStats stats_;
  EyeClassifier eye_side_;
  GouraudShader shader_;
  PolygonId started_ = kBackground;
  std::unordered_map<std::int32_t, PolygonId> item_of_;
  double doubt_ = 0;
  std::vector<Crossing> crossings_;
  std::vector<Share> shares_;
};

/// Polygons of one colour have one key; smooth ones their own.
MapOptions keys_of(const Scene& scene, const ImageOptions& image, bool smooth) {
  MapOptions options;
  options.cull = image.cull;
  if (smooth) return options;
  std::map<Rgb, std::int32_t> numbers;
  for (const Rgb& color : scene.data().colors) {
    const auto next = static_cast<std::int32_t>(numbers.size());
    options.keys.push_back(numbers.try_emplace(color, next).first->second);
  }
  if (!image.caps || image.clips.empty()) return options;
  for (std::size_t k = 0; k < cap_item_count(image); ++k) {
    const auto next = static_cast<std::int32_t>(numbers.size());
    const Rgb color = color_of(image, cap_item(k));
    options.keys.push_back(numbers.try_emplace(color, next).first->second);
  }
  return options;
}

}  // namespace

Result<AreaImage> render_area(const Scene& scene, const BspTree& tree,
                              const Camera& camera, const ImageOptions& image,
                              const MapLimits& limits) {
  const bool smooth =
      image.shading == Shading::kGouraud && !scene.data().corner_colors.empty();
  const Result<VisibleMap> map = section_map(
      scene, tree, camera, keys_of(scene, image, smooth), image, limits);
  if (!map) return map.error();
  AreaImage result;
  result.cells = map->cells;
  result.arcs = map->arcs.size();
  AreaPainter(scene, tree, camera, image, smooth, *map, result).run();
  return result;
}

}  // namespace halfspace::fast
