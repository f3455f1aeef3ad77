#include "raster/kernel/tile_kernel.hpp"

#if defined(__x86_64__)
#include "raster/kernel/generic/small_polygons.hpp"
#include "raster/kernel/generic/tile_rows.hpp"
#include "raster/kernel/x86/box_test.hpp"
#include "raster/kernel/x86/gouraud_small.hpp"
#include "raster/kernel/x86/pixel_means.hpp"

namespace halfspace::fast {

const TileKernel kAvx2Kernel =
    with_means(table_of<SmallPolygons<BoxTest<TileRows<X86Simd>>>>());

}  // namespace halfspace::fast
#endif
