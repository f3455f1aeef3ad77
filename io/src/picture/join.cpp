#include "halfspace/io/join.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>

#include "halfspace/camera.hpp"
#include "halfspace/io/file.hpp"
#include "picture/npy.hpp"
#include "picture/png_rows.hpp"

namespace halfspace::io {
namespace {

using Paths = std::vector<std::filesystem::path>;

Error about(const std::filesystem::path& path, ErrorCode code,
            const std::string& what, std::size_t index) {
  return {code, path.string() + ": " + what, static_cast<std::int64_t>(index)};
}

/// Adds a part to the size of the whole.
std::optional<Error> add(JoinedSize& size, const std::filesystem::path& path,
                         std::int32_t width, std::int32_t height,
                         std::size_t index) {
  if (index > 0 && width != size.width_px) {
    return about(path, ErrorCode::kOutOfRange,
                 "has " + std::to_string(width) +
                     " columns, the parts before it " +
                     std::to_string(size.width_px),
                 index);
  }
  if (height > kMaxImageSize - size.height_px) {
    return about(path, ErrorCode::kOutOfRange,
                 "with this the image has more than 65536 rows", index);
  }
  size.width_px = width;
  size.height_px += height;
  return std::nullopt;
}

/// Whether the output is one of the parts, which would be lost.
std::optional<Error> overwriting(const Paths& parts,
                                 const std::filesystem::path& output) {
  for (std::size_t k = 0; k < parts.size(); ++k) {
    std::error_code ignored;
    if (std::filesystem::equivalent(parts[k], output, ignored)) {
      return about(output, ErrorCode::kUnwritable, "is a part itself", k);
    }
  }
  return std::nullopt;
}

/// The size of the whole, if the parts belong together.
Result<JoinedSize> size_of_pictures(const Paths& parts) {
  JoinedSize size;
  std::int32_t wanted_height = 0;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const PngReader part(parts[k]);
    if (part.error()) return *part.error();
    if (part.part() && part.part()->first_row != size.height_px) {
      return about(parts[k], ErrorCode::kBadIndex,
                   "begins with row " + std::to_string(part.part()->first_row) +
                       ", but row " + std::to_string(size.height_px) +
                       " comes next",
                   k);
    }
    if (part.part()) wanted_height = part.part()->whole_height_px;
    const std::optional<Error> error =
        add(size, parts[k], part.width_px(), part.height_px(), k);
    if (error) return *error;
  }
  if (wanted_height != 0 && wanted_height != size.height_px) {
    return about(parts.back(), ErrorCode::kBadIndex,
                 "is the last part and ends with row " +
                     std::to_string(size.height_px - 1) + " of " +
                     std::to_string(wanted_height) + " rows",
                 parts.size() - 1);
  }
  return size;
}

/// The header of an array file, and whether its size is as that says.
Result<NpyShape> shape_of(const std::filesystem::path& path,
                          std::size_t index) {
  std::ifstream file(path, std::ios::binary);
  std::string head(4096, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  std::error_code trouble;
  const std::uintmax_t size = std::filesystem::file_size(path, trouble);
  if (trouble || head.empty()) {
    return about(path, ErrorCode::kUnreadable, "cannot be read", index);
  }
  const Result<NpyShape> shape = npy_shape(head);
  if (!shape) {
    return about(path, shape.error().code, shape.error().message, index);
  }
  const std::uintmax_t expected =
      shape->start + std::uintmax_t{4} *
                         static_cast<std::uint32_t>(shape->width_px) *
                         static_cast<std::uint32_t>(shape->height_px);
  if (size == expected) return shape;
  return about(
      path, ErrorCode::kSyntax,
      "has " + std::to_string(size) + " bytes, not " + std::to_string(expected),
      index);
}

/// Copies what follows `start` in the file; false, with errno set, where that
/// fails.
bool copy_values(const std::filesystem::path& path, std::size_t start,
                 std::FILE* out) {
  std::ifstream file(path, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(start));
  std::vector<char> buffer(std::size_t{1} << 16);
  while (file) {
    file.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    const auto got = static_cast<std::size_t>(file.gcount());
    if (std::fwrite(buffer.data(), 1, got, out) < got) return false;
  }
  return file.eof();
}

}  // namespace

Result<JoinedSize> join_png(const Paths& parts,
                            const std::filesystem::path& output) {
  if (const auto error = overwriting(parts, output)) return *error;
  const Result<JoinedSize> size = size_of_pictures(parts);
  if (!size) return size.error();
  PngWriter writer(output, size->width_px, size->height_px, std::nullopt, 0);
  std::vector<std::uint8_t> row(static_cast<std::size_t>(size->width_px) * 3);
  bool good = true;
  for (const std::filesystem::path& path : parts) {
    PngReader part(path);
    if (part.error()) return *part.error();
    for (std::int32_t j = 0; good && j < part.height_px(); ++j) {
      if (!part.read_row(row.data())) return *part.error();
      good = writer.write_row(row.data());
    }
  }
  const Result<Done> done = writer.finish();
  if (!done) return done.error();
  return size;
}

Result<JoinedSize> join_npy(const Paths& parts,
                            const std::filesystem::path& output) {
  if (const auto error = overwriting(parts, output)) return *error;
  JoinedSize size;
  std::vector<std::size_t> starts;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const Result<NpyShape> shape = shape_of(parts[k], k);
    if (!shape) return shape.error();
    const std::optional<Error> error =
        add(size, parts[k], shape->width_px, shape->height_px, k);
    if (error) return *error;
    starts.push_back(shape->start);
  }
  NewFile out(output);
  if (out.stream() == nullptr) return out.finish().error();
  const std::string head = npy_header(size.width_px, size.height_px);
  bool good =
      std::fwrite(head.data(), 1, head.size(), out.stream()) == head.size();
  for (std::size_t k = 0; good && k < parts.size(); ++k)
    good = copy_values(parts[k], starts[k], out.stream());
  const Result<Done> done = out.finish(good ? "" : std::strerror(errno));
  if (!done) return done.error();
  return size;
}

}  // namespace halfspace::io
