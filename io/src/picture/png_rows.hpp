#pragma once

#include <png.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>

#include "halfspace/io/file.hpp"
#include "halfspace/io/picture.hpp"
#include "halfspace/result.hpp"
#include "picture/packed_rows.hpp"

namespace halfspace::io {

/// A picture being written row by row, 8 bits a channel, red, green and blue,
/// and alpha if it has one.
///
/// The rows alone decide the bytes, and not how they came to be there: parts
/// joined are the picture made in one piece.
class PngWriter {
 public:
  /// `part` is noted in the file; `threads` as in PackedRows.
  PngWriter(const std::filesystem::path& path, std::int32_t width_px,
            std::int32_t height_px, const std::optional<PartOfPicture>& part,
            int threads, bool has_alpha = false);
  ~PngWriter();
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;

  /// False where that failed; then finish() tells why.
  bool write_row(const std::uint8_t* channels);

  /// Errors: those of NewFile.
  Result<Done> finish();

 private:
  void begin(std::int32_t width_px, std::int32_t height_px, int color_type);
  bool write_chunks();
  void end();
  static void fail(png_structp png, png_const_charp why);
  static void write(png_structp png, png_bytep bytes, std::size_t count);
  static void flush(png_structp png);

  NewFile file_;
  PackedRows rows_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  std::string part_;
  std::string trouble_;
};

/// A picture being read row by row, of the kind that PngWriter makes.
class PngReader {
 public:
  explicit PngReader(const std::filesystem::path& path);
  ~PngReader();
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  std::int32_t width_px() const { return width_px_; }
  std::int32_t height_px() const { return height_px_; }
  const std::optional<PartOfPicture>& part() const { return part_; }

  /// False where that failed; then error() tells why.
  bool read_row(std::uint8_t* rgb);

  /// What went wrong, if anything: kUnreadable, kUnknownFormat (no PNG picture,
  /// or of another kind), kSyntax.
  std::optional<Error> error() const { return error_; }

 private:
  void begin();
  void read_part();
  void set_error(ErrorCode code, const std::string& what);
  static void fail(png_structp png, png_const_charp why);

  std::filesystem::path path_;
  std::FILE* file_ = nullptr;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  std::int32_t width_px_ = 0;
  std::int32_t height_px_ = 0;
  std::optional<PartOfPicture> part_;
  std::optional<Error> error_;
};

}  // namespace halfspace::io
