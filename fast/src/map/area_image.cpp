#include "halfspace/fast/area_image.hpp"

#include <algorithm>
#include <array>
#include <climits>
#include <cmath>

#include "base/parallel.hpp"
#include "halfspace/assert.hpp"
#include "halfspace/cap_parts.hpp"
#include "map/exact_moments.hpp"
#include "map/map_maker.hpp"
#include "map/pixel_cells.hpp"
#include "raster/bands.hpp"
#include "raster/gouraud.hpp"

namespace halfspace::fast {
namespace {

using Channels = std::array<double, 3>;

class AreaPainter : public PixelSink {
 public:
  AreaPainter(const Scene& scene, const BspTree& tree, const Camera& camera,
              const ImageOptions& image, PixelRange rows, ColorImage& colors)
      : scene_(scene),
        tree_(tree),
        camera_(camera),
        image_(image),
        smooth_(image.shading == Shading::kGouraud &&
                !scene.data().corner_colors.empty()),
        colors_(colors),
        feed_(scene, tree, camera, image,
              {0, rows.first, camera->width_px, rows.end}),
        cells_(camera->width_px, rows.first, rows.end, *this),
        shader_(scene, camera.data(), feed_.view()) {}

  void run() {
    const auto light = [&](std::span<const HalfPlane> sides, PolygonId item) {
      if (lines_of(sides)) cells_.light(sides_, item);
      return !cells_.full();
    };
    // As MapMaker::light_all().
    feed_.run_caps(-1, light);
    if (!cells_.full()) {
      feed_.run(
          image_.cull,
          [&](const CellBox& box) { return cells_.any_unlit(box); }, light);
    }
    if (!image_.cull && !cells_.full()) feed_.run_caps(1, light);
    cells_.finish();
  }

  std::size_t exact_pixels() const { return exact_pixels_; }

  void fill(PolygonId item, std::int32_t row, std::int32_t from,
            std::int32_t end) override {
    if (!is_smooth(item)) {
      std::fill_n(&colors_.at(from, row), end - from, flat_color(item));
      return;
    }
    start(item);
    for (std::int32_t x = from; x < end; x += 32) {
      const std::uint32_t bits =
          ~std::uint32_t{0} >> (32 - std::min(end - x, 32));
      static_assert(sizeof(Rgb) == 3);
      shader_.shade(x, row, bits,
                    reinterpret_cast<std::uint8_t*>(&colors_.at(x, row)), 0);
    }
  }

  void mix(std::int32_t column, std::int32_t row,
           std::span<const PixelShare> shares, double error) override {
    Channels sum = {};
    Channels doubt;
    doubt.fill(256 * error + 0x1p-40);
    for (const PixelShare& share : shares)
      add(share, column, row, error, sum, doubt);
    Rgb color;
    bool exact = false;
    for (std::size_t c = 0; c < 3; ++c) {
      const int level = static_cast<int>(sum[c] + 0.5);
      const double above = sum[c] + 0.5 - level;
      exact |= !(above > doubt[c] && above < 1 - doubt[c]);
      channel(color, c) = static_cast<std::uint8_t>(level);
    }
    if (exact) {
      ++exact_pixels_;
      color = exact_color(column, row);
    }
    colors_.at(column, row) = color;
  }

 private:
  /// The lines of a polygon's sides; false if it has no area in the image.
  bool lines_of(std::span<const HalfPlane> sides) {
    sides_.clear();
    const LineTable& lines = feed_.lines();
    for (const HalfPlane& side : sides) {
      if (lines.is_zero(side.line)) return false;
      sides_.push_back(line_of(side.line, side.side));
    }
    return true;
  }
  PixelLine line_of(LineId line, double scale) {
    const LineTable& lines = feed_.lines();
    return {2 * scale * lines.slope_x(line), 2 * scale * lines.slope_y(line),
            scale * lines.offset(line)};
  }

  static std::uint8_t& channel(Rgb& color, std::size_t c) {
    return c == 0 ? color.r : c == 1 ? color.g : color.b;
  }

