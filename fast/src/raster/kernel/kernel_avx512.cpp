#include "camera/view.hpp"
#include "raster/kernel/kernel.hpp"

#if defined(__x86_64__)
// GCC 12 warns of what its own header leaves undefined.
#if !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#pragma GCC diagnostic ignored "-Wuninitialized"
#endif
#include <immintrin.h>

namespace halfspace::fast {
namespace {

#include "kernel_target.inc"
//
#include "kernel_avx512_lanes.inc"
//
#include "kernel_avx2.inc"
//
#include "kernel_avx512_colors.inc"
//
#include "kernel_avx512_flat.inc"
//
#include "kernel_avx2_flat.inc"
//
#include "kernel_avx2_shade.inc"
//
#include "kernel_avx2_blocks.inc"
//
#include "kernel_avx512_levels.inc"
//
#include "kernel.inc"
//
#include "kernel_avx2_boxes.inc"
//
#include "kernel_floats.inc"
//
#include "kernel_avx2_runs.inc"
//
#include "kernel_small.inc"

}  // namespace

const Kernel kAvx512Kernel = {
    light,    draw,      draw_lines, draw_block<3>, draw_block<4>,
    any_open, any_unlit, see_box,    leave_leaf,    fill_rest};

}  // namespace halfspace::fast
#endif
