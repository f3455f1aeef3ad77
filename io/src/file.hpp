#pragma once

#include <filesystem>
#include <string_view>

#include "halfspace/result.hpp"

namespace halfspace::io {

/// Makes a file of these bytes, beside the path first and then renamed: at the
/// path there is all of it, or what was there before.
///
/// A device or a pipe is written in place, and so is a file in a folder that
/// takes no new ones.
/// Errors: kUnwritable; then nothing is left of what was begun.
Result<Done> write_file(const std::filesystem::path& path,
                        std::string_view bytes);

}  // namespace halfspace::io
