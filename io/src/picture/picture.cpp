#include "halfspace/io/picture.hpp"

#include <vector>

#include "picture/png_rows.hpp"

namespace halfspace::io {

Result<Done> write_png(const std::filesystem::path& path,
                       const ColorImage& image,
                       const std::optional<PartOfPicture>& part, int threads) {
  static_assert(sizeof(Rgb) == 3, "rows of pixels are rows of bytes");
  PngWriter writer(path, image.width_px, image.height_px, part, threads);
  for (std::int32_t j = 0; j < image.height_px; ++j) {
    if (!writer.write_row(&image.at(0, j).r)) break;
  }
  return writer.finish();
}

Result<Done> write_png_cut_out(const std::filesystem::path& path,
                               const ColorImage& image,
                               const CoverageImage& coverage, int threads) {
  PngWriter writer(path, image.width_px, image.height_px, {}, threads, true);
  std::vector<std::uint8_t> row;
  for (std::int32_t j = 0; j < image.height_px; ++j) {
    row.clear();
    for (std::int32_t i = 0; i < image.width_px; ++i) {
      const Rgb& color = image.at(i, j);
      row.insert(row.end(), {color.r, color.g, color.b, coverage.at(i, j)});
    }
    if (!writer.write_row(row.data())) break;
  }
  return writer.finish();
}

}  // namespace halfspace::io
