#include <map>
#include <utility>

#include "base/plain_file.hpp"
#include "halfspace/io/file.hpp"
#include "halfspace/io/memory_files.hpp"

namespace halfspace::io {
namespace {

using FilesByName = std::map<std::string, std::string, std::less<>>;

/// Made when it is first needed, and never destroyed.
FilesByName& files_by_name() {
  static auto* const files = new FilesByName;
  return *files;
}

Error named_error(const std::filesystem::path& path, ErrorCode code,
                  const char* what) {
  return {code, path.string() + ": " + what, -1};
}

}  // namespace

void put_file(std::string name, std::string bytes) {
  files_by_name().insert_or_assign(std::move(name), std::move(bytes));
}

std::optional<std::string> take_file(std::string_view name) {
  FilesByName& files = files_by_name();
  const auto found = files.find(name);
  if (found == files.end()) return std::nullopt;
  std::string bytes = std::move(found->second);
  files.erase(found);
  return bytes;
}

bool is_plain_file(const std::filesystem::path& path) {
  const FilesByName& files = files_by_name();
  return files.find(path.string()) != files.end();
}

Result<std::string> read_file(const std::filesystem::path& path,
                              std::uint64_t most, const Stop&) {
  const FilesByName& files = files_by_name();
  const auto found = files.find(path.string());
  if (found == files.end()) {
    return named_error(path, ErrorCode::kUnreadable,
                       "cannot be read: no such file in memory");
  }
  if (found->second.size() > most) {
    return named_error(path, ErrorCode::kOutOfRange, "is too large");
  }
  if (found->second.starts_with("\x1f\x8b")) {
    return named_error(path, ErrorCode::kUnknownFormat,
                       "is gzipped, which is not unpacked here; unpack it "
                       "first");
  }
  return found->second;
}

Result<Done> write_file(const std::filesystem::path& path,
                        std::string_view bytes) {
  if (path.extension() == ".gz") {
    return named_error(path, ErrorCode::kUnwritable,
                       "cannot be written: nothing is gzipped here");
  }
  put_file(path.string(), std::string(bytes));
  return Done{};
}

}  // namespace halfspace::io
