#include "raster/kernel/tile_kernel.hpp"

#if defined(__x86_64__)
// GCC 12 warns of what its own header leaves undefined.
#if !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#pragma GCC diagnostic ignored "-Wuninitialized"
#endif
#include "raster/kernel/generic/small_polygons.hpp"
#include "raster/kernel/generic/tile_rows.hpp"
#include "raster/kernel/x86/box_test.hpp"
#include "raster/kernel/x86/gouraud_small.hpp"
#include "raster/kernel/x86/pixel_means.hpp"

namespace halfspace::fast {

// What it brings are stores under a mask, which do not read the image. A frame
// takes, against AVX2 (processor time, 1000 x 1000 pixels, three views): 500
// large triangles 1.00 flat and 0.94 smooth, with items 0.90 and 0.92; 10,000
// parallel ones 0.99, 1.00, 0.96 and 0.92; 100,000 small ones 0.89, 0.88, 0.84
// and 0.82; a mesh of 80,000 triangles 0.90, 0.97, 0.86 and 0.93.
const TileKernel kAvx512Kernel =
    with_means(table_of<SmallPolygons<BoxTest<TileRows<X86Simd>>>>());

}  // namespace halfspace::fast
#endif
