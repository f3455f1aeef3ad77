#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace halfspace::io {

/// Bytes as letters (RFC 4648, sec. 4), padded.
std::string base64_of(std::string_view bytes);

/// The bytes of such letters, padded or not; nothing where they are none.
std::optional<std::string> bytes_of_base64(std::string_view letters);

}  // namespace halfspace::io
