#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "halfspace/image.hpp"
#include "halfspace/result.hpp"

namespace halfspace::io {

/// Which rows of a whole picture a part of it holds.
struct PartOfPicture {
  std::int32_t first_row = 0;
  std::int32_t whole_height_px = 0;
};

/// Writes a picture as PNG, 8 bits a channel. A note in the file says which
/// `part` of a whole it is, if it is one.
///
/// In up to so many threads, 0 meaning as many as the machine has; the bytes do
/// not depend on them.
/// Errors: kUnwritable; then a file that was begun is removed.
Result<Done> write_png(const std::filesystem::path& path,
                       const ColorImage& image,
                       const std::optional<PartOfPicture>& part = {},
                       int threads = 0);

/// How much of a pixel hides what is behind it, from 0 to 255.
using CoverageImage = Grid2<std::uint8_t>;

/// The same with an alpha channel. The colours are those of what covers the
/// pixels: they are not multiplied.
/// Requires: images of one size.
/// Errors: kUnwritable.
Result<Done> write_png_cut_out(const std::filesystem::path& path,
                               const ColorImage& image,
                               const CoverageImage& coverage, int threads = 0);

/// Writes an item image as a NumPy array: `<i4`, C order, shape (height,
/// width), -1 where there is background (S5.1).
/// Errors: kUnwritable.
Result<Done> write_npy(const std::filesystem::path& path,
                       const ItemImage& image);

/// Reads what write_npy() writes, or NumPy does for such an array.
///
/// Errors: kUnreadable, kUnknownFormat (no NumPy file, or another kind of
///         array), kSyntax, kTruncated, kOutOfRange (over 65,536 rows or
///         columns, or none).
Result<ItemImage> read_npy(const std::filesystem::path& path);

}  // namespace halfspace::io
