#include "halfspace/io/file.hpp"

#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>
#include <string>

#include "base/plain_file.hpp"

namespace halfspace::io {
namespace {

/// A terminal has less to say; other devices may have no end.
constexpr std::uint64_t kMostDeviceBytes = std::uint64_t{1} << 24;

Error about(const std::filesystem::path& path, ErrorCode code,
            const std::string& what, std::int64_t index = -1) {
  return {code, path.string() + ": " + what, index};
}

Error unreadable(const std::filesystem::path& path) {
  return about(path, ErrorCode::kUnreadable,
               std::string("cannot be read: ") + std::strerror(errno));
}

std::string size_in_words(std::uint64_t bytes) {
  if (bytes >= 1u << 30) return std::to_string(bytes >> 30) + " GiB";
  if (bytes >= 1u << 20) return std::to_string(bytes >> 20) + " MiB";
  return std::to_string(bytes) + " bytes";
}

Error too_large(const std::filesystem::path& path, const std::string& verb,
                std::uint64_t most) {
  return about(path, ErrorCode::kOutOfRange,
               verb + " more than " + size_in_words(most));
}

Result<std::string> read_bytes(const std::filesystem::path& path,
                               std::uint64_t most, const Stop& stop) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(
      std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file) return unreadable(path);
  std::string bytes;
  std::error_code error;
  if (std::filesystem::is_character_file(path, error))
    most = std::min(most, kMostDeviceBytes);
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (!error && size > most) return too_large(path, "has", most);
  if (!error) bytes.reserve(static_cast<std::size_t>(size));
  std::string chunk(std::size_t{1} << 20, '\0');
  while (true) {
    const std::size_t got =
        std::fread(chunk.data(), 1, chunk.size(), file.get());
    if (stop && stop()) return stopped();
    if (bytes.size() + got > most) return too_large(path, "has", most);
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
Result<std::string> unpacked(const std::filesystem::path& path,
                             std::string_view bytes, std::uint64_t most,
                             const Stop& stop) {
  z_stream stream{};
  constexpr int kGzip = 16 + MAX_WBITS;
  if (inflateInit2(&stream, kGzip) != Z_OK)
    return about(path, ErrorCode::kUnreadable, "the unpacker cannot start");
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
    const auto index = static_cast<std::int64_t>(text.size());
    if (stop && stop()) return stopped();
    if (text.size() > most) return too_large(path, "unpacks to", most);
    if (status == Z_STREAM_END) {
      if (!is_gzipped(bytes)) return text;  // padding may follow
      inflateReset(&stream);
    } else if (status == Z_BUF_ERROR) {
      return about(path, ErrorCode::kTruncated,
                   "the gzipped data ends too early", index);
    } else if (status != Z_OK) {
      return about(path, ErrorCode::kSyntax,
                   std::string("the gzipped data is damaged: ") +
                       (stream.msg != nullptr ? stream.msg : "no details"),
                   index);
    }
  }
}

/// The bytes as one gzip member; nothing where there is no memory. The same
/// bytes for the same ones: no time and no name are in it.
std::string packed(std::string_view bytes) {
  z_stream stream{};
  constexpr int kGzip = 16 + MAX_WBITS;
  constexpr int kUsualMemory = 8;
  std::string result;
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kGzip,
                   kUsualMemory, Z_DEFAULT_STRATEGY) != Z_OK)
    return result;
  const std::unique_ptr<z_stream, int (*)(z_stream*)> guard(&stream,
                                                            deflateEnd);
  std::string chunk(std::size_t{1} << 20, '\0');
  int status = Z_OK;
  while (status != Z_STREAM_END) {
    const std::size_t part =
        std::min<std::size_t>(bytes.size(), std::size_t{1} << 30);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(part);
    stream.next_out = reinterpret_cast<Bytef*>(chunk.data());
    stream.avail_out = static_cast<uInt>(chunk.size());
    status = deflate(&stream, part == bytes.size() ? Z_FINISH : Z_NO_FLUSH);
    bytes.remove_prefix(part - stream.avail_in);
    result.append(chunk, 0, chunk.size() - stream.avail_out);
  }
  return result;
}

