#include "file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>

namespace halfspace::io {
namespace {

Error unwritable(const std::filesystem::path& path) {
  return {ErrorCode::kUnwritable,
          path.string() + ": cannot be written: " + std::strerror(errno)};
}

/// Writes the bytes into the open file and closes it.
bool fill(std::FILE* file, std::string_view bytes) {
  const std::size_t written = std::fwrite(bytes.data(), 1, bytes.size(), file);
  // Closing writes what is still buffered, and may fail as writing may.
  const bool closed = std::fclose(file) == 0;
  return written == bytes.size() && closed;
}

/// Where the path leads through symbolic links, so that those stay.
std::filesystem::path target_of(const std::filesystem::path& path) {
  // Linux follows no more.
  constexpr int kMostLinks = 40;
  std::filesystem::path target = path;
  std::error_code ignored;
  for (int k = 0; k < kMostLinks; ++k) {
    if (!std::filesystem::is_symlink(target, ignored)) break;
    target =
        target.parent_path() / std::filesystem::read_symlink(target, ignored);
  }
  return target;
}

/// Writes into whatever is at the target: a device or a pipe cannot be renamed
/// to, and a folder may be closed to new files.
Result<Done> write_in_place(const std::filesystem::path& path,
                            const std::filesystem::path& target,
                            std::string_view bytes) {
  std::FILE* const file = std::fopen(target.c_str(), "wb");
  if (file == nullptr) return unwritable(path);
  if (fill(file, bytes)) return Done{};
  const Error error = unwritable(path);
  std::error_code ignored;
  if (std::filesystem::is_regular_file(target, ignored)) {
    std::filesystem::remove(target, ignored);
  }
  return error;
}

}  // namespace

Result<Done> write_file(const std::filesystem::path& path,
                        std::string_view bytes) {
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored) &&
      !std::filesystem::is_regular_file(path, ignored)) {
    return write_in_place(path, path, bytes);
  }
  const std::filesystem::path target = target_of(path);
  const std::filesystem::path beside =
      target.string() + ".part-" + std::to_string(::getpid());
  // "x": never a file that somebody else has made.
  std::FILE* const file = std::fopen(beside.c_str(), "wbx");
  if (file == nullptr) return write_in_place(path, target, bytes);
  if (fill(file, bytes) && std::rename(beside.c_str(), target.c_str()) == 0) {
    return Done{};
  }
  const Error error = unwritable(path);
  std::filesystem::remove(beside, ignored);
  return error;
}

}  // namespace halfspace::io
