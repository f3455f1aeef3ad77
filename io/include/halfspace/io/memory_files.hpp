#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace halfspace::io {

/// Files where there is no file system, as in a browser: read_file() and
/// write_file() find and leave them in memory, by name. Only in libraries built
/// with HALFSPACE_FILE_SYSTEM=OFF, for one thread.

/// Puts a file in place of any of that name.
void put_file(std::string name, std::string bytes);

/// Takes a file away; nothing where there is none.
std::optional<std::string> take_file(std::string_view name);

}  // namespace halfspace::io
