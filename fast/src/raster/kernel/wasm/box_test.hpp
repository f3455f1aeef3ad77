#pragma once

#include <wasm_simd128.h>

#include <cstddef>
#include <cstdint>

#include "raster/kernel/tile_kernel.hpp"

namespace halfspace::fast {

/// Boxes of subtrees, against the tiles that are lit: x86/box_test.hpp in
/// halves, each the four corners at one end along z.
template <class Base>
struct WasmBoxTest : Base {
  using Base::any_unlit;
  using typename Base::Floats8;

  static BoxVisibility box_visibility(const TileView& screen,
                                      const BoxView& view, const Box& box) {
    const float lx = box.low[0], hx = box.high[0];
    const float ly = box.low[1], hy = box.high[1];
    const v128_t vx = wasm_f32x4_make(lx, hx, lx, hx);
    const v128_t vy = wasm_f32x4_make(ly, ly, hy, hy);
    const auto at_corners = [&](const float* f) {
      const v128_t xy =
          wasm_f32x4_add(wasm_f32x4_mul(wasm_f32x4_splat(f[0]), vx),
                         wasm_f32x4_mul(wasm_f32x4_splat(f[1]), vy));
      const auto half = [&](float z) {
        return wasm_f32x4_add(xy, wasm_f32x4_splat(f[2] * z + f[3]));
      };
      return Floats8{{half(box.low[2]), half(box.high[2])}};
    };
    const Floats8 t = at_corners(view.t);
    if (Base::bits_of(Base::floats8(view.least) < t) != 255)
      return BoxVisibility::kUnknown;
    const Floats8 reciprocal = Base::floats8(1) / t;
    const Floats8 x = at_corners(view.x) * reciprocal;
    const Floats8 y = at_corners(view.y) * reciprocal;
    const auto least = [](const Floats8& v) {
      return extreme(wasm_f32x4_pmin(v.low, v.high), wasm_f32x4_pmin);
    };
    const auto most = [](const Floats8& v) {
      return extreme(wasm_f32x4_pmax(v.low, v.high), wasm_f32x4_pmax);
    };
    const PixelRange columns = range_of(least(x), most(x), screen.columns);
    const PixelRange lines = range_of(least(y), most(y), screen.lines);
    if (columns.first >= columns.end || lines.first >= lines.end)
      return BoxVisibility::kHidden;
    return any_unlit(screen, columns, lines) ? BoxVisibility::kVisible
                                             : BoxVisibility::kHidden;
  }

 private:
  /// The least or the greatest of four.
  template <class Of>
  static float extreme(v128_t v, Of of) {
    v = of(v, wasm_i32x4_shuffle(v, v, 2, 3, 0, 1));
    v = of(v, wasm_i32x4_shuffle(v, v, 1, 0, 3, 2));
    return wasm_f32x4_extract_lane(v, 0);
  }

  /// The pixels between, six tenths of one added at either end, of those in
  /// `limits`.
  static PixelRange range_of(float least, float most, PixelRange limits) {
    const auto first = static_cast<float>(limits.first);
    const auto end = static_cast<float>(limits.end);
    const float from = __builtin_ceilf(least - 0.6f);
    const float to = __builtin_floorf(most + 0.6f);
    return {static_cast<std::int32_t>(from > first ? from : first),
            static_cast<std::int32_t>(to < end ? to : end)};
  }
};

}  // namespace halfspace::fast
