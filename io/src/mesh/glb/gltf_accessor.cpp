#include "mesh/glb/gltf_accessor.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/binary.hpp"
#include "mesh/glb/glb.hpp"

namespace halfspace::io {
namespace {

std::size_t bytes_of_type(std::int64_t type) {
  switch (type) {
    case kGlbInt8:
    case kGlbUint8:
      return 1;
    case kGlbInt16:
    case kGlbUint16:
      return 2;
    case kGlbUint32:
    case kGlbFloat:
      return 4;
    default:
      return 0;
  }
}

}  // namespace

Result<std::string_view> bytes_of_view(const GltfFile& file, std::int64_t id,
                                       const std::string& place) {
  const auto view = entry_at(file.json, "bufferViews", id, place);
  if (!view) return view.error();
  const std::string view_place =
      item("bufferViews", static_cast<std::size_t>(id));
  std::int64_t buffer = 0, offset = 0, length = 0;
  if (auto error = read_wholes(**view, view_place,
                               {{"buffer", &buffer},
                                {"byteOffset", &offset},
                                {"byteLength", &length}}))
    return *error;
  if (static_cast<std::uint64_t>(buffer) >= file.buffers.size()) {
    return Error{ErrorCode::kBadIndex,
                 view_place + ": there is no " +
                     item("buffers", static_cast<std::size_t>(buffer)) +
                     ", only " + std::to_string(file.buffers.size())};
  }
  const std::string_view bytes = file.buffers[static_cast<std::size_t>(buffer)];
  const auto size = static_cast<std::int64_t>(bytes.size());
  if (offset > size || length > size - offset) {
    return Error{ErrorCode::kTruncated, view_place + " reaches to byte " +
                                            std::to_string(offset + length) +
                                            " of " + std::to_string(size)};
  }
  return bytes.substr(static_cast<std::size_t>(offset),
                      static_cast<std::size_t>(length));
}

Result<Accessor> Accessor::of(const GltfFile& file, std::int64_t id,
                              const std::string& from) {
  const std::string place = item("accessors", static_cast<std::size_t>(id));
  const auto found = entry_at(file.json, "accessors", id, from);
  if (!found) return found.error();
  const Json& json = **found;
  constexpr std::pair<const char*, std::size_t> kWidths[] = {
      {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}};
  const std::string shape = text_in(json, "type");
  const auto* const width =
      std::find_if(std::begin(kWidths), std::end(kWidths),
                   [&](const auto& entry) { return shape == entry.first; });
  Accessor accessor;
  if (auto error =
          read_wholes(json, place, {{"componentType", &accessor.type_}}))
    return *error;
  if (width == std::end(kWidths) || bytes_of_type(accessor.type_) == 0)
    return Error{ErrorCode::kSyntax, place + " has no type that is read"};
  if (json.contains("sparse")) {
    return Error{ErrorCode::kUnknownFormat,
                 place + " is sparse, which is not read"};
  }
  accessor.width_ = width->second;
  const auto normalized = json.find("normalized");
  accessor.is_normalized_ = normalized != json.end() &&
                            normalized->is_boolean() && normalized->get<bool>();
  if (auto error = accessor.find_bytes(file, json, place)) return *error;
  return accessor;
}

std::optional<Error> Accessor::find_bytes(const GltfFile& file,
                                          const Json& json,
                                          const std::string& place) {
  std::int64_t count = 0, view_id = -1, first = 0;
  if (auto error = read_wholes(json, place,
                               {{"count", &count},
                                {"bufferView", &view_id},
                                {"byteOffset", &first}}))
    return error;
  if (view_id < 0)
    return Error{ErrorCode::kSyntax, place + " has no bufferView"};
  const std::string view_place =
      item("bufferViews", static_cast<std::size_t>(view_id));
  const auto bytes = bytes_of_view(file, view_id, place);
  if (!bytes) return bytes.error();
  const std::size_t row = bytes_of_type(type_) * width_;
  auto stride = static_cast<std::int64_t>(row);
  const auto view = entry_at(file.json, "bufferViews", view_id, place);
  if (auto error = read_wholes(**view, view_place, {{"byteStride", &stride}}))
    return error;
  const auto length = static_cast<std::int64_t>(bytes->size());
  const auto wide = static_cast<std::int64_t>(row);
  if (stride < wide || stride > 4096) {
    return Error{ErrorCode::kSyntax,
                 view_place + ".byteStride is too small or large"};
  }
  if (count > 0 && (first > length || length - first < wide ||
                    count - 1 > (length - first - wide) / stride)) {
    return Error{ErrorCode::kTruncated,
                 place + " counts " + std::to_string(count) +
                     " elements, more than its bufferView has room for"};
  }
  stride_ = static_cast<std::size_t>(stride);
  count_ = static_cast<std::size_t>(count);
  bytes_ = *bytes;
  if (count > 0) bytes_.remove_prefix(static_cast<std::size_t>(first));
  return std::nullopt;
}

std::int64_t Accessor::integer(std::size_t i, std::size_t k) const {
  const std::size_t at = i * stride_ + k * bytes_of_type(type_);
  switch (type_) {
    case kGlbInt8:
      return load<std::int8_t>(bytes_, at, ByteOrder::kLittle);
    case kGlbUint8:
      return load<std::uint8_t>(bytes_, at, ByteOrder::kLittle);
    case kGlbInt16:
      return load<std::int16_t>(bytes_, at, ByteOrder::kLittle);
    case kGlbUint16:
      return load<std::uint16_t>(bytes_, at, ByteOrder::kLittle);
    default:
      return load<std::uint32_t>(bytes_, at, ByteOrder::kLittle);
  }
}

double Accessor::number(std::size_t i, std::size_t k) const {
  if (type_ == kGlbFloat) {
    return load<float>(bytes_, i * stride_ + k * 4, ByteOrder::kLittle);
  }
  const auto value = static_cast<double>(integer(i, k));
  if (!is_normalized_) return value;
  switch (type_) {
    case kGlbInt8:
      return std::max(value / 127, -1.0);
    case kGlbInt16:
      return std::max(value / 32767, -1.0);
    case kGlbUint8:
      return value / 255;
    default:
      return value / 65535;
  }
}

}  // namespace halfspace::io
