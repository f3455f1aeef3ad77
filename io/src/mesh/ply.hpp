#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "halfspace/result.hpp"

namespace halfspace::io {

enum class PlyType : std::uint8_t {
  kInt8,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kFloat,
  kDouble
};

/// Bytes of a value in a binary file.
std::size_t size_of(PlyType type);

/// What a value of full brightness is, in a colour of this type.
int color_range(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kFloat;  ///< of the value, or of a list's values
  bool is_list = false;
  PlyType count_type = PlyType::kUint8;  ///< of a list's length
};

struct PlyElement {
  std::string name;
  std::int64_t count = 0;
  std::vector<PlyProperty> properties;

  /// The place of the property that has one of these names; -1 if none.
  int find(std::initializer_list<std::string_view> names) const;
};

enum class PlyEncoding : std::uint8_t { kText, kLittle, kBig };

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::kText;
  std::vector<PlyElement> elements;
  std::vector<std::string> comments;
};

/// Reads a header, to the end of the line `end_header`.
/// Errors: kSyntax, kTruncated, kOutOfRange, kUnknownFormat.
Result<PlyHeader> read_ply_header(TextReader& text);

}  // namespace halfspace::io
