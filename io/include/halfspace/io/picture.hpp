#pragma once

#include <filesystem>

#include "halfspace/image.hpp"
#include "halfspace/result.hpp"

namespace halfspace::io {

/// Writes a picture as PNG, 8 bits a channel.
/// Errors: kUnwritable.
Result<Done> write_png(const std::filesystem::path& path,
                       const ColorImage& image);

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
