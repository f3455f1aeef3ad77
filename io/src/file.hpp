#pragma once

#include <filesystem>
#include <string_view>

#include "halfspace/result.hpp"

namespace halfspace::io {

/// Makes a file of these bytes.
/// Errors: kUnwritable; then a file that was begun is removed.
Result<Done> write_file(const std::filesystem::path& path,
                        std::string_view bytes);

}  // namespace halfspace::io
