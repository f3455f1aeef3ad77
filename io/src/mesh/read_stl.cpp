#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/binary.hpp"
#include "base/point_table.hpp"
#include "base/text.hpp"
#include "mesh/mesh_builder.hpp"
#include "mesh/readers.hpp"

namespace halfspace::io {
namespace {

constexpr std::size_t kHeaderSize = 84;    // 80 of any text, 4 of a count
constexpr std::size_t kTriangleSize = 50;  // 12 floats and 2 bytes

/// Whether the bytes are a binary STL: they have the size that it says it has,
/// or do not start like a text.
bool is_binary(std::string_view bytes) {
  if (bytes.size() >= kHeaderSize) {
    const auto count = load<std::uint32_t>(bytes, 80, ByteOrder::kLittle);
    if (bytes.size() == kHeaderSize + kTriangleSize * std::size_t{count}) {
      return true;
    }
  }
  const std::size_t start = bytes.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  if (start == std::string_view::npos) return false;
  if (!is_word(bytes.substr(start, 5), "solid")) return true;
  // Some programs begin the text of a binary header with "solid".
  return bytes.substr(0, kHeaderSize).find('\0') != std::string_view::npos;
}

/// A point as the file has it, a zero without its sign.
using FloatPoint = std::array<float, 3>;

struct FloatsHash {
  std::size_t operator()(const FloatPoint& point) const {
    std::uint64_t hash = 0;
    for (const float value : point)
      hash = mixed(hash + std::bit_cast<std::uint32_t>(value));
    return hash;
  }
};

Result<Mesh> read_binary(std::string_view bytes, const Stop& stop) {
  if (bytes.size() < kHeaderSize) {
    return Error{ErrorCode::kTruncated,
                 "a binary STL has at least 84 bytes, not " +
                     std::to_string(bytes.size()),
                 static_cast<std::int64_t>(bytes.size())};
  }
  const auto count = load<std::uint32_t>(bytes, 80, ByteOrder::kLittle);
  const std::string_view body = bytes.substr(kHeaderSize);
  if (body.size() / kTriangleSize < count) {
    const std::size_t whole = body.size() / kTriangleSize;
    return Error{ErrorCode::kTruncated,
                 "the file ends in triangle " + std::to_string(whole) + " of " +
                     std::to_string(count),
                 static_cast<std::int64_t>(whole)};
  }
  const std::size_t used = kTriangleSize * std::size_t{count};
  if (auto error = trailing_error(bytes, kHeaderSize + used)) return *error;
  MeshBuilder builder(stop);
  // Numbers of any size are made of points once each, not of every corner.
  PointTable<FloatPoint, FloatsHash> table;
  std::vector<FloatPoint> points;
  for (std::uint32_t triangle = 0; triangle < count; ++triangle) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      FloatPoint point;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t at =
            kTriangleSize * std::size_t{triangle} + 12 + 12 * corner + 4 * axis;
        const auto value = load<float>(body, at, ByteOrder::kLittle);
        if (!std::isfinite(value)) {
          return Error{ErrorCode::kNotFinite,
                       "triangle " + std::to_string(triangle) + ", corner " +
                           std::to_string(corner) + ": a coordinate is " +
                           std::to_string(value),
                       triangle};
        }
        point[axis] = value == 0 ? 0.0f : value;
      }
      if (auto error = builder.add_corner(table.index_of(point, points)))
        return *error;
    }
    builder.end_face();
  }
  builder.mesh.vertices.reserve(points.size());
  for (const auto& [x, y, z] : points) {
    if (auto error = builder.add_vertex(
            {number_of(double{x}), number_of(double{y}), number_of(double{z})}))
      return *error;
  }
  return std::move(builder.mesh);
}

/// Reads the text of `solid` blocks.
class TextStl {
 public:
  TextStl(std::string_view text, const Stop& stop)
      : text_(text, {}), builder_(stop) {}
  Result<Mesh> read();

 private:
  bool fail(ErrorCode code, const std::string& what) {
    error_ = text_.error(code, what);
    return false;
  }
  bool fail(const Error& error) { return fail(error.code, error.message); }
  bool take(std::string_view& token, std::string_view wanted);
  bool expect(std::string_view word);
  bool facets();
  bool facet();
  bool vertex();

  TextReader text_;
  MeshBuilder builder_;
  std::optional<Error> error_;
};

bool TextStl::take(std::string_view& token, std::string_view wanted) {
  if (text_.next(token)) return true;
  return fail(ErrorCode::kTruncated,
              "the file ends where there should be " + in_quotes(wanted));
}

bool TextStl::expect(std::string_view word) {
  std::string_view token;
  if (!take(token, word)) return false;
  if (is_word(token, word)) return true;
  return fail(ErrorCode::kSyntax, "there should be " + in_quotes(word) +
                                      ", not " + in_quotes(token));
}

bool TextStl::vertex() {
  if (!expect("vertex")) return false;
  std::array<Number, 3> point;
  for (Number& coordinate : point) {
    std::string_view token;
    if (!take(token, "a coordinate")) return false;
    Result<Number> number = parse_number(token);
    if (!number) return fail(number.error());
    coordinate = *std::move(number);
  }
  if (auto error = builder_.add_corner_at(std::move(point))) {
    return fail(*error);
  }
  return true;
}

/// What follows `facet`.
bool TextStl::facet() {
  if (!expect("normal")) return false;
  for (int i = 0; i < 3; ++i) {
    // Some programs write no number where a triangle has no area.
    std::string_view token;
    if (!take(token, "a normal")) return false;
    const Result<Number> number = parse_number(token);
    if (!number && number.error().code == ErrorCode::kSyntax) {
      return fail(number.error());
    }
  }
  if (!expect("outer") || !expect("loop") || !vertex() || !vertex() ||
      !vertex() || !expect("endloop") || !expect("endfacet")) {
    return false;
  }
  builder_.end_face();
  return true;
}

/// What follows the line of `solid`, to the line of `endsolid`.
bool TextStl::facets() {
  std::string_view token;
  while (take(token, "endsolid")) {
    if (is_word(token, "endsolid")) {
      text_.skip_line();
      return true;
    }
    if (!is_word(token, "facet")) {
      return fail(
          ErrorCode::kSyntax,
          "there should be 'facet' or 'endsolid', not " + in_quotes(token));
    }
    if (!facet()) return false;
  }
  return false;
}

Result<Mesh> TextStl::read() {
  builder_.mesh.decimal = true;
  do {
    if (!expect("solid")) return *error_;
    text_.skip_line();
    if (!facets()) return *error_;
  } while (!text_.at_end());
  return std::move(builder_.mesh);
}

}  // namespace

Result<Mesh> read_stl(std::string_view bytes, const Stop& stop) {
  if (is_binary(bytes)) {
    if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff")) {
      return *not_plain_text(bytes);
    }
    return read_binary(bytes, stop);
  }
  if (auto error = not_plain_text(bytes)) return *error;
  return TextStl(bytes, stop).read();
}

}  // namespace halfspace::io
