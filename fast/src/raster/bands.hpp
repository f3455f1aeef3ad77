#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/threads.hpp"
#include "base/tsan.hpp"
#include "camera/edge_function.hpp"
#include "halfspace/fast/render.hpp"
#include "raster/kernel/tile_kernel.hpp"

namespace halfspace::fast {

/// Bands of whole tile rows, one or a few for each thread.
inline std::vector<PixelRange> bands_of(const Rectangle& rectangle,
                                        int threads) {
  const std::int32_t first = rectangle.top / kTileHeight;
  const std::int32_t last = (rectangle.bottom - 1) / kTileHeight;
  const std::int32_t rows = last - first + 1;
  // More bands than threads even out what the bands cost; but each walks the
  // tree, and draws again what crosses its border.
  const std::int32_t wanted = threads == 1 ? 1 : 2 * threads;
  const std::int32_t count = std::min(wanted, rows);
  std::vector<PixelRange> bands;
  for (std::int32_t b = 0; b < count; ++b) {
    const auto row = [&](std::int32_t k) {
      return static_cast<std::int32_t>(first + std::int64_t{rows} * k / count);
    };
    bands.push_back({std::max(rectangle.top, row(b) * kTileHeight),
                     std::min(rectangle.bottom, row(b + 1) * kTileHeight)});
  }
  return bands;
}

/// Calls work(b) for every band, in that many threads, the middle ones first:
/// in most pictures they take longest, and what is left for the end is little.
template <class Work>
void for_bands(std::size_t count, int threads, const Work& work) {
  std::atomic<std::size_t> next{0};
  const TsanForkJoin shared;
  const auto work_on = [&](int) {
    shared.task([&] {
      for (std::size_t k = next++; k < count; k = next++) {
        work(k % 2 == 0 ? (count + k) / 2 : (count - 1 - k) / 2);
      }
    });
  };
  threads::in_arena(threads, [&] { threads::for_each_task(threads, work_on); });
}

template <class T>
void resize_image(Grid2<T>& image, std::int32_t width, std::int32_t height) {
  if (image.width_px == width && image.height_px == height) return;
  image = Grid2<T>(width, height, T{});
}

}  // namespace halfspace::fast
