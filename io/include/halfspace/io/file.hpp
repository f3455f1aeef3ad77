#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

#include "halfspace/io/stop.hpp"
#include "halfspace/result.hpp"

namespace halfspace::io {

/// As much as is read of a file, and as a gzipped file may unpack to.
constexpr std::uint64_t kMostFileBytes = std::uint64_t{1} << 32;

/// The bytes of a file, unpacked if they are gzipped.
///
/// Errors: kUnreadable; kTruncated or kSyntax (a gzipped file that is cut off
///         or damaged); kOutOfRange (more than `most` bytes, packed or
///         unpacked, or more than 16 MiB from a device). The message names the
///         file. kStopped (by `stop`, which is asked once a MiB).
Result<std::string> read_file(const std::filesystem::path& path,
                              std::uint64_t most = kMostFileBytes,
                              const Stop& stop = {});

/// Makes a file of these bytes, gzipped if the name ends in `.gz`, beside the
/// path first and then renamed: at the path there is all of it, or what was
/// there before.
///
/// Keeps:  the file's permissions, and symbolic links that lead to it.
/// Errors: kUnwritable; then nothing is left of what was begun.
Result<Done> write_file(const std::filesystem::path& path,
                        std::string_view bytes);

/// A file that is being written, as write_file() does: under part_name() until
/// finish(), which renames it.
///
/// A device or a pipe is written in place, and so is a file in a folder that
/// takes no new ones.
class NewFile {
 public:
  explicit NewFile(const std::filesystem::path& path);
  /// Removes what was begun, unless finish() was called.
  ~NewFile();
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  /// Null where the file cannot be created; then finish() says why.
  std::FILE* stream() const { return stream_; }

  /// Where the bytes go until then.
  const std::filesystem::path& written_path() const { return written_; }

  /// Errors: kUnwritable, with `trouble` as the reason if there is any.
  Result<Done> finish(std::string_view trouble = {});

 private:
  void remove();

  std::filesystem::path path_;
  std::filesystem::path target_;   ///< where the path's links lead
  std::filesystem::path written_;  ///< the target, where it is in place
  std::FILE* stream_ = nullptr;
  std::string trouble_;
};

/// The name that a file has while it is written.
std::filesystem::path part_name(const std::filesystem::path& path);

}  // namespace halfspace::io
