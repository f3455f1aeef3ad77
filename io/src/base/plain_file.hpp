#pragma once

#include <algorithm>
#include <filesystem>
#include <string>

namespace halfspace::io {

/// Whether there is a file at the path, and no device, pipe or folder.
bool is_plain_file(const std::filesystem::path& path);

/// Where a file that another one names is sought: from the folder of that one.
/// A path of another machine is cut down to the file's name.
inline std::filesystem::path path_beside(const std::filesystem::path& folder,
                                         std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  const bool has_drive = name.size() > 1 && name[1] == ':';
  std::filesystem::path path(name);
  if (path.is_absolute() || has_drive) path = path.filename();
  return folder / path;
}

}  // namespace halfspace::io
