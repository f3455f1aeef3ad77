#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "halfspace/result.hpp"

namespace halfspace::io {

/// The size of an image that was put together. Units: pixels.
struct JoinedSize {
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
};

/// Writes the pictures in `parts`, one below the other in that order, as one:
/// the bytes that write_png() makes of the whole, as few rows in memory as that
/// has.
///
/// Requires: parts is not empty.
/// Errors: kUnreadable, kUnknownFormat, kSyntax (of a part); kOutOfRange (parts
///         of several widths, or more than 65,536 rows); kBadIndex (parts whose
///         notes say that they are out of order, or that some are missing, with
///         the part's index); kUnwritable (also where the output is a part).
///         The message names the file.
Result<JoinedSize> join_png(const std::vector<std::filesystem::path>& parts,
                            const std::filesystem::path& output);

/// The same for item images, whose files do not say which rows they hold: the
/// bytes that write_npy() makes of the whole.
Result<JoinedSize> join_npy(const std::vector<std::filesystem::path>& parts,
                            const std::filesystem::path& output);

}  // namespace halfspace::io
