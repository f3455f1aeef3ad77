#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

#include "halfspace/result.hpp"

namespace halfspace::io {

enum class ByteOrder : std::uint8_t { kLittle, kBig };

constexpr ByteOrder kNativeOrder = std::endian::native == std::endian::little
                                       ? ByteOrder::kLittle
                                       : ByteOrder::kBig;

/// The value whose bytes stand at `at`.
/// Requires: at + sizeof(T) <= bytes.size().
template <class T>
T load(std::string_view bytes, std::size_t at, ByteOrder order) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), bytes.data() + at, sizeof(T));
  if (order != kNativeOrder) std::reverse(raw.begin(), raw.end());
  return std::bit_cast<T>(raw);
}

/// Adds the bytes of `value`, the least first.
template <class T>
void store(std::string& bytes, T value) {
  auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (kNativeOrder != ByteOrder::kLittle) {
    std::reverse(raw.begin(), raw.end());
  }
  bytes.append(raw.data(), raw.size());
}

/// The error of bytes from `at` on that should not be there; zeros and blanks
/// at the end of a file are let pass.
inline std::optional<Error> trailing_error(std::string_view bytes,
                                           std::size_t at) {
  const std::size_t extra =
      bytes.find_first_not_of(std::string_view("\0 \t\r\n", 5), at);
  if (extra == std::string_view::npos) return std::nullopt;
  return Error{ErrorCode::kSyntax,
               "the file goes on for " + std::to_string(bytes.size() - at) +
                   " bytes after what it says it holds",
               static_cast<std::int64_t>(extra)};
}

}  // namespace halfspace::io
