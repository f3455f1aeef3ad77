#include <cmath>

#include "base/binary.hpp"
#include "halfspace/io/file.hpp"
#include "halfspace/io/scalars.hpp"
#include "mesh/ply.hpp"

namespace halfspace::io {
namespace {

/// One value after another, whether text or bytes; nothing where the file ends
/// or a word is no number.
class PlyValues {
 public:
  PlyValues(TextReader& text, PlyEncoding encoding)
      : text_(text), bytes_(text.rest()), encoding_(encoding) {}

  std::optional<double> next(PlyType type) {
    if (encoding_ == PlyEncoding::kText) return next_word();
    const std::size_t size = size_of(type);
    if (bytes_.size() - at_ < size) return std::nullopt;
    const std::size_t at = at_;
    at_ += size;
    switch (type) {
      case PlyType::kInt8:
        return loaded<std::int8_t>(at);
      case PlyType::kUint8:
        return loaded<std::uint8_t>(at);
      case PlyType::kInt16:
        return loaded<std::int16_t>(at);
      case PlyType::kUint16:
        return loaded<std::uint16_t>(at);
      case PlyType::kInt32:
        return loaded<std::int32_t>(at);
      case PlyType::kUint32:
        return loaded<std::uint32_t>(at);
      case PlyType::kFloat:
        return loaded<float>(at);
      case PlyType::kDouble:
        return loaded<double>(at);
    }
    return std::nullopt;
  }

 private:
  template <class T>
  double loaded(std::size_t at) const {
    return static_cast<double>(load<T>(
        bytes_, at,
        encoding_ == PlyEncoding::kBig ? ByteOrder::kBig : ByteOrder::kLittle));
  }
  std::optional<double> next_word() {
    std::string_view word;
    if (!text_.next(word)) return std::nullopt;
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;
    if (read_double(word, value) != std::errc{}) return std::nullopt;
    return value;
  }

  TextReader& text_;
  std::string_view bytes_;
  PlyEncoding encoding_;
  std::size_t at_ = 0;
};

/// The place of a property among those of an element that are no lists; -1 if
/// there is none.
int scalar_place(const PlyElement& element, const std::string& name) {
  for (std::size_t k = 0; k < element.properties.size(); ++k) {
    const PlyProperty& property = element.properties[k];
    if (property.name == name && !property.is_list) return static_cast<int>(k);
  }
  return -1;
}

std::string property_list(const PlyHeader& header) {
  std::string list;
  for (const PlyElement& element : header.elements) {
    if (element.name != "vertex" && element.name != "face") continue;
    for (const PlyProperty& property : element.properties) {
      if (!property.is_list) list += (list.empty() ? "" : ", ") + property.name;
    }
  }
  return list.empty() ? "none" : list;
}

/// Reads an element, and where `wanted` is a property's place, its values.
std::optional<Error> read_values(PlyValues& values, const PlyElement& element,
                                 int wanted, std::vector<double>& column) {
  for (std::int64_t i = 0; i < element.count; ++i) {
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      const PlyProperty& property = element.properties[k];
      const auto first =
          values.next(property.is_list ? property.count_type : property.type);
      bool is_there = first.has_value();
      for (double n = property.is_list && is_there ? *first : 0;
           is_there && n > 0; n -= 1)
        is_there = values.next(property.type).has_value();
      if (!is_there) {
        return Error{ErrorCode::kTruncated,
                     element.name + " " + std::to_string(i) + " of " +
                         std::to_string(element.count) +
                         ": the file ends, or has a word that is no number",
                     i};
      }
      if (static_cast<int>(k) == wanted)
        column.push_back(std::isfinite(*first) ? *first : kNoData);
    }
  }
  return std::nullopt;
}

Result<ScalarColumn> parse_ply_scalars(std::string_view bytes,
                                       const std::string& name) {
  TextReader text(bytes, {});
  const Result<PlyHeader> header = read_ply_header(text);
  if (!header) return header.error();
  std::string owner;
  for (const PlyElement& element : header->elements) {
    const bool is_vertex = element.name == "vertex";
    if (!is_vertex && (element.name != "face" || !owner.empty())) continue;
    if (scalar_place(element, name) >= 0) owner = element.name;
  }
  if (owner.empty()) {
    return Error{ErrorCode::kBadIndex,
                 "there is no property " + in_quotes(name) +
                     " of vertices or faces, only " + property_list(*header)};
  }
  PlyValues values(text, header->encoding);
  ScalarColumn column;
  column.place =
      owner == "vertex" ? ScalarPlace::kVertices : ScalarPlace::kFaces;
  for (const PlyElement& element : header->elements) {
    const bool is_owner = element.name == owner;
    const auto error =
        read_values(values, element,
                    is_owner ? scalar_place(element, name) : -1, column.values);
    if (error) return *error;
    if (is_owner) break;
  }
  return column;
}

}  // namespace

Result<ScalarColumn> read_ply_scalars(const std::filesystem::path& path,
                                      const std::string& property) {
  const Result<std::string> bytes = read_file(path);
  if (!bytes) return bytes.error();
  Result<ScalarColumn> column = parse_ply_scalars(*bytes, property);
  if (column) return column;
  return error_about(path.string(), column.error());
}

std::vector<std::string> ply_scalar_names(const std::filesystem::path& path,
                                          const Stop& stop) {
  std::vector<std::string> names;
  if (!has_extension(path, ".ply")) return names;
  const Result<std::string> bytes = read_file(path, kMostFileBytes, stop);
  if (!bytes) return names;
  TextReader text(*bytes, {});
  const Result<PlyHeader> header = read_ply_header(text);
  if (!header) return names;
  for (const PlyElement& element : header->elements) {
    if (element.name != "vertex" && element.name != "face") continue;
    for (const PlyProperty& property : element.properties) {
      if (!property.is_list) names.push_back(property.name);
    }
  }
  return names;
}

}  // namespace halfspace::io
