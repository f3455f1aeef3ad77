#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace halfspace::io {

/// The rows of a PNG picture as its IDAT chunks hold them: filtered, and packed
/// by zlib.
///
/// Bands of rows are packed side by side. Each knows the 32 KiB before it, as
/// far as back references reach, and ends with a whole byte, so that all of
/// them are one stream (RFC 1950, RFC 1951). Where bands begin depends on the
/// size of the picture alone, and so do the bytes, whatever the threads.
///
/// All rows have the filter Sub, differences from the pixel before, and zlib's
/// level 4. Pictures of a scan of 3,000 and 10,000 pixels each way, flat,
/// smooth and with 4 x 4 samples, are 0.99 to 1.07 times as long as with
/// libpng's choice of five filters and its level, 6, and are packed in a third
/// of the time.
class PackedRows {
 public:
  /// `threads`: 0 means as many as the machine has.
  /// Requires: sizes of at least 1.
  PackedRows(std::size_t row_bytes, std::size_t pixel_bytes,
             std::int32_t height_px, int threads);

  /// Takes the next row, its filter applied. Requires: it is not full().
  void add(const std::uint8_t* row);

  /// Whether there were all rows.
  bool complete() const { return added_ == height_px_; }

  /// Whether what is there is to be packed before the next row.
  bool full() const { return rows_ == most_rows_ || complete(); }

  /// Packs what is there, a chunk a band, and forgets it; the chunks stay until
  /// the next call. False where zlib has no memory.
  /// Requires: full().
  bool pack();

  std::span<const std::vector<std::uint8_t>> chunks() const {
    return std::span(chunks_).first(band_count_);
  }

 private:
  bool pack_band(std::size_t band);
  std::span<const std::uint8_t> rows_of(std::size_t band) const;

  std::size_t row_bytes_, pixel_bytes_;
  std::int32_t height_px_;
  int threads_;
  std::size_t rows_of_band_, most_rows_;
  std::int32_t added_ = 0;           ///< rows, in all
  std::size_t rows_ = 0;             ///< in `bytes_`
  std::vector<std::uint8_t> bytes_;  ///< what is before the bands, then these
  std::size_t before_ = 0;           ///< how many bytes are before the bands
  std::size_t band_count_ = 0;
  bool is_first_ = true;
  std::vector<std::vector<std::uint8_t>> chunks_;
  std::vector<std::uint32_t> checksums_;  ///< Adler-32, of each band
  std::uint32_t checksum_ = 1;            ///< of all that was packed
};

}  // namespace halfspace::io
