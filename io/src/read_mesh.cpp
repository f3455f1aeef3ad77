#include "halfspace/io/read_mesh.hpp"

#include <zlib.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>

#include "format_table.hpp"
#include "text.hpp"

namespace halfspace::io {
namespace {

/// As much as a gzipped file may unpack to.
constexpr std::uint64_t kMaxUnpacked = std::uint64_t{1} << 32;

Error named(const std::filesystem::path& path, Error error) {
  error.message = path.string() + ": " + error.message;
  return error;
}

Error unreadable(const std::filesystem::path& path) {
  return {ErrorCode::kUnreadable,
          path.string() + ": cannot be read: " + std::strerror(errno)};
}

Result<std::string> read_bytes(const std::filesystem::path& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(
      std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file) return unreadable(path);
  std::string bytes;
  std::error_code ignored;
  const std::uintmax_t size = std::filesystem::file_size(path, ignored);
  if (!ignored) bytes.reserve(static_cast<std::size_t>(size));
  std::string chunk(std::size_t{1} << 20, '\0');
  while (true) {
    const std::size_t got =
        std::fread(chunk.data(), 1, chunk.size(), file.get());
    bytes.append(chunk, 0, got);
    if (got < chunk.size()) break;
  }
  if (std::ferror(file.get()) != 0) return unreadable(path);
  return bytes;
}

bool is_gzipped(std::string_view bytes) {
  return bytes.starts_with("\x1f\x8b");
}

/// Unpacks one or more gzip members.
Result<std::string> unpacked(std::string_view bytes) {
  z_stream stream{};
  constexpr int kGzip = 16 + MAX_WBITS;
  if (inflateInit2(&stream, kGzip) != Z_OK) {
    return Error{ErrorCode::kUnreadable, "the unpacker cannot start"};
  }
  const std::unique_ptr<z_stream, int (*)(z_stream*)> guard(&stream,
                                                            inflateEnd);
  std::string text;
  std::string chunk(std::size_t{1} << 20, '\0');
  int status = Z_OK;
  while (true) {
    // zlib takes no more than 32 bits of input at a time, and does not write
    // through the pointer that it is given.
    const std::size_t part =
        std::min<std::size_t>(bytes.size(), std::size_t{1} << 30);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(part);
    stream.next_out = reinterpret_cast<Bytef*>(chunk.data());
    stream.avail_out = static_cast<uInt>(chunk.size());
    status = inflate(&stream, Z_NO_FLUSH);
    bytes.remove_prefix(part - stream.avail_in);
    text.append(chunk, 0, chunk.size() - stream.avail_out);
    if (text.size() > kMaxUnpacked) {
      return Error{ErrorCode::kOutOfRange, "it unpacks to more than 4 GiB"};
    }
    if (status == Z_STREAM_END) {
      if (!is_gzipped(bytes)) return text;  // padding may follow
      inflateReset(&stream);
    } else if (status == Z_BUF_ERROR) {
      return Error{ErrorCode::kTruncated, "the gzipped data ends too early",
                   static_cast<std::int64_t>(text.size())};
    } else if (status != Z_OK) {
      return Error{ErrorCode::kSyntax,
                   std::string("the gzipped data is damaged: ") +
                       (stream.msg != nullptr ? stream.msg : "no details"),
                   static_cast<std::int64_t>(text.size())};
    }
  }
}

}  // namespace

Result<std::string> read_file(const std::filesystem::path& path) {
  Result<std::string> bytes = read_bytes(path);
  if (!bytes || !is_gzipped(*bytes)) return bytes;
  Result<std::string> text = unpacked(*bytes);
  if (!text) return named(path, text.error());
  return text;
}

Result<Mesh> read_mesh(const std::filesystem::path& path) {
  const std::optional<Format> format = format_of(path);
  if (!format) {
    return Error{ErrorCode::kUnknownFormat,
                 path.string() + ": a mesh file ends in " +
                     format_extensions() + ", perhaps with .gz after it"};
  }
  const Result<std::string> bytes = read_file(path);
  if (!bytes) return bytes.error();
  Result<Mesh> mesh = read_mesh(*bytes, *format);
  if (!mesh) return named(path, mesh.error());
  return mesh;
}

Result<Mesh> read_mesh(std::string_view bytes, Format format) {
  if (bytes.empty()) return Error{ErrorCode::kEmpty, "the file is empty", 0};
  const FormatEntry* entry = entry_of(format);
  if (entry == nullptr)
    return Error{ErrorCode::kUnknownFormat, "the format is unknown"};
  return entry->read(bytes);
}

}  // namespace halfspace::io
