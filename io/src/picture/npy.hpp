#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "halfspace/result.hpp"

namespace halfspace::io {

/// What the header of an array file says.
struct NpyShape {
  std::size_t start = 0;  ///< of the values in the file. Units: bytes
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
};

/// The shape of the item image whose file begins with `bytes`.
/// Errors: those of read_npy() that the header shows.
Result<NpyShape> npy_shape(std::string_view bytes);

/// All of a file before its values.
std::string npy_header(std::int32_t width_px, std::int32_t height_px);

}  // namespace halfspace::io
