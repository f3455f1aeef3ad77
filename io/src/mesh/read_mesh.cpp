#include "halfspace/io/read_mesh.hpp"

#include <string>

#include "halfspace/io/file.hpp"
#include "mesh/format_table.hpp"
#include "mesh/readers.hpp"

namespace halfspace::io {
namespace {

Error named(const std::filesystem::path& path, Error error) {
  error.message = path.string() + ": " + error.message;
  return error;
}

/// The mesh that the bytes of a file in a folder hold.
Result<Mesh> read_bytes(std::string_view bytes, Format format,
                        const std::filesystem::path* folder, const Stop& stop) {
  if (bytes.empty()) return Error{ErrorCode::kEmpty, "the file is empty", 0};
  const FormatEntry* entry = entry_of(format);
  if (entry == nullptr)
    return Error{ErrorCode::kUnknownFormat, "the format is unknown"};
  return entry->read(bytes, folder, stop);
}

}  // namespace

Result<Mesh> read_mesh(const std::filesystem::path& path, const Stop& stop) {
  const std::optional<Format> format = format_of(path);
  if (!format) {
    return Error{ErrorCode::kUnknownFormat,
                 path.string() + ": a mesh file ends in " +
                     format_extensions() + ", perhaps with .gz after it"};
  }
  const Result<std::string> bytes = read_file(path, kMostFileBytes, stop);
  if (!bytes) return bytes.error();
  const std::filesystem::path folder = path.parent_path();
  Result<Mesh> mesh = read_bytes(*bytes, *format, &folder, stop);
  if (!mesh) return named(path, mesh.error());
  return mesh;
}

Result<Mesh> read_mesh(std::string_view bytes, Format format) {
  return read_bytes(bytes, format, nullptr, {});
}

}  // namespace halfspace::io
