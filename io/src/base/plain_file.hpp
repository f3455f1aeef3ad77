#pragma once

#include <filesystem>

namespace halfspace::io {

/// Whether there is a file at the path, and no device, pipe or folder.
bool is_plain_file(const std::filesystem::path& path);

}  // namespace halfspace::io
