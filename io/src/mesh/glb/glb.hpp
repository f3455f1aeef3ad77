#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace halfspace::io {

/// Of a GLB (glTF 2.0, sec. 4.4): its first word, and its chunks' types.
inline constexpr std::uint32_t kGlbMagic = 0x46546C67;
inline constexpr std::uint32_t kGlbJson = 0x4E4F534A;
inline constexpr std::uint32_t kGlbBytes = 0x004E4942;
inline constexpr std::size_t kGlbHeader = 12;
inline constexpr std::size_t kGlbChunkHeader = 8;

/// Types of an accessor's numbers.
inline constexpr int kGlbInt8 = 5120, kGlbUint8 = 5121, kGlbInt16 = 5122,
                     kGlbUint16 = 5123, kGlbUint32 = 5125, kGlbFloat = 5126;

/// Colours of a glTF are linear, those of other files sRGB (IEC 61966-2-1).
inline double linear_of(double share) {
  return share <= 0.04045 ? share / 12.92
                          : std::pow((share + 0.055) / 1.055, 2.4);
}
inline double share_of_linear(double linear) {
  return linear <= 0.0031308 ? linear * 12.92
                             : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

}  // namespace halfspace::io
