#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "halfspace/clip.hpp"
#include "halfspace/image.hpp"
#include "halfspace/scene.hpp"

namespace halfspace {

/// The cap of a clip plane that an item of an image or a key of a map names by
/// how far it is beyond those of polygons (S10.5, S10.6).
struct CapItem {
  std::size_t plane = 0;
  /// The part whose cap it is, or how many there are where it is that of
  /// several; 0 where parts are not told apart.
  std::size_t part = 0;
  bool is_hatched = false;  ///< of a map: whether it is in a stripe
};

constexpr CapItem cap_item(std::size_t beyond) {
  return {beyond % kMostClipPlanes, beyond / (2 * kMostClipPlanes),
          beyond / kMostClipPlanes % 2 == 1};
}
constexpr std::int32_t number_of(const CapItem& cap) {
  return static_cast<std::int32_t>(
      (2 * cap.part + (cap.is_hatched ? 1 : 0)) * kMostClipPlanes + cap.plane);
}

/// How many numbers of caps there may be.
inline std::size_t cap_item_count(const ImageOptions& options) {
  if (!options.caps) return 0;
  const std::size_t looks = options.parts ? options.parts->styles.size() : 1;
  return 2 * kMostClipPlanes * looks;
}

/// How a cap looks. Requires: options.caps.
inline const CapStyle& style_of(const ImageOptions& options,
                                const CapItem& cap) {
  return options.parts ? options.parts->styles[cap.part] : *options.caps;
}

/// The colour of a cap in a stripe of its hatching, or outside.
inline Rgb color_of(const ImageOptions& options, const CapItem& cap) {
  const CapStyle& style = style_of(options, cap);
  return cap.is_hatched ? style.hatch.value_or(style.color) : style.color;
}

/// Where the stripes of a cap's hatching are (S10.4, S10.6): two pixels of
/// every so many, by the sum or the difference of coordinates, or both.
struct CapStripes {
  bool by_sum = true;
  bool by_difference = false;
  std::int32_t period = 8;
};

inline CapStripes stripes_of(const ImageOptions& options, const CapItem& cap) {
  if (options.parts && cap.part == options.parts->count())
    return {true, true, 8};
  const bool by_sum = (cap.plane + cap.part) % 2 == 0;
  return {by_sum, !by_sum, cap.part % 4 < 2 ? 8 : 16};
}

/// The colour of a cap at sample (i, j) of all, so many a pixel each way
/// (S10.4).
inline Rgb cap_color_at_sample(const ImageOptions& options, const CapItem& cap,
                               std::int32_t i, std::int32_t j,
                               std::int32_t samples) {
  const CapStyle& style = style_of(options, cap);
  if (!style.hatch) return style.color;
  const CapStripes stripes = stripes_of(options, cap);
  // The functions of the stripes in halves of samples, where a pixel has
  // 2 samples of them; 2^20 pixels are a multiple of 16 beyond any row.
  const std::int64_t pixel = std::int64_t{2} * samples;
  const std::int64_t start = pixel << 20;
  const auto is_in = [&](std::int64_t across) {
    return across % (stripes.period * pixel) < 2 * pixel;
  };
  const std::int64_t x = std::int64_t{2} * i;
  const std::int64_t y = std::int64_t{2} * j;
  const bool is_hatched =
      (stripes.by_sum && is_in(start + x + y + 2 - samples)) ||
      (stripes.by_difference && is_in(start + x - y + samples));
  return is_hatched ? *style.hatch : style.color;
}

/// By polygon the connected part of the surface that it is in: polygons with a
/// point of a corner in common are in one. Numbered by their first polygons.
///
/// Cost: that of sorting the points.
std::vector<std::uint32_t> connected_parts(const Scene& scene);

/// Whether each part is closed by itself (S6.1).
///
/// Requires: the part of every polygon.
/// Cost:     that of sorting the edges.
bool are_parts_closed(const Scene& scene,
                      const std::vector<std::uint32_t>& part_of);

/// Parts whose caps have colours of their own, which are told apart also by the
/// colour-blind, with the lines of `several`, if it has any; `several` is how
/// the caps look where several parts are.
std::shared_ptr<const CapParts> told_apart(std::vector<std::uint32_t> part_of,
                                           const CapStyle& several);

}  // namespace halfspace
