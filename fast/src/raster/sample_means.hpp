#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "halfspace/cap_parts.hpp"
#include "halfspace/image.hpp"
#include "halfspace/polygon.hpp"
#include "raster/gouraud.hpp"
#include "raster/kernel/tile_kernel.hpp"
#include "tree/eye_classifier.hpp"

namespace halfspace::fast {

/// The colours of pixels, as means of those of their samples (S5.7).
class SampleMeans {
 public:
  /// `view` is that of the samples.
  SampleMeans(const TreeReader& reader, const View& view,
              const CameraData& camera, const ImageOptions& image,
              const TileKernel& kernel);

  /// A row of pixels, from column `left` up to `right` of row `j`; the items of
  /// their samples begin at `items`, a line every `stride`.
  void row(const PolygonId* items, std::int64_t stride, std::int32_t left,
           std::int32_t right, std::int32_t j, Rgb* colors);

  const FilterStats& stats() const { return stats_; }

 private:
  /// Polygons by their ids, of which the last bits are their places: most of
  /// those that a row of pixels shows are there for the next one.
  static constexpr std::size_t kShaded = 1024;
  struct Shaded {
    PolygonId polygon = kBackground;
    bool is_smooth = false;
    Gradient gradient;
  };

  bool is_cap(PolygonId item) const { return item >= first_cap_; }
  CapItem cap_of(PolygonId item) const {
    return cap_item(static_cast<std::size_t>(item - first_cap_));
  }
  bool is_smooth(PolygonId polygon);
  /// The colour at sample (i, j), which only caps depend on.
  Rgb flat_color(PolygonId polygon, std::int32_t i, std::int32_t j) const;
  /// Of a polygon that may have a gradient.
  const Shaded& shaded(PolygonId polygon);
  /// Of one that has: for its gradient, and to be asked for what is exact.
  GouraudShader& shader_of(PolygonId polygon);
  GouraudShader& exact_shader_of(PolygonId polygon);
  template <std::int32_t kSamples>
  void fill_row(const PolygonId* items, std::int64_t stride, std::int32_t left,
                std::int32_t right, std::int32_t j, Rgb* colors);
  /// Where nothing is shaded smoothly.
  template <std::int32_t kSamples>
  Rgb flat_mean(const PolygonId* items, std::int64_t stride, std::int32_t i,
                std::int32_t j) const;
  /// Of a pixel that sees one smooth polygon, and of any other; nothing where
  /// that does not decide.
  template <std::int32_t kSamples>
  std::optional<Rgb> full_mean(const Gradient& gradient, std::int32_t i,
                               std::int32_t j);
  /// Writes the colours of pixels that see one smooth polygon, of `most` at
  /// most, and returns how many there are.
  template <std::int32_t kSamples>
  std::int32_t fill_run(const PolygonId* items, std::int64_t stride,
                        std::int32_t most, std::int32_t i, std::int32_t j,
                        Rgb* colors);
  template <std::int32_t kSamples>
  std::optional<Rgb> mixed_mean(const PolygonId* items, std::int64_t stride,
                                std::int32_t i, std::int32_t j);
  /// Of some parts and of the sums of other channels.
  template <std::int32_t kSamples>
  std::optional<Rgb> mean_of(std::span<const MeanPart> parts,
                             const std::array<std::int32_t, 4>& whole,
                             std::int32_t i, std::int32_t j) const;
  template <std::int32_t kSamples>
  Rgb smooth_mean(const PolygonId* items, std::int64_t stride, std::int32_t i,
                  std::int32_t j);
  template <class Visit>
  void for_samples(const PolygonId* items, std::int64_t stride,
                   const Visit& visit) const;
  double close_sum(std::size_t channel, const PolygonId* items,
                   std::int64_t stride, std::int32_t i, std::int32_t j);
  std::uint8_t exact_mean(std::size_t channel, const PolygonId* items,
                          std::int64_t stride, std::int32_t i, std::int32_t j);

  const TreeReader& reader_;
  const ImageOptions& image_;
  const TileKernel& kernel_;
  std::int32_t samples_;
  bool gouraud_;
  FilterStats stats_;
  EyeClassifier eye_side_;
  std::vector<Shaded> shaded_;
  std::array<MeanPart, 64> parts_;  ///< of a pixel
  GouraudShader shader_;
  PolygonId shader_polygon_ = kBackground;
  std::array<PolygonId, 8> exact_polygons_;  ///< those that were asked last
  std::vector<GouraudShader> exact_shaders_;
  std::size_t next_exact_ = 0;
  PolygonId first_cap_;
  PolygonId last_ = kBackground;  ///< of one colour, which is:
  Rgb last_color_;
};

}  // namespace halfspace::fast