bool is_gzip_name(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  return extension == ".gz" || extension == ".GZ";
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

/// Whether a file that cannot be created beside may still be written in place.
/// On a full disk that would destroy what is there.
bool may_write_in_place(int error) {
  return error == EEXIST || error == EACCES || error == EPERM ||
         error == EROFS || error == ENAMETOOLONG;
}

}  // namespace

bool is_plain_file(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::is_regular_file(path, error);
}

Result<std::string> read_file(const std::filesystem::path& path,
                              std::uint64_t most, const Stop& stop) {
  Result<std::string> bytes = read_bytes(path, most, stop);
  if (!bytes || !is_gzipped(*bytes)) return bytes;
  return unpacked(path, *bytes, most, stop);
}

std::filesystem::path part_name(const std::filesystem::path& path) {
  return target_of(path).string() + ".part-" + std::to_string(::getpid());
}

NewFile::NewFile(const std::filesystem::path& path)
    : path_(path), target_(path), written_(path) {
  std::error_code ignored;
  const bool exists = std::filesystem::exists(path, ignored);
  if (exists && !std::filesystem::is_regular_file(path, ignored)) {
    stream_ = std::fopen(path.c_str(), "wb");
  } else {
    target_ = target_of(path);
    written_ = part_name(path);
    // "x": never a file that somebody else has made.
    stream_ = std::fopen(written_.c_str(), "wbx");
    if (stream_ == nullptr && may_write_in_place(errno)) {
      written_ = target_;
      stream_ = std::fopen(target_.c_str(), "wb");
    }
  }
  if (stream_ == nullptr) {
    trouble_ = std::strerror(errno);
    return;
  }
  struct stat before {};
  if (written_ != target_ && ::stat(target_.c_str(), &before) == 0) {
    constexpr mode_t kPermissions = 07777;
    if (::fchmod(::fileno(stream_), before.st_mode & kPermissions) != 0)
      trouble_ = std::strerror(errno);
  }
}

NewFile::~NewFile() {
  if (stream_ == nullptr) return;
  std::fclose(stream_);
  remove();
}

/// Removes what was begun, unless it is a device or a pipe.
void NewFile::remove() {
  std::error_code ignored;
  if (std::filesystem::is_regular_file(written_, ignored))
    std::filesystem::remove(written_, ignored);
}

Result<Done> NewFile::finish(std::string_view trouble) {
  if (trouble_.empty()) trouble_ = trouble;
  std::FILE* const stream = stream_;
  stream_ = nullptr;
  if (stream != nullptr) {
    // Closing writes what is still buffered, and may fail as writing may.
    if (std::fflush(stream) != 0 && trouble_.empty())
      trouble_ = std::strerror(errno);
    if (std::fclose(stream) != 0 && trouble_.empty())
      trouble_ = std::strerror(errno);
    if (trouble_.empty() && written_ != target_ &&
        std::rename(written_.c_str(), target_.c_str()) != 0)
      trouble_ = std::strerror(errno);
    if (!trouble_.empty()) remove();
  }
  if (trouble_.empty()) return Done{};
  return about(path_, ErrorCode::kUnwritable, "cannot be written: " + trouble_);
}

Result<Done> write_file(const std::filesystem::path& path,
                        std::string_view bytes) {
  NewFile file(path);
  if (file.stream() == nullptr) return file.finish();
  const std::string gzip = is_gzip_name(path) ? packed(bytes) : std::string();
  if (is_gzip_name(path)) {
    if (gzip.empty()) return file.finish("there is not enough memory");
    bytes = gzip;
  }
  const std::size_t written =
      std::fwrite(bytes.data(), 1, bytes.size(), file.stream());
  return file.finish(written == bytes.size() ? "" : std::strerror(errno));
}

}  // namespace halfspace::io
