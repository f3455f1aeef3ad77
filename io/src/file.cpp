#include "file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace halfspace::io {
namespace {

Error unwritable(const std::filesystem::path& path) {
  return {ErrorCode::kUnwritable,
          path.string() + ": cannot be written: " + std::strerror(errno)};
}

}  // namespace

Result<Done> write_file(const std::filesystem::path& path,
                        std::string_view bytes) {
  std::FILE* const file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) return unwritable(path);
  const std::size_t written = std::fwrite(bytes.data(), 1, bytes.size(), file);
  // Closing writes what is still buffered, and may fail as writing may.
  const bool closed = std::fclose(file) == 0;
  if (written == bytes.size() && closed) return Done{};
  const Error error = unwritable(path);
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path, ignored)) {
    std::filesystem::remove(path, ignored);
  }
  return error;
}

}  // namespace halfspace::io
