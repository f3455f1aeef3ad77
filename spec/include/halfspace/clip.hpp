#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "halfspace/int128.hpp"
#include "halfspace/polygon.hpp"
#include "halfspace/result.hpp"

namespace halfspace {

/// What is kept of a scene: where a x + b y + c z + d >= 0 (S10.1). Units: grid
/// steps.
struct ClipPlane {
  Int128 a = 0;
  Int128 b = 0;
  Int128 c = 0;
  Int128 d = 0;
  friend bool operator==(const ClipPlane&, const ClipPlane&) = default;
};

/// An image has at most this many different clip planes.
constexpr std::size_t kMostClipPlanes = 8;

/// How caps look (S10.4).
struct CapStyle {
  Rgb color = {200, 80, 40};
  std::optional<Rgb> hatch = std::nullopt;  ///< of lines over the colour
  friend bool operator==(const CapStyle&, const CapStyle&) = default;
};

/// The parts of a closed scene, whose caps are told apart (S10.6). Each part is
/// closed by itself.
struct CapParts {
  std::vector<std::uint32_t> part_of;  ///< by polygon
  /// How the caps of each part look, and last those where several parts are.
  std::vector<CapStyle> styles;
  std::size_t count() const { return styles.size() - 1; }
  friend bool operator==(const CapParts&, const CapParts&) = default;
};

/// The colour of the cap of clip plane `plane` at pixel (i, j) (S10.4).
constexpr Rgb cap_color(const CapStyle& style, std::size_t plane,
                        std::int32_t i, std::int32_t j) {
  // 2^20 is a multiple of 8 beyond any row.
  const std::int32_t across = plane % 2 == 0 ? i + j : i - j + (1 << 20);
  return style.hatch && across % 8 < 2 ? *style.hatch : style.color;
}

/// The planes without factors that their four numbers share, each once, in the
/// order in which they first come.
///
/// Errors: kZeroArea (a normal that is zero); kOutOfRange (a number beyond the
///         budget of S10.1; more than eight different planes), with the plane's
///         index.
Result<std::vector<ClipPlane>> make_clips(const std::vector<ClipPlane>& planes,
                                          int grid_bits);

}  // namespace halfspace
