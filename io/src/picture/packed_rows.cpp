#include "picture/packed_rows.hpp"

#include <zlib.h>

#include <algorithm>

#include "base/side_by_side.hpp"

namespace halfspace::io {
namespace {

constexpr int kLevel = 4;
/// The two bytes before a stream of that level with a window of 32 KiB.
constexpr std::uint8_t kHeader[] = {0x78, 0x5e};
constexpr std::size_t kWindow = std::size_t{1} << 15;
/// A band has about as much, so that entering the window before it, 32 KiB,
/// costs little.
constexpr std::size_t kBandBytes = std::size_t{1} << 20;
/// The number of the filter Sub.
constexpr std::uint8_t kSub = 1;

}  // namespace

PackedRows::PackedRows(std::size_t row_bytes, std::size_t pixel_bytes,
                       std::int32_t height_px, int threads)
    : row_bytes_(row_bytes),
      pixel_bytes_(pixel_bytes),
      height_px_(height_px),
      threads_(threads > 0 ? threads : machine_threads()),
      rows_of_band_(std::max<std::size_t>(kBandBytes / (row_bytes + 1), 1)),
      // Twice as many as threads, for some bands take longer than others.
      most_rows_(rows_of_band_ * 2 * static_cast<std::size_t>(threads_)) {
  const std::size_t rows =
      std::min(most_rows_, static_cast<std::size_t>(height_px));
  bytes_.reserve(kWindow + rows * (row_bytes + 1));
}

void PackedRows::add(const std::uint8_t* row) {
  bytes_.push_back(kSub);
  const std::size_t at = bytes_.size();
  bytes_.resize(at + row_bytes_);
  std::uint8_t* const to = bytes_.data() + at;
  const std::size_t first = std::min(pixel_bytes_, row_bytes_);
  std::copy(row, row + first, to);
  for (std::size_t i = first; i < row_bytes_; ++i)
    to[i] = static_cast<std::uint8_t>(row[i] - row[i - pixel_bytes_]);
  ++rows_;
  ++added_;
}

std::span<const std::uint8_t> PackedRows::rows_of(std::size_t band) const {
  const std::size_t first = band * rows_of_band_;
  const std::size_t count = std::min(rows_of_band_, rows_ - first);
  return std::span(bytes_).subspan(before_ + first * (row_bytes_ + 1),
                                   count * (row_bytes_ + 1));
}

bool PackedRows::pack() {
  band_count_ = (rows_ + rows_of_band_ - 1) / rows_of_band_;
  const bool has_first = is_first_;
  is_first_ = false;
  chunks_.resize(std::max(chunks_.size(), band_count_));
  checksums_.resize(band_count_);
  // All memory before the threads work, which cannot tell that there is none.
  for (std::size_t band = 0; band < band_count_; ++band) {
    chunks_[band].resize(deflateBound(nullptr, rows_of(band).size()) + 64);
  }
  std::vector<char> is_packed(band_count_, 0);
  side_by_side(band_count_, threads_, [&](std::size_t band) {
    is_packed[band] = pack_band(band) ? 1 : 0;
  });
  if (std::count(is_packed.begin(), is_packed.end(), 0) > 0) return false;
  if (has_first)
    chunks_[0].insert(chunks_[0].begin(), std::begin(kHeader),
                      std::end(kHeader));
  for (std::size_t band = 0; band < band_count_; ++band) {
    checksum_ = static_cast<std::uint32_t>(
        adler32_combine(checksum_, checksums_[band],
                        static_cast<z_off_t>(rows_of(band).size())));
  }
  if (complete()) {
    for (const int shift : {24, 16, 8, 0}) {
      chunks_[band_count_ - 1].push_back(
          static_cast<std::uint8_t>(checksum_ >> shift));
    }
  }
  // The next bands refer back to what stays.
  const std::size_t stays = std::min(kWindow, bytes_.size());
  bytes_.erase(bytes_.begin(),
               bytes_.end() - static_cast<std::ptrdiff_t>(stays));
  before_ = stays;
  rows_ = 0;
  return true;
}

bool PackedRows::pack_band(std::size_t band) {
  const std::span<const std::uint8_t> rows = rows_of(band);
  std::vector<std::uint8_t>& chunk = chunks_[band];
  z_stream stream{};
  // Without zlib's own header and checksum, which the whole has.
  if (deflateInit2(&stream, kLevel, Z_DEFLATED, -15, 8, Z_DEFAULT_STRATEGY) !=
      Z_OK) {
    return false;
  }
  const auto before = static_cast<std::size_t>(rows.data() - bytes_.data());
  const std::size_t known = std::min(before, kWindow);
  deflateSetDictionary(&stream, rows.data() - known, static_cast<uInt>(known));
  stream.next_in = const_cast<Bytef*>(rows.data());
  stream.avail_in = static_cast<uInt>(rows.size());
  stream.next_out = chunk.data();
  stream.avail_out = static_cast<uInt>(chunk.size());
  const bool is_last = complete() && band + 1 == band_count_;
  const int status = deflate(&stream, is_last ? Z_FINISH : Z_SYNC_FLUSH);
  chunk.resize(stream.total_out);
  deflateEnd(&stream);
  checksums_[band] = static_cast<std::uint32_t>(
      adler32(1, rows.data(), static_cast<uInt>(rows.size())));
  return status == (is_last ? Z_STREAM_END : Z_OK);
}

}  // namespace halfspace::io
