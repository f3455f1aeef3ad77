#include "raster/layers/layer_blender.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

namespace halfspace::fast {
namespace {

/// Calls show(first, count) for each run of set bits.
template <class Show>
void for_runs(std::uint32_t bits, Show&& show) {
  while (bits != 0) {
    const int first = std::countr_zero(bits);
    const int count = std::countr_one(bits >> first);
    show(first, count);
    // Shifting by all 32 bits is undefined.
    bits &= ~((~std::uint32_t{0} >> (kTileWidth - count)) << first);
  }
}

/// Eight channels, as GCC and Clang compile them for any processor.
using Bytes8 = std::uint8_t __attribute__((vector_size(8)));
using Shares8 = std::uint16_t __attribute__((vector_size(16)));

template <class Vector>
Vector load(const void* from) {
  Vector result;
  std::memcpy(&result, from, sizeof(result));
  return result;
}

/// blended() for each of `count` channels, the shares of what is over being
/// share_of(k) for one, and shares_of(k) for eight from the k-th on.
template <class ShareOf, class SharesOf>
void blend_channels(std::uint8_t* to, std::size_t count, std::uint16_t rest,
                    ShareOf&& share_of, SharesOf&& shares_of) {
  std::size_t k = 0;
  for (; k + 8 <= count; k += 8) {
    const auto under = __builtin_convertvector(load<Bytes8>(to + k), Shares8);
    const Shares8 t = shares_of(k) + under * rest;
    const auto bytes = __builtin_convertvector((t + (t >> 8)) >> 8, Bytes8);
    std::memcpy(to + k, &bytes, sizeof(bytes));
  }
  for (; k < count; ++k) to[k] = nearest_of_255(share_of(k) + to[k] * rest);
}

}  // namespace

void LayerBlender::set_flat(std::uint32_t color) {
  if (flat_ == color) return;
  flat_ = color;
  for (std::size_t c = 0; c < 3; ++c) {
    shares_[c] =
        share_of(static_cast<std::uint8_t>(color >> (8 * c)), frame_.alpha);
  }
  for (std::size_t k = 3; k < 24; ++k) shares_[k] = shares_[k - 3];
  for (std::size_t k = 24; k < shares_.size(); k += 24) {
    std::memcpy(&shares_[k], shares_.data(), 24 * sizeof(shares_[0]));
  }
}

void LayerBlender::shade(const PixelSource& source, std::int32_t x,
                         std::int32_t y, std::uint32_t bits,
                         LineColors& colors) {
  if (own_) {
    own_->shade(source.id - frame_.first_id, x, y, bits, colors);
    return;
  }
  if (shaded_ != source.id) {
    shaded_ = source.id;
    shader_.start(source.id - frame_.first_id, source.eye_sign);
  }
  stats_.exact +=
      static_cast<std::uint64_t>(shader_.shade(x, y, bits, colors.data(), 0));
}

FilterStats LayerBlender::stats() const {
  FilterStats all = stats_;
  if (own_) all.add(own_->stats());
  return all;
}

void LayerBlender::blend_line(const LineColors& over, std::uint32_t bits,
                              std::int32_t x, std::int32_t y) {
  const std::uint8_t alpha = frame_.alpha;
  std::uint8_t* const line = screen_.colors + 3 * screen_.pixel_at(x, y);
  for_runs(bits, [&](int first_pixel, int pixels) {
    const auto first = static_cast<std::size_t>(3 * first_pixel);
    const std::uint8_t* const from = over.data() + first;
    blend_channels(
        line + first, static_cast<std::size_t>(3 * pixels), rest_,
        [&](std::size_t k) { return share_of(from[k], alpha); },
        [&](std::size_t k) {
          return __builtin_convertvector(load<Bytes8>(from + k), Shares8) *
                     std::uint16_t{alpha} +
                 std::uint16_t{128};
        });
  });
}

void LayerBlender::blend(const PixelSource& source, std::int32_t x,
                         std::int32_t y, const std::uint32_t* bits) {
  if (!source.smooth()) set_flat(source.color);
  for (std::int32_t r = 0; r < kTileHeight; ++r) {
    if (bits[r] == 0) continue;
    if (source.smooth()) {
      shade(source, x, y + r, bits[r], over_);
      blend_line(over_, bits[r], x, y + r);
      continue;
    }
    std::uint8_t* const line = screen_.colors + 3 * screen_.pixel_at(x, y + r);
    for_runs(bits[r], [&](int first_pixel, int pixels) {
      const auto first = static_cast<std::size_t>(3 * first_pixel);
      const std::uint16_t* const shares = shares_.data() + first;
      blend_channels(
          line + first, static_cast<std::size_t>(3 * pixels), rest_,
          [&](std::size_t k) { return shares[k]; },
          [&](std::size_t k) { return load<Shares8>(shares + k); });
    });
  }
}

void LayerBlender::put_item(PolygonId id, std::int32_t x, std::int32_t y,
                            const std::uint32_t* bits) {
  for (std::int32_t r = 0; r < kTileHeight; ++r) {
    const std::int64_t at = screen_.pixel_at(x, y + r);
    for_runs(bits[r], [&](int first, int count) {
      std::fill_n(screen_.items + at + first, count, id);
    });
  }
}

}  // namespace halfspace::fast
