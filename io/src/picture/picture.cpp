#include "halfspace/io/picture.hpp"

#include "picture/png_rows.hpp"

namespace halfspace::io {

Result<Done> write_png(const std::filesystem::path& path,
                       const ColorImage& image,
                       const std::optional<PartOfPicture>& part) {
  static_assert(sizeof(Rgb) == 3, "rows of pixels are rows of bytes");
  PngWriter writer(path, image.width_px, image.height_px, part);
  for (std::int32_t j = 0; j < image.height_px; ++j) {
    if (!writer.write_row(&image.at(0, j).r)) break;
  }
  return writer.finish();
}

}  // namespace halfspace::io
