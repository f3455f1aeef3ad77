#pragma once

#include <algorithm>
#include <cstdint>

#include "raster/kernel/tile_kernel.hpp"

namespace halfspace::fast {

/// What kernels ask, for tests: each overrides what it is about. No polygon is
/// nearer, and no line covered.
struct NoFallback : ExactFallback {
  void fetch(std::uint32_t) const override {}
  PixelSource begin(std::int32_t, std::int32_t) override { return {}; }
  PixelRange exact_line(std::int32_t, PixelRange) override { return {0, 0}; }
  void nearer(std::int32_t, std::int32_t, std::int32_t,
              std::uint32_t* lit) override {
    std::fill_n(lit, kTileHeight, 0u);
  }
  const Gradient& gradient() override {
    static constexpr Gradient kNothing{};
    return kNothing;
  }
  void shade(const PixelSource&, std::int32_t, std::int32_t, std::uint32_t,
             std::uint8_t*, std::int64_t) override {}
  void blend(std::int32_t, std::int32_t, const std::uint32_t*) override {}
};

}  // namespace halfspace::fast
