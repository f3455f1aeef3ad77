#include "mesh/glb/base64.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace halfspace::io {
namespace {

constexpr std::string_view kBase64Letters =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

}  // namespace

std::string base64_of(std::string_view bytes) {
  std::string letters;
  letters.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      word <<= 8;
      if (k < count) word |= static_cast<unsigned char>(bytes[i + k]);
    }
    // n bytes are n + 1 letters.
    for (std::size_t k = 0; k < 4; ++k) {
      letters += k <= count ? kBase64Letters[word >> (18 - 6 * k) & 63] : '=';
    }
  }
  return letters;
}

std::optional<std::string> bytes_of_base64(std::string_view letters) {
  const std::size_t last = letters.find_last_not_of('=');
  const std::size_t count = last == std::string_view::npos ? 0 : last + 1;
  if (letters.size() - count > 2 || count % 4 == 1) return std::nullopt;
  std::string bytes;
  bytes.reserve(count / 4 * 3 + 2);
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t value = kBase64Letters.find(letters[i]);
    if (value == std::string_view::npos) return std::nullopt;
    word = word << 6 | static_cast<std::uint32_t>(value);
    // Each letter but the first of four ends a byte.
    if (i % 4 > 0) bytes += static_cast<char>(word >> (6 - 2 * (i % 4)) & 255);
  }
  return bytes;
}

}  // namespace halfspace::io
