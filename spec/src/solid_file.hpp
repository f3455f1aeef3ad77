#pragma once

#include <string>
#include <string_view>

#include "halfspace/solid_file.hpp"

/// The two forms of `.hsolid` files (spec/solid-format.md).
namespace halfspace {

constexpr std::string_view kSolidTextMagic = "halfspace-solid";
/// As in PNG: what changes line ends or cuts off the eighth bit is noticed.
constexpr std::string_view kSolidBinaryMagic = "\x89HSOLID\r\n\x1a\n";
/// That of files all of whose faces have colours and loops of three corners or
/// more, and that of the others.
constexpr std::uint32_t kFirstSolidVersion = 1;
constexpr std::uint32_t kSolidVersion = 2;
/// As many as there may be of anything.
constexpr std::size_t kMostSolidItems = 0x7fffffff;

/// The least version that holds the data.
std::uint32_t solid_version(const SolidData& data);

Result<SolidData> read_solid_text(std::string_view text);
Result<SolidData> read_solid_binary(std::string_view bytes);
std::string solid_text(const SolidData& data);
std::string solid_binary(const SolidData& data);

}  // namespace halfspace
