#include "picture/npy.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>

#include "base/binary.hpp"
#include "halfspace/camera.hpp"
#include "halfspace/io/file.hpp"
#include "halfspace/io/picture.hpp"
#include "halfspace/io/read_mesh.hpp"

namespace halfspace::io {
namespace {

constexpr std::string_view kMagic = "\x93NUMPY";

/// What an array file must say about its values.
constexpr std::string_view kType = "'descr': '<i4'";
constexpr std::string_view kOrder = "'fortran_order': False";

/// The two numbers of `(height, width)` at the front of `text`.
bool take_shape(std::string_view text, std::int64_t& height,
                std::int64_t& width) {
  const auto skip_blanks = [&text] {
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  };
  const auto take = [&](char wanted) {
    skip_blanks();
    if (!text.starts_with(wanted)) return false;
    text.remove_prefix(1);
    return true;
  };
  const auto take_number = [&](std::int64_t& value) {
    skip_blanks();
    const auto [end, code] =
        std::from_chars(text.data(), text.data() + text.size(), value);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return code == std::errc{};
  };
  return take('(') && take_number(height) && take(',') && take_number(width) &&
         take(')');
}

Error npy_error(ErrorCode code, const std::string& what) {
  return {code, what};
}

/// Where the values begin, and the header's text.
Result<std::size_t> take_header(std::string_view bytes,
                                std::string_view& header) {
  if (!bytes.starts_with(kMagic)) {
    return npy_error(ErrorCode::kUnknownFormat, "this is no NumPy array");
  }
  if (bytes.size() < 12) {
    return npy_error(ErrorCode::kTruncated, "the file ends in its header");
  }
  const bool is_version_1 = bytes[6] == 1;
  const std::size_t start = is_version_1 ? 10 : 12;
  const std::size_t size =
      is_version_1
          ? std::size_t{load<std::uint16_t>(bytes, 8, ByteOrder::kLittle)}
          : std::size_t{load<std::uint32_t>(bytes, 8, ByteOrder::kLittle)};
  if (bytes.size() - start < size) {
    return npy_error(ErrorCode::kTruncated, "the file ends in its header");
  }
  header = bytes.substr(start, size);
  return start + size;
}

}  // namespace

Result<NpyShape> npy_shape(std::string_view bytes) {
  std::string_view header;
  const Result<std::size_t> start = take_header(bytes, header);
  if (!start) return start.error();
  if (header.find(kType) == std::string_view::npos ||
      header.find(kOrder) == std::string_view::npos) {
    return npy_error(ErrorCode::kUnknownFormat,
                     "an item image is an array of '<i4' in C order");
  }
  constexpr std::string_view kShape = "'shape':";
  const std::size_t shape = header.find(kShape);
  std::int64_t height = 0;
  std::int64_t width = 0;
  if (shape == std::string_view::npos ||
      !take_shape(header.substr(shape + kShape.size()), height, width)) {
    return npy_error(ErrorCode::kSyntax,
                     "an item image has the shape (height, width)");
  }
  for (const std::int64_t size : {height, width}) {
    if (size >= 1 && size <= kMaxImageSize) continue;
    return npy_error(ErrorCode::kOutOfRange,
                     "an image has 1 to 65536 rows and columns, not " +
                         std::to_string(size));
  }
  return NpyShape{*start, static_cast<std::int32_t>(width),
                  static_cast<std::int32_t>(height)};
}

std::string npy_header(std::int32_t width_px, std::int32_t height_px) {
  std::string header = "{" + std::string(kType) + ", " + std::string(kOrder) +
                       ", 'shape': (" + std::to_string(height_px) + ", " +
                       std::to_string(width_px) + "), }";
  // Magic, version, length, header and a line feed: a multiple of 64 bytes.
  constexpr std::size_t kBefore = 10;
  const std::size_t whole = (kBefore + header.size() + 1 + 63) / 64 * 64;
  header.resize(whole - kBefore - 1, ' ');
  header += '\n';
  std::string bytes(kMagic);
  bytes += '\x01';
  bytes += '\0';
  store(bytes, static_cast<std::uint16_t>(header.size()));
  return bytes + header;
}

namespace {

Result<ItemImage> parse_npy(std::string_view bytes) {
  const Result<NpyShape> shape = npy_shape(bytes);
  if (!shape) return shape.error();
  const auto count = static_cast<std::size_t>(shape->width_px) *
                     static_cast<std::size_t>(shape->height_px);
  const std::string_view values = bytes.substr(shape->start);
  if (values.size() / 4 < count) {
    return npy_error(ErrorCode::kTruncated,
                     "the file holds " + std::to_string(values.size() / 4) +
                         " of " + std::to_string(count) + " pixels");
  }
  if (values.size() != 4 * count) {
    return npy_error(ErrorCode::kSyntax, "the file goes on after its pixels");
  }
  ItemImage image(shape->width_px, shape->height_px, kBackground);
  for (std::size_t i = 0; i < count; ++i) {
    image.pixels[i] = load<std::int32_t>(values, 4 * i, ByteOrder::kLittle);
  }
  return image;
}

}  // namespace

Result<Done> write_npy(const std::filesystem::path& path,
                       const ItemImage& image) {
  std::string bytes = npy_header(image.width_px, image.height_px);
  bytes.reserve(bytes.size() + 4 * image.pixels.size());
  for (const PolygonId id : image.pixels) store(bytes, std::int32_t{id});
  return write_file(path, bytes);
}

Result<ItemImage> read_npy(const std::filesystem::path& path) {
  const Result<std::string> bytes = read_file(path);
  if (!bytes) return bytes.error();
  Result<ItemImage> image = parse_npy(*bytes);
  if (image) return image;
  Error error = image.error();
  error.message = path.string() + ": " + error.message;
  return error;
}

}  // namespace halfspace::io