  /// Adds what an item gives to a pixel's colour.
  ///
  /// With its area and integrals off by e, a centroid is off by 2 e / area
  /// along either axis. A mean of the corners' colours is off by their range
  /// times twice what that and rounding add to the weights, of their sum. Where
  /// that is not small the colour is one between the corners'.
  void add(const PixelShare& share, std::int32_t column, std::int32_t row,
           double error, Channels& sum, Channels& doubt) {
    const PolygonId item = share.item;
    if (!is_smooth(item)) {
      Rgb color = flat_color(item);
      for (std::size_t c = 0; c < 3; ++c)
        sum[c] += share.area * channel(color, c);
      return;
    }
    const double x = column + share.x / share.area;
    const double y = row + share.y / share.area;
    const Weights& weights = weights_of(item);
    const auto colors = scene_.corner_colors(item);
    Channels mean = {};
    double total = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const PixelLine& line = weights.lines[k];
      const double weight = line.a * x + (line.b * y + line.c);
      total += weight;
      Rgb color = colors[k];
      for (std::size_t c = 0; c < 3; ++c) mean[c] += weight * channel(color, c);
    }
    const double off = weights.slopes * 2 * error / share.area +
                       weights.scales * cells_.line_error();
    const bool is_sure = total > 4 * off;
    const double part = is_sure ? 2 * off / (total - off) : 1;
    for (std::size_t c = 0; c < 3; ++c) {
      sum[c] += share.area * (is_sure ? mean[c] / total : weights.least[c]);
      doubt[c] +=
          share.area * (weights.range[c] * part + 0x1p-40) + 256 * error;
    }
  }

  /// The functions of S5.4 of a triangle's corners, of one scale: those of the
  /// edges opposite.
  struct Weights {
    std::array<PixelLine, 3> lines;
    double slopes = 0;  ///< the sizes of all `a` and `b`
    double scales = 0;  ///< the sum of the lines' scales
    Channels least = {};
    Channels range = {};  ///< of the corners' colours
  };
  const Weights& weights_of(PolygonId item) {
    if (item == weighed_) return weights_;
    weighed_ = item;
    const int eye_sign =
        feed_.eye_side()(feed_.reader().planes().plane(item), item);
    LineTable& lines = feed_.lines();
    const auto corners = scene_.corners(item);
    std::array<LineId, 3> edges{};
    std::array<int, 3> signs{};
    int highest = INT_MIN;
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId p = corners[(k + 1) % 3];
      const VertexId q = corners[(k + 2) % 3];
      edges[k] = p < q ? lines.edge(p, q) : lines.edge(q, p);
      signs[k] = p < q ? eye_sign : -eye_sign;
      highest = std::max(highest, lines.exponent(edges[k]));
    }
    weights_.slopes = weights_.scales = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double scale = std::ldexp(1.0, lines.exponent(edges[k]) - highest);
      const PixelLine line = line_of(edges[k], signs[k] * scale);
      weights_.lines[k] = line;
      weights_.slopes += std::abs(line.a) + std::abs(line.b);
      weights_.scales += scale;
    }
    for (std::size_t c = 0; c < 3; ++c) {
      double least = 255;
      double most = 0;
      for (Rgb color : scene_.corner_colors(item)) {
        least = std::min<double>(least, channel(color, c));
        most = std::max<double>(most, channel(color, c));
      }
      weights_.least[c] = least;
      weights_.range[c] = most - least;
    }
    return weights_;
  }

  /// From the map of the pixel.
  Rgb exact_color(std::int32_t column, std::int32_t row) {
    MapMaker maker(scene_, tree_, camera_, image_,
                   {column, row, column + 1, row + 1});
    maker.light_all(image_.cull, {});
    HALFSPACE_ASSERT(!maker.has_too_many());
    const VisibleMap map = maker.finish([](PolygonId item) {
      return item == kBackground ? kBackgroundKey : item;
    });
    std::array<BigRational, 3> sum = {0, 0, 0};
    for (const auto& [key, seen] : exact_moments(map, column, row)) {
      if (seen.area == 0) continue;
      const PolygonId item = key == kBackgroundKey ? kBackground : key;
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
    shader_.start(item,
                  feed_.eye_side()(feed_.reader().planes().plane(item), item));
  }
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
  const BspTree& tree_;
  const Camera& camera_;
  const ImageOptions& image_;
  bool smooth_;
  ColorImage& colors_;
  std::size_t exact_pixels_ = 0;
  MapFeed feed_;
  PixelCells cells_;
  GouraudShader shader_;
  PolygonId started_ = kBackground;
  Weights weights_;
  PolygonId weighed_ = kBackground;
  std::vector<PixelLine> sides_;
};

}  // namespace

AreaImage render_area(const Scene& scene, const BspTree& tree,
                      const Camera& camera, const ImageOptions& image,
                      int threads) {
  AreaImage result;
  result.colors =
      ColorImage(camera->width_px, camera->height_px, image.background);
  threads = thread_count(threads);
  const std::vector<PixelRange> bands =
      bands_of({0, 0, camera->width_px, camera->height_px}, threads);
  std::vector<std::size_t> exact(bands.size());
  for_bands(bands.size(), threads, [&](std::size_t b) {
    AreaPainter painter(scene, tree, camera, image, bands[b], result.colors);
    painter.run();
    exact[b] = painter.exact_pixels();
  });
  for (const std::size_t count : exact) result.exact_pixels += count;
  return result;
}

}  // namespace halfspace::fast
